// What is joined to the spawn points by free space.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <queue>
#include <random>
#include <set>
#include <stop_token>

#include "oracle/reachability.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/q3_maps.hpp"

namespace camdir::oracle {
namespace {

// Two halls along x, with a wall of `thickness` at x = 0 that has a door of `width` in it; in the second
// hall a closed closet.
scene::Scene two_halls(double thickness, double width) {
    scene::q3::Bsp bsp = test::room_map(Box3d(Vec3d(-256.0, -128.0, 0.0), Vec3d(256.0, 128.0, 128.0)));
    const double left = -thickness / 2.0;
    const double right = thickness / 2.0;
    test::add_box(bsp, Box3d(Vec3d(left, -128.0, 0.0), Vec3d(right, -width / 2.0, 128.0)), test::stone);
    test::add_box(bsp, Box3d(Vec3d(left, width / 2.0, 0.0), Vec3d(right, 128.0, 128.0)), test::stone);
    const Box3d closet(Vec3d(150.0, 20.0, 0.0), Vec3d(250.0, 120.0, 100.0));
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        for (const bool low : {true, false}) {
            Box3d side = closet;
            (low ? side.max() : side.min())[axis] = low ? closet.min()[axis] + 4.0 : closet.max()[axis] - 4.0;
            test::add_box(bsp, side, test::stone);
        }
    }
    test::add_spawn_point(bsp, {-200.0, 0.0, 24.0});
    return test::scene_of(bsp);
}

// The scene's, with the oracle that it refers to.
class Reachable : public testing::Test {
  protected:
    void explore(const scene::Scene& scene) {
        oracle_.emplace(scene);
        reachability_.emplace(Reachability::explore(*oracle_, scene, {}, {}).value());
    }
    [[nodiscard]] bool reachable(const Vec3d& point) const { return reachability_->reachable(point); }

  private:
    std::optional<Oracle> oracle_;
    std::optional<Reachability> reachability_;
};

ReachedGrid explore(const Oracle& oracle, const scene::Scene& scene, double min_clearance) {
    return ReachedGrid::explore(oracle, scene, grid_pitch(scene), min_clearance, {}, {}).value();
}

TEST_F(Reachable, GoesThroughADoorAndIntoCorners) {
    explore(two_halls(16.0, 48.0));
    EXPECT_TRUE(reachable({-200.0, 0.0, 59.0}));
    EXPECT_TRUE(reachable({200.0, -100.0, 59.0})) << "behind the door";
    EXPECT_TRUE(reachable({255.9, -127.9, 127.9})) << "in a corner";
    EXPECT_TRUE(reachable({8.01, 127.9, 0.1})) << "behind the wall";
    EXPECT_FALSE(reachable({0.0, 100.0, 50.0})) << "in the wall";
    EXPECT_FALSE(reachable({200.0, 70.0, 50.0})) << "in the closet";
    EXPECT_FALSE(reachable({300.0, 0.0, 50.0})) << "in the void around the map";
    EXPECT_FALSE(reachable({1e5, 0.0, 50.0}));
    EXPECT_FALSE(reachable({std::numeric_limits<double>::infinity(), 0.0, 50.0}));
}

TEST_F(Reachable, NothingIsInAnEmptyScene) {
    explore({});
    EXPECT_FALSE(reachable(Vec3d::Zero())) << "no spawn point";
}

TEST_F(Reachable, ThinWallsHold) {
    explore(two_halls(0.25, 0.0));
    EXPECT_TRUE(reachable({-0.2, 50.0, 50.0}));
    EXPECT_FALSE(reachable({0.2, 50.0, 50.0}));
    EXPECT_FALSE(reachable({200.0, -100.0, 59.0}));
}

class SlowFlood {
  public:
    SlowFlood(const Oracle& oracle, const scene::Scene& scene, double min_clearance) : bounds_(scene.bounds) {
        std::queue<Eigen::Vector3i> frontier;
        const Eigen::Vector3i size = (bounds_.sizes() / pitch).array().ceil().matrix().cast<int>();
        std::set<std::array<int, 3>>& cells = cells_;
        const auto visit = [&](const Eigen::Vector3i& cell) {
            const bool is_open = bounds_.contains(centre(cell)) && (cell.array() >= 0).all() &&
                                 (cell.array() < size.array()).all() &&
                                 oracle.clearance(centre(cell)) > min_clearance;
            if (is_open && cells.insert({cell.x(), cell.y(), cell.z()}).second) frontier.push(cell);
        };
        for (const scene::SpawnPoint& spawn : scene.spawn_points) {
            visit(((spawn.eye - bounds_.min()) / pitch).array().floor().matrix().cast<int>());
        }
        for (; !frontier.empty(); frontier.pop()) {
            for (Eigen::Index axis = 0; axis < 3; ++axis) {
                for (const int step : {-1, 1}) {
                    Eigen::Vector3i next = frontier.front();
                    next[axis] += step;
                    visit(next);
                }
            }
        }
    }

