// Scenes of axis-parallel solid boxes.
#pragma once

#include <string>

#include "scene/scene.hpp"

namespace camdir::evaluation {

inline void add_box(scene::Scene& scene, const Vec3d& low, const Vec3d& high) {
    const auto first = static_cast<std::uint32_t>(scene.vertices.size());
    for (int i = 0; i < 8; ++i)
        scene.vertices.emplace_back((i & 1) != 0 ? high.x() : low.x(), (i & 2) != 0 ? high.y() : low.y(),
                                    (i & 4) != 0 ? high.z() : low.z());
    constexpr std::uint32_t faces[6][4] = {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4},
                                           {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}};
    for (const auto& f : faces) {
        scene.triangles.push_back({first + f[0], first + f[1], first + f[2]});
        scene.triangles.push_back({first + f[0], first + f[2], first + f[3]});
    }
    scene.brushes.push_back({static_cast<std::uint32_t>(scene.planes.size()), 6, Box3d(low, high)});
    for (int axis = 0; axis < 3; ++axis) {
        scene.planes.push_back({Vec3d::Unit(axis), high[axis]});
        scene.planes.push_back({-Vec3d::Unit(axis), -low[axis]});
    }
    scene.bounds.extend(low);
    scene.bounds.extend(high);
}

// A closed room, free for |x|, |y| < 400 and 0 < z < 300, with a spawn point at its middle. `unit` scales it
// all.
inline scene::Scene room(double unit = 1.0) {
    scene::Scene scene;
    scene.name = "room";
    scene.metres_per_unit = 0.0254 / unit;
    const Vec3d low = unit * Vec3d(-400, -400, 0);
    const Vec3d high = unit * Vec3d(400, 400, 300);
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d wall_high = high + Vec3d::Constant(16 * unit);
        Vec3d wall_low = low - Vec3d::Constant(16 * unit);
        wall_high[axis] = low[axis];
        add_box(scene, low - Vec3d::Constant(16 * unit), wall_high);
        wall_low[axis] = high[axis];
        add_box(scene, wall_low, high + Vec3d::Constant(16 * unit));
    }
    scene.spawn_points.push_back({unit * Vec3d(0, 0, 100), 0.0, "seed"});
    return scene;
}

// A solid box that moves, in its own frame.
inline scene::Mover moving_box(const std::string& name, const Vec3d& low, const Vec3d& high) {
    scene::Scene box;
    add_box(box, low, high);
    return {name, "func_door", {{box.planes, box.bounds}}, Vec3d::Zero()};
}

}  // namespace camdir::evaluation
