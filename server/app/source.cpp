#include "app/source.hpp"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "config/json_text.hpp"
#include "scene/load.hpp"

namespace camdir::app {
namespace {

// `x,y,z`
std::optional<Vec3d> point_of(std::string_view text) {
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

Vec3d checked_point(const std::string& option, const std::string& text) {
    const auto point = point_of(text);
    if (!point) throw CLI::ValidationError(option, "'" + text + "': expected three numbers, x,y,z");
    return *point;
}

std::optional<scene::UpAxis> up_of(std::string_view name) {
    if (name == "y") return scene::UpAxis::y;
    if (name == "z") return scene::UpAxis::z;
    return std::nullopt;
}

std::optional<Vec3d> point_in(const nlohmann::json& list) {
    if (!list.is_array() || list.size() != 3) return std::nullopt;
    Vec3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!list[axis].is_number()) return std::nullopt;
        point[static_cast<Eigen::Index>(axis)] = list[axis].get<double>();
    }
    return point;
}

}  // namespace

void add_read_options(CLI::App& command, scene::ReadOptions& options) {
    command
        .add_option_function<double>(
            "--metres-per-unit", [&options](double value) { options.metres_per_unit = value; },
            "Length of a map unit; default: 0.0254 for a BSP, 1 for a mesh or a point cloud")
        ->check(CLI::Range(1e-6, 1e6));
    command
        .add_option_function<std::string>(
            "--up", [&options](const std::string& axis) { options.up = up_of(axis); },
            "Axis of a mesh or a point cloud that points up: y or z; default: y for glTF, else z. With y, "
            "(x, y, z) becomes (z, x, y)")
        ->check(CLI::IsMember({"y", "z"}));
    command.add_option_function<std::string>(
        "--origin", [&options](const std::string& text) { options.origin = checked_point("--origin", text); },
        "x,y,z of a mesh or a point cloud, in its own axes, that becomes 0,0,0");
    command
        .add_option_function<std::vector<std::string>>(
            "--seed",
            [&options](const std::vector<std::string>& texts) {
                options.seeds.clear();
                for (const std::string& text : texts)
                    options.seeds.push_back(checked_point("--seed", text));
            },
            "x,y,z in the free space, in map units with z up, beside the map's spawn points; repeatable. "
            "Without either the largest connected part is baked")
        ->type_name("X,Y,Z")
        ->expected(1)
        ->take_all();
}

Result<scene::ReadOptions> read_options_of(const config::Map& map) {
    scene::ReadOptions options;
    if (map.metres_per_unit > 0.0) options.metres_per_unit = map.metres_per_unit;
    options.up = up_of(map.up);
    if (!map.origin.empty()) {
        const auto origin = point_of(map.origin);
        if (!origin) return fail("origin: '" + map.origin + "': expected three numbers, x,y,z");
        options.origin = *origin;
    }
    for (const std::string& text : map.seeds) {
        const auto seed = point_of(text);
        if (!seed) return fail("seeds: '" + text + "': expected three numbers, x,y,z");
        options.seeds.push_back(*seed);
    }
    return options;
}

scene::ReadOptions read_options_of(const freespace::Metadata& metadata) {
    scene::ReadOptions options;
    const auto parameters = config::parse_json(metadata.parameters);
    if (!parameters || !parameters->is_object()) return options;
    const auto& json = *parameters;
    if (json.contains("metres_per_unit") && json["metres_per_unit"].is_number())
        options.metres_per_unit = json["metres_per_unit"].get<double>();
    if (json.contains("up") && json["up"].is_string()) options.up = up_of(json["up"].get<std::string>());
    if (json.contains("origin")) options.origin = point_in(json["origin"]).value_or(Vec3d::Zero());
    if (!json.contains("seeds") || !json["seeds"].is_array()) return options;
    for (const auto& entry : json["seeds"])
        if (const auto seed = point_in(entry)) options.seeds.push_back(*seed);
    return options;
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

}  // namespace camdir::app
