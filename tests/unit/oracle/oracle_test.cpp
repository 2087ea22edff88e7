// The oracle against twins that look at every triangle and brush.
#include "oracle/oracle.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/oracle_twins.hpp"
#include "support/q3_maps.hpp"

namespace camdir::oracle {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double rounding = 1e-3;  // of coordinates below 2^11 to float, with room
const Box3d around(Vec3d(-280.0, -210.0, -150.0), Vec3d(280.0, 210.0, 150.0));

class RandomMap : public testing::TestWithParam<unsigned> {
  protected:
    std::mt19937 random_{GetParam()};
    scene::Scene scene_ = test::scene_of(test::random_map(random_, 12));
    Oracle oracle_{scene_};
};

TEST_P(RandomMap, ClearanceIsThatOfTheTwin) {
    int inside = 0;
    for (int i = 0; i < 800; ++i) {
        const Vec3d point = test::random_point_in(random_, around);
        const double expected = test::clearance(scene_, point);
        ASSERT_NEAR(oracle_.clearance(point), expected, 1e-9) << point.transpose();
        ASSERT_EQ(oracle_.in_solid(point), expected <= 0.0) << point.transpose();
        inside += expected <= 0.0 ? 1 : 0;
    }
    EXPECT_GT(inside, 20);
}

TEST_P(RandomMap, LimitHidesOnlyWhatIsFarther) {
    for (int i = 0; i < 2000; ++i) {
        const Vec3d point = test::random_point_in(random_, around);
        const double exact = oracle_.clearance(point);
        const double limit = std::uniform_real_distribution<double>(0.0, 40.0)(random_);
        ASSERT_EQ(oracle_.clearance(point, limit), exact <= limit ? exact : infinity);
        ASSERT_EQ(oracle_.clearance(point, std::max(exact, 0.0)), exact);
    }
}

TEST_P(RandomMap, SegmentsAgreeWithTheTwinOutsideOfRounding) {
    int clear = 0;
    int blocked = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3d from = test::random_point_in(random_, around);
        const Vec3d to = from + test::random_point_in(random_, around) * (i % 2 == 0 ? 1.0 : 0.1);
        const double distance = test::clearance(scene_, from, to);
        const bool answer = oracle_.segment_clear(from, to);
        if (distance > rounding) {
            ASSERT_TRUE(answer) << from.transpose() << " to " << to.transpose();
            ++clear;
        } else if (distance == 0.0) {
            ASSERT_FALSE(answer) << from.transpose() << " to " << to.transpose();
            ++blocked;
        }
        ASSERT_EQ(answer, oracle_.segment_clear(to, from));
    }
    EXPECT_GT(clear, 80);
    EXPECT_GT(blocked, 50);
}

TEST_P(RandomMap, ClearBallsHoldNoObstacle) {
    int clear = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3d centre = test::random_point_in(random_, around);
        const double radius = std::uniform_real_distribution<double>(0.0, 40.0)(random_);
        const double clearance = test::clearance(scene_, centre);
        if (!oracle_.ball_clear(centre, radius)) continue;
        ++clear;
        ASSERT_GT(clearance, radius);
        const Box3d cube(centre - Vec3d::Constant(radius), centre + Vec3d::Constant(radius));
        for (int k = 0; k < 20; ++k) {
            const Vec3d point = test::random_point_in(random_, cube);
            const bool is_in_ball = (point - centre).norm() <= radius;
            ASSERT_FALSE(is_in_ball && test::depth_in_solid(scene_, point) >= 0.0);
        }
    }
    EXPECT_GT(clear, 50);
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomMap, testing::Values(1U, 2U, 3U));

class Crate : public testing::Test {
  protected:
    static scene::Scene make() {
        scene::q3::Bsp bsp = test::room_map(Box3d(Vec3d::Constant(-128.0), Vec3d::Constant(128.0)));
        test::add_box(bsp, Box3d(Vec3d::Constant(-16.0), Vec3d::Constant(16.0)), test::stone);
        return test::scene_of(bsp);
    }
    Oracle oracle_{make()};
};

