// Properties of a scene, computed the obvious way.
#pragma once

#include <map>
#include <string>

#include "scene/scene.hpp"

namespace camdir::test {

[[nodiscard]] double area_of(const scene::Scene& scene);
[[nodiscard]] double surface_of(const Box3d& box);
// An obstacle triangle comes within 0.01 of the point.
[[nodiscard]] bool has_surface_at(const scene::Scene& scene, const Vec3d& point);

// Scene::skipped by "reason: what", or "reason" alone.
[[nodiscard]] std::map<std::string, std::uint64_t> skipped_counts(const scene::Scene& scene);
[[nodiscard]] std::map<std::string, double> skipped_areas(const scene::Scene& scene);

}  // namespace camdir::test
