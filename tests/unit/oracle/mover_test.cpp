#include "oracle/mover.hpp"

#include <gtest/gtest.h>

#include <random>

namespace camdir::oracle {
namespace {

scene::ConvexPart box_part(const Box3d& box) {
    scene::ConvexPart part{{}, box};
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        part.planes.push_back({Vec3d::Unit(axis), box.max()[axis]});
        part.planes.push_back({-Vec3d::Unit(axis), -box.min()[axis]});
    }
    return part;
}

// Two boxes with a slit between them.
const scene::Mover doors{"*1",
                         "func_door",
                         {box_part({Vec3d(-8.0, -64.0, 0.0), Vec3d(8.0, -2.0, 96.0)}),
                          box_part({Vec3d(-8.0, 2.0, 0.0), Vec3d(8.0, 64.0, 96.0)})},
                         Vec3d::Zero()};

bool holds(const Vec3d& point) {
    return touches(doors, point, point);
}

TEST(Mover, HoldsWhatIsInAPart) {
    EXPECT_TRUE(holds({0.0, 30.0, 50.0}));
    EXPECT_TRUE(holds({8.0, 2.0, 96.0})) << "on a corner";
    EXPECT_FALSE(holds({0.0, 0.0, 50.0})) << "in the slit";
    EXPECT_FALSE(holds({8.1, 30.0, 50.0}));
}

TEST(Mover, IsTouchedByWhatGoesThroughAPart) {
    EXPECT_TRUE(touches(doors, {-100.0, 30.0, 50.0}, {100.0, 30.0, 50.0}));
    EXPECT_TRUE(touches(doors, {-100.0, 30.0, 50.0}, {0.0, 30.0, 50.0})) << "ends inside";
    EXPECT_FALSE(touches(doors, {-100.0, 30.0, 50.0}, {-9.0, 30.0, 50.0})) << "ends before";
    EXPECT_FALSE(touches(doors, {-100.0, 0.0, 50.0}, {100.0, 0.0, 50.0})) << "through the slit";
    EXPECT_FALSE(touches(doors, {-100.0, 0.0, 50.0}, {0.0, 200.0, 50.0})) << "past an edge";
}

TEST(Mover, TouchIsThatOfManyPoints) {
    std::mt19937 random(21);
    std::uniform_real_distribution<double> spread(-100.0, 100.0);
    scene::Mover smaller = doors;
    for (scene::ConvexPart& part : smaller.parts)
        for (scene::Plane& plane : part.planes)
            plane.distance -= 0.2;
    for (int i = 0; i < 500; ++i) {
        const Vec3d from(spread(random), spread(random), spread(random));
        const Vec3d to(spread(random), spread(random), spread(random));
        bool found = false;
        for (int k = 0; k <= 4000 && !found; ++k)
            found = holds(from + (to - from) * (k / 4000.0));
        const bool touched = touches(doors, from, to);
        EXPECT_TRUE(touched || !found) << i;
        // What is touched between two of the points is only just: less of it is not.
        EXPECT_TRUE(!touched || found || !touches(smaller, from, to)) << i;
    }
}

TEST(Mover, LocalPointsUndoPlaceAndTurn) {
    const Placement placement{Vec3d(10.0, 20.0, 30.0),
                              Eigen::Quaterniond(Eigen::AngleAxisd(0.5 * 3.14159265358979, Vec3d::UnitZ()))};
    EXPECT_TRUE(placement.local({10.0, 25.0, 30.0}).isApprox(Vec3d(5.0, 0.0, 0.0), 1e-9));
}

}  // namespace
}  // namespace camdir::oracle
