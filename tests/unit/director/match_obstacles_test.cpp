#include "director/match_obstacles.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "stage.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::director {
namespace {

using testing::ElementsAre;

Mover ball(std::uint32_t id, const std::string& model = {}) {
    Mover mover{id, {}};
    mover.shape.name = model;
    mover.shape.balls.push_back({Vec3f::Zero(), 5.0F});
    return mover;
}

std::shared_ptr<const MoverInfo> described(std::vector<Mover> movers) {
    return std::make_shared<const MoverInfo>(MoverInfo{1, std::move(movers)});
}

// Those of an info, each at some x.
std::shared_ptr<const MatchMovers> placed(const std::shared_ptr<const MoverInfo>& info,
                                          const std::vector<std::pair<std::uint32_t, float>>& movers) {
    auto frame = std::make_shared<MoverFrame>();
    frame->epoch = 1;
    for (const auto& [id, x] : movers)
        frame->poses.push_back({id, Vec3f(x, 0.0F, 0.0F), Quatf::Identity()});
    return std::make_shared<const MatchMovers>(MatchMovers{info, frame});
}

class MatchObstaclesTest : public testing::Test {
  protected:
    static freespace::Freespace map_with(const std::vector<std::string>& models) {
        freespace::Contents contents = test::square_contents();
        contents.movers.clear();
        for (const std::string& model : models) {
            freespace::MoverShape shape;
            shape.name = model;
            shape.balls.push_back({Vec3f::Zero(), 20.0F});
            contents.movers.push_back(shape);
        }
        return test::make_freespace(contents);
    }
    // The distance of the origin from the nearest mover.
    [[nodiscard]] float distance_at(double time) const {
        return obstacles_.movers().distance(Vec3f::Zero(), time).value;
    }

    const freespace::Freespace map_ = map_with({"*1", "*3"});
    MatchObstacles obstacles_;
};

TEST_F(MatchObstaclesTest, HaveTheMapsShapeByTheirModelOtherwiseTheirOwn) {
    obstacles_.set_map(&map_);
    const auto info = described({ball(7, "*3"), ball(8, "*9"), {9, {"*9", "", {}, {}}}, {10, {}}});
    EXPECT_TRUE(obstacles_.add(0.0, placed(info, {{7, 100.0F}})));
    EXPECT_NEAR(distance_at(0.0), 80.0F, 1e-2F) << "the map's ball is larger";
    EXPECT_FALSE(obstacles_.add(1.0, placed(info, {{7, 100.0F}, {8, 50.0F}, {9, 1.0F}, {99, 1.0F}})));
    EXPECT_NEAR(distance_at(1.0), 45.0F, 1e-2F) << "the map has no such model";
    EXPECT_EQ(obstacles_.count(), 2U);
    EXPECT_THAT(obstacles_.unknown(), ElementsAre("*9", "10"));
}

TEST_F(MatchObstaclesTest, AreNoneWithoutAMapAndAreFoundWhenItComes) {
    const auto info = described({ball(7, "*3")});
    EXPECT_TRUE(obstacles_.add(0.0, placed(info, {{7, 100.0F}})));
    EXPECT_EQ(obstacles_.count(), 0U);
    EXPECT_TRUE(std::isinf(distance_at(0.0)));
    obstacles_.set_map(&map_);
    EXPECT_EQ(obstacles_.count(), 1U);
    EXPECT_NEAR(distance_at(0.0), 80.0F, 1e-2F);
    obstacles_.set_map(nullptr);
    EXPECT_EQ(obstacles_.count(), 0U);
}

TEST_F(MatchObstaclesTest, StandStillWhileNoFrameMovesThem) {
    obstacles_.set_map(&map_);
    const auto info = described({ball(7)});
    const auto before = placed(info, {{7, 100.0F}});
    for (const double time : {0.0, 1.0, 2.0})
        obstacles_.add(time, before);
    obstacles_.add(2.1, placed(info, {{7, 50.0F}}));
    EXPECT_NEAR(distance_at(2.0), 95.0F, 1e-2F) << "nothing moves between two frames that say the same";
    EXPECT_NEAR(distance_at(2.1), 45.0F, 1e-2F);
}

TEST_F(MatchObstaclesTest, ComeAndGoWithTheirDescription) {
    obstacles_.set_map(&map_);
    const auto both = described({ball(7), ball(8)});
    obstacles_.add(0.0, placed(both, {{7, 100.0F}, {8, 50.0F}}));
    EXPECT_NEAR(distance_at(0.0), 45.0F, 1e-2F);
    const auto one = described({ball(7)});
    EXPECT_TRUE(obstacles_.add(0.1, placed(one, {{7, 100.0F}})));
    EXPECT_NEAR(distance_at(0.1), 95.0F, 1e-2F);
    EXPECT_TRUE(obstacles_.add(0.2, nullptr));
    EXPECT_EQ(obstacles_.count(), 0U);
    EXPECT_TRUE(std::isinf(distance_at(0.2)));
}

TEST_F(MatchObstaclesTest, AreNotMovedByFramesThatAreLate) {
    obstacles_.set_map(&map_);
    const auto info = described({ball(7)});
    obstacles_.add(100.0, placed(info, {{7, 100.0F}}));
    obstacles_.add(99.5, placed(info, {{7, 30.0F}}));
    EXPECT_NEAR(distance_at(100.0), 95.0F, 1e-2F) << "a frame that is late adds nothing";
    obstacles_.clear();
    EXPECT_TRUE(std::isinf(distance_at(100.0)));
    obstacles_.add(5.0, placed(info, {{7, 50.0F}}));
    EXPECT_NEAR(distance_at(5.0), 45.0F, 1e-2F);
}

TEST_F(MatchObstaclesTest, OfATimelineAreKnownAheadOfWhatIsShown) {
    obstacles_.set_map(&map_);
    const auto info = described({ball(7)});
    Timeline timeline;
    for (int i = 0; i <= 40; ++i) {
        PoseFrame frame;
        frame.frame_time = 50 * ms * i;
        frame.movers = placed(info, {{7, 100.0F - static_cast<float>(i)}});
        ASSERT_TRUE(timeline.add(frame, frame.poses));
    }
    timeline.show(0);
    EXPECT_TRUE(obstacles_.follow(timeline));
    EXPECT_FALSE(obstacles_.follow(timeline)) << "it has come to know nothing more";
    EXPECT_NEAR(distance_at(0.0), 95.0F, 1e-3F);
    EXPECT_NEAR(distance_at(2.0), 55.0F, 1e-3F);
    EXPECT_NEAR(distance_at(1.0), 75.0F, 1e-3F);
}

TEST_F(MatchObstaclesTest, KeepNoMoreThanIsAsked) {
    obstacles_.set_map(&map_);
    const auto info = described({ball(7)});
    for (int i = 0; i < 2000; ++i)
        obstacles_.add(0.05 * i, placed(info, {{7, static_cast<float>(i)}}));
    EXPECT_NEAR(distance_at(0.05 * 1999), 1994.0F, 1e-2F);
    EXPECT_TRUE(obstacles_.add(100.0, placed(described({ball(7)}), {{7, 5.0F}})))
        << "what is known is placed again among the new shapes";
    EXPECT_NEAR(distance_at(100.0), 0.0F, 1e-2F);
}

}  // namespace
}  // namespace camdir::director
