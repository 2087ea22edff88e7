#include "bake/movers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <string>

#include "base/round_down.hpp"
#include "scene/bsp/solid.hpp"

namespace camdir::bake {
namespace {

using freespace::ConvexHull;
using freespace::MoverShape;
using scene::Solid;
using scene::SolidFace;

// Far above the rounding of corners, far below what a player can see.
constexpr double tolerance = 0.01;
// Cosines of the angles between two normals.
constexpr float parallel = 0.9999F;
constexpr double turn_of_bevels = std::numbers::sqrt2 / 2.0;

float round_up(double value) {
    return -round_down(-value);
}

Box3f enclosing(const Box3d& box) {
    Box3f enclosing;
    for (int axis = 0; axis < 3; ++axis) {
        enclosing.min()[axis] = round_down(box.min()[axis]);
        enclosing.max()[axis] = round_up(box.max()[axis]);
    }
    return enclosing;
}

double support(const Solid& solid, const Vec3d& normal) {
    double distance = -std::numeric_limits<double>::infinity();
    for (const SolidFace& face : solid.faces)
        for (const Vec3d& corner : face.polygon)
            distance = std::max(distance, normal.dot(corner));
    return distance;
}

// For the normal as it is stored.
void add_half_space(ConvexHull& hull, const Solid& solid, const Vec3f& normal) {
    hull.half_spaces.push_back({normal, round_up(support(solid, normal.cast<double>()))});
}

void add_bevel(ConvexHull& hull, const Solid& solid, const Vec3f& normal) {
    const bool has_it =
        std::any_of(hull.half_spaces.begin(), hull.half_spaces.end(),
                    [&](const auto& half_space) { return half_space.normal.dot(normal) > parallel; });
    if (!has_it && hull.half_spaces.size() < freespace::max_half_spaces) add_half_space(hull, solid, normal);
}

// An edge of `face` lies on the other, too.
bool share_edge(const SolidFace& face, const SolidFace& other) {
    const double distance = other.normal.dot(other.polygon.front());
    const auto on_other = [&](const Vec3d& corner) {
        return std::abs(other.normal.dot(corner) - distance) <= tolerance;
    };
    for (std::size_t i = 0; i < face.polygon.size(); ++i) {
        const Vec3d& from = face.polygon[i];
        const Vec3d& to = face.polygon[(i + 1) % face.polygon.size()];
        if (on_other(from) && on_other(to) && (to - from).norm() > tolerance) return true;
    }
    return false;
}

void add_edge_bevels(ConvexHull& hull, const Solid& solid) {
    for (std::size_t i = 0; i < solid.faces.size(); ++i) {
        for (std::size_t j = i + 1; j < solid.faces.size(); ++j) {
            const SolidFace& face = solid.faces[i];
            const SolidFace& other = solid.faces[j];
            const double cosine = face.normal.dot(other.normal);
            // Opposite faces meet nowhere; what has no thickness has no bevel there.
            if (cosine < turn_of_bevels && cosine > -parallel && share_edge(face, other))
                add_bevel(hull, solid, (face.normal + other.normal).normalized().cast<float>());
        }
    }
}

ConvexHull hull_of(const Solid& solid) {
    ConvexHull hull{{}, enclosing(solid.bounds)};
    for (const SolidFace& face : solid.faces)
        add_half_space(hull, solid, face.normal.cast<float>());
    for (int axis = 0; axis < 3; ++axis) {
        add_bevel(hull, solid, Vec3f::Unit(axis));
        add_bevel(hull, solid, -Vec3f::Unit(axis));
    }
    add_edge_bevels(hull, solid);
    return hull;
}

// Null: it fits.
const char* why_left_out(const std::vector<Solid>& solids, std::size_t movers) {
    if (movers == freespace::max_movers) return "left out: more than 256 movers";
    if (solids.size() > freespace::max_hulls) return "left out: movers of more than 256 solids";
    const auto has_a_hull = [](const Solid& solid) {
        return solid.faces.size() >= 4 && solid.faces.size() <= freespace::max_half_spaces;
    };
    if (!std::all_of(solids.begin(), solids.end(), has_a_hull))
        return "left out: movers with a solid of less than 4 or more than 64 faces";
    return nullptr;
}

std::vector<Solid> solids_of(const scene::Mover& mover) {
    std::vector<Solid> solids;
    for (const scene::ConvexPart& part : mover.parts)
        solids.push_back(scene::make_solid(part.planes));
    return solids;
}

}  // namespace

std::vector<MoverShape> mover_shapes(const scene::Scene& scene, Stage& stage) {
    std::vector<MoverShape> shapes;
    std::map<std::string, double> left_out;
    std::size_t half_spaces = 0;
    for (const scene::Mover& mover : scene.movers) {
        const std::vector<Solid> solids = solids_of(mover);
        if (const char* const reason = why_left_out(solids, shapes.size())) {
            ++left_out[reason];
            continue;
        }
        MoverShape& shape = shapes.emplace_back();
        shape.name = mover.name;
        shape.kind = mover.kind;
        shape.rest = mover.rest.cast<float>();
        for (const Solid& solid : solids) {
            shape.hulls.push_back(hull_of(solid));
            half_spaces += shape.hulls.back().half_spaces.size();
        }
    }
    stage.count("movers", static_cast<double>(shapes.size()));
    stage.count("half spaces", static_cast<double>(half_spaces));
    for (const auto& [reason, count] : left_out)
        stage.count(reason, count);
    return shapes;
}

}  // namespace camdir::bake
