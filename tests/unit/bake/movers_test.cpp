#include "bake/movers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "freespace/check.hpp"

namespace camdir::bake {
namespace {

using freespace::MoverShape;
using scene::ConvexPart;
using scene::Plane;

ConvexPart box_part(const Box3d& box) {
    ConvexPart part{{}, box};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        part.planes.push_back({Vec3d::Unit(axis), box.max()[axis]});
        part.planes.push_back({-Vec3d::Unit(axis), -box.min()[axis]});
    }
    return part;
}

// Planes that touch the unit sphere at as many places, and so bound a solid around it.
ConvexPart round_part(std::mt19937& random, int sides) {
    std::normal_distribution<double> normal;
    ConvexPart part = box_part({Vec3d::Constant(-1.5), Vec3d::Constant(1.5)});
    for (int i = 6; i < sides; ++i)
        part.planes.push_back({Vec3d(normal(random), normal(random), normal(random)).normalized(), 1.0});
    return part;
}

struct Shapes {
    std::vector<MoverShape> shapes;
    std::vector<freespace::Count> counts;
};

Shapes shapes_of(std::vector<scene::Mover> movers) {
    scene::Scene scene;
    scene.movers = std::move(movers);
    Stage stage("movers", {}, {});
    std::vector<MoverShape> shapes = mover_shapes(scene, stage);
    return {std::move(shapes), std::move(stage).finish().counts};
}

scene::Mover door(std::vector<ConvexPart> parts) {
    return {"*7", "func_door", std::move(parts), Vec3d(1.0, 2.0, 3.0)};
}

double largest_distance(const freespace::ConvexHull& hull, const Vec3d& point) {
    double largest = -std::numeric_limits<double>::infinity();
    for (const auto& [normal, distance] : hull.half_spaces)
        largest = std::max(largest, normal.cast<double>().dot(point) - static_cast<double>(distance));
    return largest;
}

double count_of(const Shapes& shapes, const std::string& what) {
    for (const freespace::Count& count : shapes.counts)
        if (count.what == what) return count.value;
    return 0.0;
}

TEST(MoverShapes, KeepNamesAndPlaces) {
    const Shapes made = shapes_of({door({box_part({Vec3d::Zero(), Vec3d(64.0, 8.0, 96.0)})})});
    ASSERT_EQ(made.shapes.size(), 1U);
    const MoverShape& shape = made.shapes[0];
    EXPECT_EQ(shape.name, "*7");
    EXPECT_EQ(shape.kind, "func_door");
    EXPECT_EQ(shape.rest, Vec3f(1.0F, 2.0F, 3.0F));
    ASSERT_EQ(shape.hulls.size(), 1U);
    EXPECT_TRUE(shape.hulls[0].bounds.isApprox(Box3f(Vec3f::Zero(), Vec3f(64.0F, 8.0F, 96.0F))));
    EXPECT_EQ(shape.hulls[0].half_spaces.size(), 18U) << "six faces, twelve edges";
    EXPECT_EQ(count_of(made, "movers"), 1.0);
    EXPECT_EQ(count_of(made, "half spaces"), 18.0);
}

TEST(MoverShapes, TheDistanceToABoxIsALowerBoundAndTightAtFacesAndEdges) {
    const Box3d box(Vec3d(-300.3, 10.1, -4.7), Vec3d(-20.9, 31.7, 90.2));
    const Shapes made = shapes_of({door({box_part(box)})});
    std::mt19937 random(11);
    std::uniform_real_distribution<double> spread(-1.0, 1.0);
    for (int i = 0; i < 2'000; ++i) {
        const Vec3d point =
            box.center() + Vec3d(spread(random), spread(random), spread(random)).cwiseProduct(box.sizes());
        const double distance = largest_distance(made.shapes[0].hulls[0], point);
        const double exact = box.exteriorDistance(point);
        EXPECT_LE(distance, exact + 1e-3);
        EXPECT_EQ(distance <= 0.0, box.contains(point)) << point.transpose();
        const Vec3d beyond = (box.min() - point).cwiseMax(point - box.max()).cwiseMax(0.0);
        const bool at_a_corner = beyond.minCoeff() > 0.0;
        EXPECT_TRUE(exact == 0.0 || at_a_corner || distance >= 0.92 * exact - 1e-3) << point.transpose();
    }
}

TEST(MoverShapes, EverySolidIsWithinItsHull) {
    std::mt19937 random(12);
    std::uniform_real_distribution<double> spread(-1.6, 1.6);
    for (const int sides : {6, 9, 14, 30, 64}) {
        const ConvexPart part = round_part(random, sides);
        const Shapes made = shapes_of({door({part})});
        ASSERT_EQ(made.shapes.size(), 1U);
        EXPECT_EQ(freespace::find_movers_flaw(made.shapes), "");
        const freespace::ConvexHull& hull = made.shapes[0].hulls[0];
        for (int i = 0; i < 1'000; ++i) {
            const Vec3d point(spread(random), spread(random), spread(random));
            const bool inside = std::all_of(part.planes.begin(), part.planes.end(), [&](const Plane& plane) {
                return plane.normal.dot(point) <= plane.distance;
            });
            if (inside) {
                EXPECT_LE(largest_distance(hull, point), 1e-6);
                EXPECT_TRUE(hull.bounds.contains(point.cast<float>()));
            }
            EXPECT_TRUE(inside || largest_distance(hull, point) >= -1e-6) << "no face is lost";
        }
    }
}

TEST(MoverShapes, WhatExceedsTheLimitsIsLeftOut) {
    const ConvexPart box = box_part({Vec3d::Zero(), Vec3d::Ones()});
    EXPECT_EQ(shapes_of({door(std::vector(256, box))}).shapes.size(), 1U);
    const Shapes many_parts = shapes_of({door(std::vector(257, box)), door({box})});
    EXPECT_EQ(many_parts.shapes.size(), 1U);
    EXPECT_EQ(count_of(many_parts, "left out: movers of more than 256 solids"), 1.0);

    // A cone of so many sides that none of them hides another.
    ConvexPart cone{{{-Vec3d::UnitZ(), 0.0}}, {Vec3d(-1.0, -1.0, 0.0), Vec3d::Ones()}};
    for (int i = 0; i < 64; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 64.0;
        cone.planes.push_back({Vec3d(std::cos(angle), std::sin(angle), 1.0).normalized(), std::sqrt(0.5)});
    }
    const Shapes many_sides = shapes_of({door({cone})});
    EXPECT_TRUE(many_sides.shapes.empty());
    EXPECT_EQ(count_of(many_sides, "left out: movers with a solid of less than 4 or more than 64 faces"),
              1.0);

    const Shapes open = shapes_of({door({ConvexPart{{{Vec3d::UnitX(), 0.0}}, {}}})});
    EXPECT_TRUE(open.shapes.empty());

    std::vector<scene::Mover> movers(258, door({box}));
    const Shapes many_movers = shapes_of(movers);
    EXPECT_EQ(many_movers.shapes.size(), 256U);
    EXPECT_EQ(count_of(many_movers, "left out: more than 256 movers"), 2.0);
}

}  // namespace
}  // namespace camdir::bake
