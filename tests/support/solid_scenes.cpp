#include "support/solid_scenes.hpp"

#include <algorithm>
#include <limits>

namespace camdir::test {
namespace {

constexpr double wall = 16.0;

Box3d box(const Vec3d& min, const Vec3d& max) {
    return {min, max};
}

}  // namespace

SolidScene::SolidScene(const Box3d& inside) {
    scene_.name = "made";
    scene_.source = "made.map";
    scene_.source_hash = 1;
    scene_.metres_per_unit = 0.0254;
    const Vec3d thick = Vec3d::Constant(wall);
    for (int axis = 0; axis < 3; ++axis) {
        Box3d low(inside.min() - thick, inside.max() + thick);
        Box3d high = low;
        low.max()[axis] = inside.min()[axis];
        high.min()[axis] = inside.max()[axis];
        add(low).add(high);
    }
}

SolidScene& SolidScene::add(const Box3d& solid) {
    solids_.push_back(solid);
    scene_.bounds.extend(solid);
    const auto first_vertex = static_cast<std::uint32_t>(scene_.vertices.size());
    for (unsigned corner = 0; corner < 8; ++corner)
        scene_.vertices.push_back(solid.corner(static_cast<Box3d::CornerType>(corner)));
    const auto quad = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
        scene_.triangles.push_back({first_vertex + a, first_vertex + b, first_vertex + c});
        scene_.triangles.push_back({first_vertex + a, first_vertex + c, first_vertex + d});
    };
    // Corner bits: 1 = far in x, 2 = far in y, 4 = far in z.
    quad(0, 1, 3, 2);
    quad(4, 5, 7, 6);
    quad(0, 1, 5, 4);
    quad(2, 3, 7, 6);
    quad(0, 2, 6, 4);
    quad(1, 3, 7, 5);

    scene_.brushes.push_back({static_cast<std::uint32_t>(scene_.planes.size()), 6, solid});
    for (int axis = 0; axis < 3; ++axis) {
        scene_.planes.push_back({Vec3d::Unit(axis), solid.max()[axis]});
        scene_.planes.push_back({-Vec3d::Unit(axis), -solid.min()[axis]});
    }
    return *this;
}

SolidScene& SolidScene::spawn(const Vec3d& eye) {
    scene_.spawn_points.push_back({eye, 0.0, "made"});
    return *this;
}

double SolidScene::clearance(const Vec3d& point) const {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Box3d& solid : solids_)
        nearest = std::min(nearest, solid.exteriorDistance(point));
    return nearest;
}

SolidScene box_room() {
    return SolidScene(box({0, 0, 0}, {256, 192, 128})).spawn({100, 100, 50});
}

SolidScene pillar_room() {
    return box_room().add(box({150, 60, 0}, {182, 92, 128}));
}

SolidScene two_rooms() {
    SolidScene rooms(box({-264, -128, 0}, {264, 128, 128}));
    rooms.add(box({-8, -128, 0}, {8, -32, 128}));
    rooms.add(box({-8, 32, 0}, {8, 128, 128}));
    rooms.add(box({-8, -32, 96}, {8, 32, 128}));
    return rooms.spawn({-150, 0, 50});
}

}  // namespace camdir::test
