#include "bake/parameters.hpp"

#include <algorithm>
#include <array>
#include <charconv>

namespace camdir::bake {
namespace {

constexpr double default_d0 = 16.0;

std::string number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string triple(const Vec3d& p) {
    return "[" + number(p.x()) + ", " + number(p.y()) + ", " + number(p.z()) + "]";
}

// As far as it was given.
std::string json_of(const scene::ReadOptions& options) {
    std::string json;
    if (options.metres_per_unit) json += ", \"metres_per_unit\": " + number(*options.metres_per_unit);
    if (options.up) json += *options.up == scene::UpAxis::y ? ", \"up\": \"y\"" : ", \"up\": \"z\"";
    if (options.origin != Vec3d::Zero()) json += ", \"origin\": " + triple(options.origin);
    if (options.seeds.empty()) return json;
    std::string seeds;
    for (const Vec3d& seed : options.seeds)
        seeds += (seeds.empty() ? "" : ", ") + triple(seed);
    return json + ", \"seeds\": [" + seeds + "]";
}

}  // namespace

std::string to_json(const Parameters& parameters, const scene::ReadOptions& options) {
    return "{\"d0\": " + number(parameters.d0) + ", \"sampling\": \"" +
           std::string(name_of(parameters.sampling)) + "\", \"coarsest\": " + number(parameters.coarsest) +
           ", \"loss\": " + number(parameters.loss) +
           ", \"triangles\": " + std::to_string(parameters.triangles) + json_of(options) + "}";
}

std::string_view name_of(Sampling sampling) {
    return sampling == Sampling::adaptive ? "adaptive" : "uniform";
}

std::optional<Sampling> sampling_named(std::string_view name) {
    for (const Sampling sampling : {Sampling::adaptive, Sampling::uniform})
        if (name == name_of(sampling)) return sampling;
    return std::nullopt;
}

double sampling_distance(const scene::Scene& scene, const Parameters& parameters) {
    const double unit = scene::metres_of_nominal_unit / scene.metres_per_unit;
    if (parameters.d0 > 0.0) return parameters.d0 * unit;
    if (scene.points.empty()) return default_d0 * unit;
    return std::clamp(scene.point_spacing, min_d0 * unit, max_d0 * unit);
}

Result<void> check(const Parameters& parameters) {
    if (parameters.d0 != 0.0 && !(parameters.d0 >= min_d0 && parameters.d0 <= max_d0))
        return fail("d0 = " + number(parameters.d0) + ": expected a distance from 2 to 256 units");
    if (!(parameters.coarsest >= 1.0 && parameters.coarsest <= max_coarsest))
        return fail("coarsest = " + number(parameters.coarsest) + ": expected a number from 1 to 64");
    if (!(parameters.loss >= 0.0 && parameters.loss <= max_loss))
        return fail("loss = " + number(parameters.loss) + ": expected a percentage from 0 to 100");
    return {};
}

}  // namespace camdir::bake