TEST_F(Crate, ClosedSegmentsTouch) {
    EXPECT_FALSE(oracle_.segment_clear({16.0, 3.0, 5.0}, {100.0, 3.0, 5.0})) << "starts on a face";
    EXPECT_FALSE(oracle_.segment_clear({100.0, 3.0, 5.0}, {16.0, 3.0, 5.0})) << "ends on a face";
    EXPECT_FALSE(oracle_.segment_clear({100.0, 16.0, 16.0}, {-100.0, 16.0, 16.0})) << "runs along an edge";
    EXPECT_FALSE(oracle_.segment_clear({16.0, 3.0, 5.0}, {16.0, 5.0, 3.0})) << "lies in a face";
    EXPECT_TRUE(oracle_.segment_clear({16.01, 3.0, 5.0}, {100.0, 3.0, 5.0}));
    EXPECT_TRUE(oracle_.segment_clear({50.0, 50.0, 50.0}, {50.0, 50.0, 50.0})) << "a free point";
    EXPECT_FALSE(oracle_.segment_clear({16.0, 0.0, 0.0}, {16.0, 0.0, 0.0})) << "a point on a face";
}

TEST_F(Crate, SharedEdgesDoNotLeak) {
    std::mt19937 random(5);
    for (int i = 0; i < 20000; ++i) {
        // Through the diagonal that the faces' triangles share, or next to it by rounding.
        const double t = std::uniform_real_distribution<double>(-15.0, 15.0)(random);
        const Vec3d target(0.0, t, i % 2 == 0 ? t : -t);
        const Vec3d from =
            Vec3d(100.0, 0.0, 0.0) +
            20.0 * test::random_point_in(random, {Vec3d::Constant(-1.0), Vec3d::Constant(1.0)});
        const Vec3d through(16.0, target.y(), target.z());
        ASSERT_FALSE(oracle_.segment_clear(from, from + (through - from) * 1.2)) << i;
    }
}

TEST_F(Crate, DepthIsNegativeClearance) {
    EXPECT_DOUBLE_EQ(oracle_.clearance(Vec3d::Zero()), -16.0);
    EXPECT_DOUBLE_EQ(oracle_.clearance({10.0, 0.0, 0.0}), -6.0);
    EXPECT_DOUBLE_EQ(oracle_.clearance({16.0, 0.0, 0.0}), 0.0);
    EXPECT_DOUBLE_EQ(oracle_.clearance({20.0, 0.0, 0.0}), 4.0);
    EXPECT_TRUE(oracle_.in_solid({16.0, 0.0, 0.0})) << "the surface belongs to the solid";
}

TEST_F(Crate, NumbersThatAreNotFiniteAreNowhereFree) {
    const Vec3d nowhere(std::nan(""), 0.0, 0.0);
    EXPECT_EQ(oracle_.clearance(nowhere), -infinity);
    EXPECT_FALSE(oracle_.segment_clear(nowhere, Vec3d::Zero()));
    EXPECT_FALSE(oracle_.ball_clear(nowhere, 1.0));
}

TEST(Oracle, EmptySceneIsFree) {
    const Oracle oracle{scene::Scene{}};
    EXPECT_EQ(oracle.clearance(Vec3d::Zero()), infinity);
    EXPECT_TRUE(oracle.segment_clear(Vec3d::Zero(), Vec3d::Ones()));
    EXPECT_FALSE(oracle.in_solid(Vec3d::Zero()));
}

TEST(Oracle, AgreesWithTheTwinOnARealMap) {
    const auto source = test::openarena_map("oa_dm3");
    if (!source) GTEST_SKIP() << test::needs_openarena_map("oa_dm3");
    const scene::Scene scene = scene::load(*source).value();
    const Oracle oracle(scene);
    std::mt19937 random(6);
    for (int i = 0; i < 200; ++i) {
        const Vec3d point = test::random_point_in(random, scene.bounds);
        ASSERT_NEAR(oracle.clearance(point), test::clearance(scene, point), 1e-9) << point.transpose();
    }
}

}  // namespace
}  // namespace camdir::oracle
