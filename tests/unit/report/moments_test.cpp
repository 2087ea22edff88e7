#include "report/moments.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "report/film_strip.hpp"
#include "two_players.hpp"

namespace camdir::report {
namespace {

using evaluation::Judgement;
using Kind = Moment::Kind;
using testing::HasSubstr;

// 20 s of two players, 10 frames a second, all good.
class Moments : public testing::Test {
  protected:
    [[nodiscard]] Judgement& at(std::size_t frame, std::size_t player) {
        return judgements_[2 * frame + player];
    }

    void set_faults(std::size_t first, std::size_t last, std::size_t player, int faults) {
        for (std::size_t frame = first; frame < last; ++frame)
            at(frame, player).faults = static_cast<std::uint8_t>(faults);
    }

    [[nodiscard]] std::vector<Moment> worst(std::size_t max = 100) const {
        return worst_moments(trace_, judgements_, max);
    }

    const evaluation::Trace trace_ = two_players(200);
    std::vector<Judgement> judgements_{good_frames(trace_)};
};

TEST_F(Moments, OfAPerfectCameraAreNone) {
    EXPECT_TRUE(worst().empty());
}

TEST_F(Moments, AreTheLongestRunsOfFramesThatAreNotGood) {
    set_faults(10, 15, 0, evaluation::wrong_side);
    set_faults(50, 70, 0, evaluation::wrong_distance);
    set_faults(60, 63, 0, evaluation::wrong_side);
    set_faults(100, 110, 1, evaluation::out_of_frame);
    set_faults(150, 153, 1, evaluation::wrong_side);
    const auto moments = worst();
    ASSERT_EQ(moments.size(), 3U);
    EXPECT_EQ(moments[0].frames.first, 50U);
    EXPECT_EQ(moments[0].frames.last, 70U);
    EXPECT_EQ(moments[0].player, 0U);
    EXPECT_NEAR(moments[0].value, 2.0, 1e-9);
    EXPECT_EQ(moments[1].player, 1U);
    EXPECT_EQ(moments[2].frames.first, 10U);
    EXPECT_EQ(
        describe(moments[0], trace_, judgements_),
        "Not good for 2 s: too far off the view direction in 3 of 20 frames, too near or too far in 17 of "
        "20 frames");
    EXPECT_EQ(worst(1).size(), 1U);
}

TEST_F(Moments, AreTheMostSevereFirst) {
    set_faults(50, 70, 0, evaluation::wrong_side);
    set_faults(90, 92, 0, evaluation::hidden);
    at(120, 1).in_solid = true;
    at(140, 1).pop = at(160, 1).fly_through = true;
    at(140, 1).speed = 9000.0;
    at(160, 1).speed = 500.0;
    at(180, 1).motion.acceleration = 40000.0;
    at(195, 1).motion.angular_speed = 600.0;
    std::vector<Kind> kinds;
    std::string texts;
    for (const Moment& moment : worst()) {
        kinds.push_back(moment.kind);
        texts += describe(moment, trace_, judgements_) + '\n';
    }
    EXPECT_THAT(kinds, testing::ElementsAre(Kind::through, Kind::in_solid, Kind::jump, Kind::hidden,
                                            Kind::bad, Kind::acceleration, Kind::turn));
    EXPECT_THAT(texts, HasSubstr("Passes through an obstacle without a cut, at 500 units/s\n"));
    EXPECT_THAT(texts, HasSubstr("The player's eye is hidden for 0.2 s\n"));
    EXPECT_THAT(texts, HasSubstr("Turns at 600 degrees/s\n"));
}

TEST_F(Moments, AreASecondApart) {
    at(50, 0).motion.acceleration = 1000.0;
    at(55, 0).motion.acceleration = 3000.0;
    at(58, 0).motion.acceleration = 2000.0;
    at(62, 0).motion.acceleration = 2500.0;
    at(57, 1).motion.acceleration = 500.0;
    const auto moments = worst();
    ASSERT_EQ(moments.size(), 2U);
    EXPECT_EQ(moments[0].frames.first, 55U);
    EXPECT_EQ(moments[1].player, 1U);
}

TEST_F(Moments, HaveStripsWithinTheMatch) {
    const Interval begin = strip_interval({Kind::turn, 0, {0, 1}, 600.0}, trace_);
    EXPECT_EQ(begin.begin, 0.0);
    EXPECT_GT(begin.end, 0.0);
    const Interval end = strip_interval({Kind::bad, 0, {150, 200}, 5.0}, trace_);
    EXPECT_NEAR(end.begin, 14.8, 1e-9);
    EXPECT_NEAR(end.end, 19.9, 1e-9);
}

}  // namespace
}  // namespace camdir::report
