#include "bake/parameters.hpp"

#include <algorithm>
#include <sstream>

namespace camdir::bake {
namespace {

constexpr double default_d0 = 16.0;

}  // namespace

std::string_view name_of(Sampling sampling) {
    return sampling == Sampling::adaptive ? "adaptive" : "uniform";
}

std::optional<Sampling> sampling_named(std::string_view name) {
    for (const Sampling sampling : {Sampling::adaptive, Sampling::uniform})
        if (name == name_of(sampling)) return sampling;
    return std::nullopt;
}

double sampling_distance(const scene::Scene& scene, const Parameters& parameters) {
    const double unit = metres_of_nominal_unit / scene.metres_per_unit;
    if (parameters.d0 > 0.0) return parameters.d0 * unit;
    if (scene.points.empty()) return default_d0 * unit;
    return std::clamp(scene.point_spacing, min_d0 * unit, max_d0 * unit);
}

Result<void> check(const Parameters& parameters) {
    const auto refuse = [](const char* name, double value, const char* expected) {
        std::ostringstream message;
        message << name << " = " << value << ": expected " << expected;
        return fail(message.str());
    };
    if (parameters.d0 != 0.0 && !(parameters.d0 >= min_d0 && parameters.d0 <= max_d0))
        return refuse("d0", parameters.d0, "a distance from 2 to 256 units");
    if (!(parameters.coarsest >= 1.0 && parameters.coarsest <= max_coarsest))
        return refuse("coarsest", parameters.coarsest, "a number from 1 to 64");
    if (!(parameters.loss >= 0.0 && parameters.loss <= max_loss))
        return refuse("loss", parameters.loss, "a percentage from 0 to 100");
    return {};
}

}  // namespace camdir::bake
