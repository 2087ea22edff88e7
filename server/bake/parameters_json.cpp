#include "bake/parameters_json.hpp"

#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

namespace camdir::bake {
namespace {

using nlohmann::json;
using nlohmann::ordered_json;

ordered_json triple(const Vec3d& point) {
    return {point.x(), point.y(), point.z()};
}

std::optional<Vec3d> point_in(const json& triple) {
    if (!triple.is_array() || triple.size() != 3) return std::nullopt;
    Vec3d point;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (!triple[axis].is_number()) return std::nullopt;
        point[static_cast<Eigen::Index>(axis)] = triple[axis].get<double>();
    }
    return point;
}

void add_read_options(const scene::ReadOptions& options, ordered_json& object) {
    if (options.metres_per_unit) object["metres_per_unit"] = *options.metres_per_unit;
    if (options.up) object["up"] = scene::name_of(*options.up);
    if (options.origin != Vec3d::Zero()) object["origin"] = triple(options.origin);
    for (const Vec3d& seed : options.seeds)
        object["seeds"].push_back(triple(seed));
}

// The library writes 16.0, and 1e+06 as 1000000.0; these texts have always had the shortest form.
std::string shortest(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

// The library knows this spacing only with line breaks.
std::string one_line(const ordered_json& value) {
    if (value.is_number_float()) return shortest(value.get<double>());
    if (!value.is_structured()) return value.dump();
    std::string text;
    for (const auto& [key, member] : value.items()) {
        if (!text.empty()) text += ", ";
        if (value.is_object()) text += ordered_json(key).dump() + ": ";
        text += one_line(member);
    }
    return value.is_object() ? "{" + text + "}" : "[" + text + "]";
}

}  // namespace

std::string to_json(const Parameters& parameters, const scene::ReadOptions& options,
                    const std::string& kind) {
    ordered_json object;
    if (!kind.empty()) object["kind"] = kind;
    object["d0"] = parameters.d0;
    object["sampling"] = name_of(parameters.sampling);
    object["coarsest"] = parameters.coarsest;
    object["loss"] = parameters.loss;
    object["triangles"] = parameters.triangles;
    add_read_options(options, object);
    return one_line(object);
}

scene::ReadOptions read_options_in(const json& parameters) {
    scene::ReadOptions options;
    if (!parameters.is_object()) return options;
    const auto member = [&](const char* key) {
        const auto found = parameters.find(key);
        return found == parameters.end() ? json() : *found;
    };
    if (const json unit = member("metres_per_unit"); unit.is_number())
        options.metres_per_unit = unit.get<double>();
    if (const json up = member("up"); up.is_string())
        options.up = scene::up_axis_named(up.get_ref<const std::string&>());
    options.origin = point_in(member("origin")).value_or(Vec3d::Zero());
    const json seeds = member("seeds");
    if (!seeds.is_array()) return options;
    for (const json& entry : seeds)
        if (const auto seed = point_in(entry)) options.seeds.push_back(*seed);
    return options;
}

}  // namespace camdir::bake
