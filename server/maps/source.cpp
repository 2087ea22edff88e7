#include "maps/source.hpp"

#include <charconv>
#include <cmath>

#include "bake/parameters_json.hpp"
#include "config/json_text.hpp"
#include "scene/load.hpp"

namespace camdir::maps {

std::optional<Vec3d> parse_point(std::string_view text) {
    Vec3d point;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        while (text.starts_with(' '))
            text.remove_prefix(1);
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), point[axis]);
        if (error != std::errc() || !std::isfinite(point[axis])) return std::nullopt;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (axis == 2) break;
        if (!text.starts_with(',')) return std::nullopt;
        text.remove_prefix(1);
    }
    return text.empty() ? std::optional(point) : std::nullopt;
}

Result<scene::ReadOptions> read_options_of(const config::Map& map) {
    scene::ReadOptions options;
    if (map.metres_per_unit > 0.0) options.metres_per_unit = map.metres_per_unit;
    options.up = scene::up_axis_named(map.up);
    if (!map.origin.empty()) {
        const auto origin = parse_point(map.origin);
        if (!origin) return fail("origin: '" + map.origin + "': expected three numbers, x,y,z");
        options.origin = *origin;
    }
    for (const std::string& text : map.seeds) {
        const auto seed = parse_point(text);
        if (!seed) return fail("seeds: '" + text + "': expected three numbers, x,y,z");
        options.seeds.push_back(*seed);
    }
    return options;
}

scene::ReadOptions read_options_of(const freespace::Metadata& metadata) {
    const auto parameters = config::parse_json(metadata.parameters);
    return parameters ? bake::read_options_in(*parameters) : scene::ReadOptions();
}

Result<scene::Scene> load_source(const config::Map& map) {
    const auto options = read_options_of(map);
    if (!options) return tl::unexpected(options.error());
    return scene::load(map.source, *options);
}

Result<scene::Scene> load_source(const freespace::Freespace& baked, const std::string& map) {
    auto scene = scene::load(map, read_options_of(baked.metadata()));
    if (!scene) return scene;
    const auto unit = static_cast<double>(baked.metadata().metres_per_unit);
    if (!(std::abs(unit - scene->metres_per_unit) <= 1e-6 * unit))
        return fail(map + ": a unit is " + std::to_string(scene->metres_per_unit) +
                    " m long, and in the baked map " + std::to_string(unit) +
                    " m; expected the source that it was baked from");
    if (!scene->spawn_points.empty()) return scene;
    for (const freespace::SpawnPoint& spawn : baked.spawn_points())
        scene->spawn_points.push_back({spawn.eye.cast<double>(), spawn.yaw, "baked"});
    return scene;
}

}  // namespace camdir::maps