    [[nodiscard]] Vec3d centre(const Eigen::Vector3i& cell) const {
        return bounds_.min() + pitch * (cell.cast<double>() + Vec3d::Constant(0.5));
    }
    [[nodiscard]] const std::set<std::array<int, 3>>& cells() const { return cells_; }

    static constexpr double pitch = 8.0;

  private:
    Box3d bounds_;
    std::set<std::array<int, 3>> cells_;
};

void expect_same_cells(const scene::Scene& scene, double min_clearance) {
    const Oracle oracle(scene);
    const ReachedGrid grid = explore(oracle, scene, min_clearance);
    const SlowFlood flood(oracle, scene, min_clearance);
    ASSERT_EQ(grid.reached_count(), flood.cells().size());
    for (const auto& [x, y, z] : flood.cells()) {
        ASSERT_TRUE(grid.reached(flood.centre({x, y, z})));
    }
}

TEST(ReachedGrid, IsTheFloodOfTheDefinition) {
    EXPECT_DOUBLE_EQ(grid_pitch(two_halls(16.0, 48.0)), 8.0);
    for (const double min_clearance : {4.0, 16.0, 30.0}) {
        SCOPED_TRACE(min_clearance);
        expect_same_cells(two_halls(16.0, 48.0), min_clearance);
    }
    int compared = 0;
    for (unsigned seed = 7; compared < 2; ++seed) {
        SCOPED_TRACE(seed);
        std::mt19937 random(seed);
        const scene::Scene scene = test::scene_of(test::random_map(random, 15));
        // Where the eye is so free that its own cell is open, as the definition starts.
        if (Oracle(scene).clearance(scene.spawn_points.front().eye) < 12.0) continue;
        expect_same_cells(scene, 4.0);
        ++compared;
    }
}

TEST(ReachedGrid, NarrowDoorClosesForALargeClearance) {
    const scene::Scene scene = two_halls(16.0, 48.0);
    const Oracle oracle(scene);
    const Vec3d behind(100.0, -64.0, 64.0);
    const ReachedGrid narrow = explore(oracle, scene, 16.0);
    const ReachedGrid wide = explore(oracle, scene, 26.0);
    EXPECT_TRUE(narrow.joined(behind));
    EXPECT_FALSE(wide.joined(behind));
    EXPECT_TRUE(wide.joined({-200.0, 0.0, 59.0}));
    EXPECT_FALSE(narrow.joined({200.0, 70.0, 50.0})) << "in the closet";
    EXPECT_FALSE(narrow.joined({0.0, 100.0, 50.0})) << "in the wall";
    EXPECT_TRUE(narrow.joined_box().contains(behind));
}

TEST(ReachedGrid, HasNothingWithoutASeedInFreeSpace) {
    scene::Scene scene = two_halls(16.0, 48.0);
    scene.spawn_points = {{Vec3d(0.0, 100.0, 50.0), 0.0, "seed"}, {Vec3d::Constant(1e6), 0.0, "seed"}};
    const Oracle oracle(scene);
    const ReachedGrid none = explore(oracle, scene, 4.0);
    EXPECT_EQ(none.reached_count(), 0U);
    EXPECT_FALSE(none.joined({-200.0, 0.0, 59.0}));
}

// Nothing but a floor, `metres` on a side and a tenth of that high.
scene::Scene plain(double metres) {
    const double side = metres / 0.0254;
    scene::Scene scene;
    scene.source = "plain.obj";
    scene.metres_per_unit = 0.0254;
    scene.vertices = {{0.0, 0.0, 0.0}, {side, 0.0, 0.0}, {side, side, 0.0}, {0.0, side, 0.0}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    scene.bounds = Box3d(Vec3d::Zero(), Vec3d(side, side, side / 10.0));
    scene.spawn_points.push_back({Vec3d(side / 2.0, side / 2.0, 64.0), 0.0, "seed"});
    return scene;
}

TEST(ReachedGrid, RefusesASquareKilometreBeforeItExplores) {
    const scene::Scene scene = plain(1000.0);
    const Oracle oracle(scene);
    int visits = 0;
    const auto grid = ReachedGrid::explore(oracle, scene, 8.0, 16.0, [&](std::uint64_t) { ++visits; }, {});
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::failed);
    EXPECT_THAT(grid.error().message, testing::AllOf(testing::StartsWith("plain.obj: "),
                                                     testing::HasSubstr("39370 x 39370 x 3937 map units"),
                                                     testing::HasSubstr("11919 million cells of 8 units"),
                                                     testing::HasSubstr("the limit is 2147 MB")));
    EXPECT_EQ(visits, 0);
    EXPECT_FALSE(Reachability::explore(oracle, scene, {}, {}));
}

TEST(ReachedGrid, RefusesAClearanceOfTooManyCells) {
    const scene::Scene scene = two_halls(16.0, 48.0);
    const Oracle oracle(scene);
    for (const double min_clearance : {1e5, 1e30}) {
        const auto grid = ReachedGrid::explore(oracle, scene, 8.0, min_clearance, {}, {});
        ASSERT_FALSE(grid);
        EXPECT_THAT(grid.error().message, testing::EndsWith("in cells of 8; the limit is 264"));
    }
}

TEST(ReachedGrid, StopsSoonAfterItIsAsked) {
    const scene::Scene scene = plain(300.0);
    const Oracle oracle(scene);
    std::stop_source stop;
    std::vector<std::uint64_t> visited;
    const auto grid = ReachedGrid::explore(
        oracle, scene, 8.0, 16.0,
        [&](std::uint64_t cells) {
            visited.push_back(cells);
            if (visited.size() == 3) stop.request_stop();
        },
        stop.get_token());
    ASSERT_FALSE(grid);
    EXPECT_EQ(grid.error().code, ErrorCode::interrupted);
    ASSERT_EQ(visited.size(), 3U) << "no progress after the stop";
    EXPECT_LT(visited[0], visited[1]);
    EXPECT_LT(visited[1], visited[2]);
}

class RealMap : public testing::TestWithParam<std::string> {};

TEST_P(RealMap, SpawnPointsAreReachableAndTheVoidIsNot) {
    const auto source = test::openarena_map(GetParam());
    if (!source) GTEST_SKIP() << test::needs_openarena_map(GetParam());
    const scene::Scene scene = scene::load(*source).value();
    const Oracle oracle(scene);
    const Reachability reachability = Reachability::explore(oracle, scene, {}, {}).value();
    for (const scene::SpawnPoint& spawn : scene.spawn_points) {
        EXPECT_TRUE(reachability.reachable(spawn.eye)) << spawn.eye.transpose();
    }
    for (int corner = 0; corner < 8; ++corner) {
        EXPECT_FALSE(reachability.reachable(scene.bounds.corner(static_cast<Box3d::CornerType>(corner))));
    }
}

INSTANTIATE_TEST_SUITE_P(OpenArena, RealMap, testing::ValuesIn(test::traced_maps()));

}  // namespace
}  // namespace camdir::oracle
