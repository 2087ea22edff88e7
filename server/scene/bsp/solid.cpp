#include "scene/bsp/solid.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace camdir::scene {
namespace {

// Larger than any map: coordinates are below 2^20.
constexpr double half_side = 1 << 22;
// Above the rounding of clips at that size in double precision, far below that of the file's float planes.
constexpr double tolerance = 1e-6;

// What the other half spaces leave of a side. Of sides in the same plane only the first has a face.
Polygon face_of(const std::vector<Plane>& planes, std::size_t side) {
    Polygon face = base_winding(planes[side], half_side);
    for (std::size_t other = 0; other < planes.size() && !face.empty(); ++other) {
        if (other == side) continue;
        if (!lies_on(face, planes[other], tolerance))
            face = clip(face, planes[other], tolerance);
        else if (other < side)
            face.clear();
    }
    return face;
}

void add_face(Solid& solid, Polygon polygon, const Vec3d& normal) {
    for (const Vec3d& corner : polygon) {
        solid.bounds.extend(corner);
    }
    solid.faces.push_back({std::move(polygon), normal});
}

void add_side(Solid& solid, const Plane& plane, Polygon polygon) {
    if (polygon.empty()) return;
    solid.planes.push_back(plane);
    add_face(solid, std::move(polygon), plane.normal);
}

}  // namespace

Solid make_solid(std::vector<Plane> planes) {
    Solid solid;
    for (std::size_t side = 0; side < planes.size(); ++side) {
        Polygon face = face_of(planes, side);
        if (!face.empty()) add_face(solid, std::move(face), planes[side].normal);
    }
    solid.planes = std::move(planes);
    return solid;
}

Solid make_solid(const Box3d& box) {
    std::vector<Plane> planes;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        planes.push_back({Vec3d::Unit(axis), box.max()[axis]});
        planes.push_back({-Vec3d::Unit(axis), -box.min()[axis]});
    }
    return make_solid(std::move(planes));
}

Solid clip(const Solid& solid, const Plane& plane) {
    double lowest = std::numeric_limits<double>::infinity();
    double highest = -lowest;
    for (const SolidFace& face : solid.faces) {
        for (const Vec3d& corner : face.polygon) {
            const double height = plane.normal.dot(corner) - plane.distance;
            lowest = std::min(lowest, height);
            highest = std::max(highest, height);
        }
    }
    if (lowest >= -tolerance) return {};
    if (highest <= tolerance) return solid;

    Solid behind;
    Polygon section = base_winding(plane, half_side);
    for (std::size_t side = 0; side < solid.planes.size(); ++side) {
        add_side(behind, solid.planes[side], clip(solid.faces[side].polygon, plane, tolerance));
        section = clip(section, solid.planes[side], tolerance);
    }
    add_side(behind, plane, std::move(section));
    return behind;
}

ConvexPart convex_part(const Solid& solid) {
    ConvexPart part{{}, solid.bounds};
    for (const SolidFace& face : solid.faces) {
        double distance = -std::numeric_limits<double>::infinity();
        for (const Vec3d& corner : face.polygon)
            distance = std::max(distance, face.normal.dot(corner));
        part.planes.push_back({face.normal, distance});
    }
    return part;
}

double area(const Polygon& polygon) {
    Vec3d twice = Vec3d::Zero();
    for (std::size_t i = 2; i < polygon.size(); ++i) {
        twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
    }
    return twice.norm() / 2.0;
}

}  // namespace camdir::scene
