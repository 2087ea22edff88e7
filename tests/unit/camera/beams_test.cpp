// Lines of sight that are remembered, against exact clearances.
#include "camera/beams.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <random>

#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"
#include "walk.hpp"

namespace camdir::camera {
namespace {

float exact_clearance(const test::Plan& plan, const Vec3f& from, const Vec3f& to) {
    constexpr int parts = 64;
    float least = std::numeric_limits<float>::infinity();
    for (int i = 0; i <= parts; ++i)
        least = std::min(least, plan.clearance(from + static_cast<float>(i) / parts * (to - from)));
    return least;
}

TEST(FreeBeams, StayFreeWhileTheirEndsMoveByLessThanTheyHaveToSpare) {
    const test::Plan plan = test::figure_eight();
    const freespace::Freespace freespace = plan.freespace();
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    const auto direction = [&] { return Vec3f(normal(random), normal(random), normal(random)).normalized(); };
    Runner runner(plan, plan.eye('s'), 9);
    constexpr float radius = 2.0F;
    int covered = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3f eye = runner.next(0.1F).eye;
        const Vec3f end = eye + 60.0F * direction();
        const freespace::Sight sight = freespace::sight(freespace, eye, end, radius);
        if (!sight.clear) continue;
        const FreeBeam beam{eye, end, sight.clearance};
        const float spare = beam.clearance - radius;
        ASSERT_GE(spare, -1e-5F);
        EXPECT_FALSE(beam.covers(eye + 1.01F * (spare + 0.01F) * direction(), end, radius));
        EXPECT_FALSE(beam.covers(eye, end + 1.01F * (spare + 0.01F) * direction(), radius));
        const Vec3f near_eye = eye + 0.99F * spare * direction();
        const Vec3f near_end = end + 0.99F * spare * direction();
        if (!beam.covers(near_eye, near_end, radius)) continue;
        ++covered;
        EXPECT_GE(exact_clearance(plan, near_eye, near_end), radius - 1e-3F);
    }
    EXPECT_GT(covered, 500);
    EXPECT_FALSE(FreeBeam().covers(Vec3f::Zero(), Vec3f::Zero(), 0.0F));
}

TEST(FreeBeams, MoveAlongWithThePlan) {
    FreeBeams beams;
    for (std::size_t i = 0; i < Future::capacity; ++i)
        beams.of_sample(i).clearance = static_cast<float>(i);
    beams.advance(5);
    EXPECT_EQ(beams.of_sample(0).clearance, 5.0F);
    EXPECT_EQ(beams.number(0), 5U);
    EXPECT_EQ(beams.of_sample(Future::capacity - 6).clearance, static_cast<float>(Future::capacity - 1));
    EXPECT_LT(beams.of_sample(Future::capacity - 5).clearance, 0.0F);
    beams.advance(Future::capacity + 1);
    for (std::size_t i = 0; i < Future::capacity; ++i)
        EXPECT_LT(beams.of_sample(i).clearance, 0.0F);
}

TEST(FreeLengths, AreSharedByTheEyesOfACellAndByNoOthers) {
    constexpr float cell = 16.0F;
    const auto lengths = std::make_unique<FreeLengths>();
    std::mt19937 random(4);
    std::uniform_int_distribution<int> place(-40, 40);
    std::uniform_real_distribution<float> within(0.0F, 15.9F);
    std::uniform_int_distribution<std::size_t> bins(0, DirectionGrid::size - 1);
    const auto value = [](const Vec3f& corner, std::size_t bin) {
        return 1.0F + std::abs(corner.x()) + 50.0F * std::abs(corner.y()) + static_cast<float>(bin);
    };
    int known = 0;
    for (int i = 0; i < 100'000; ++i) {
        const Vec3f corner = cell * Vec3f(static_cast<float>(place(random) / 20),
                                          static_cast<float>(place(random) / 20), -3.0F);
        const Vec3f eye = corner + Vec3f(within(random), within(random), within(random));
        const std::size_t bin = bins(random);
        float& length = lengths->at(eye, bin, cell);
        if (length >= 0.0F) {
            ++known;
            EXPECT_EQ(length, value(corner, bin));
        }
        length = value(corner, bin);
    }
    EXPECT_GT(known, 1000);
}

TEST(FreeLengths, ForgetWhatAnotherProfileAskedFor) {
    const auto lengths = std::make_unique<FreeLengths>();
    lengths->use(120.0F, 4.5F);
    lengths->at(Vec3f::Zero(), 7, 16.0F) = 100.0F;
    lengths->use(120.0F, 4.5F);
    EXPECT_EQ(lengths->at(Vec3f::Zero(), 7, 16.0F), 100.0F);
    lengths->use(60.0F, 4.5F);
    EXPECT_LT(lengths->at(Vec3f::Zero(), 7, 16.0F), 0.0F);
    lengths->at(Vec3f::Zero(), 7, 16.0F) = 50.0F;
    lengths->use(60.0F, 8.0F);
    EXPECT_LT(lengths->at(Vec3f::Zero(), 7, 16.0F), 0.0F);
}

// What a plan remembers changes no answer but to "free" where it is.
TEST(Beams, RememberNothingThatIsNotFree) {
    const MapProfile profile(Profile{}, 0.0254F);
    const test::Plan plan = test::l_corridor();
    const freespace::Freespace freespace = plan.freespace();
    const auto known = std::make_unique<FreeBeams>();
    const auto lengths = std::make_unique<FreeLengths>();
    const auto future = std::make_unique<Future>();
    future->count = 1;
    Runner runner(plan, plan.eye('s'), 2);
    int spared = 0;
    for (int i = 0; i < 3000; ++i) {
        const Pose pose = runner.next(1.0F / 60.0F);
        future->samples[0] = {pose.eye, {}};
        const Vec3f back = -(pose.orientation * Vec3f::UnitX());
        freespace::RecentBalls balls;
        freespace::RecentBalls other_balls;
        const auto unknown = std::make_unique<FreeBeams>();
        const auto remembered =
            Beams(freespace, profile, *future, *known, *lengths, balls).end(0, back, 90.0F);
        const auto asked =
            Beams(freespace, profile, *future, *unknown, *lengths, other_balls).end(0, back, 90.0F);
        if (remembered) {
            ASSERT_TRUE(asked);
            EXPECT_EQ(remembered->free_length, asked->free_length);
            EXPECT_EQ(remembered->normal, asked->normal);
        } else {
            const float radius = std::min(6.0F, 0.8F * freespace::distance(freespace, pose.eye).value);
            EXPECT_GE(exact_clearance(plan, pose.eye, pose.eye + 90.0F * back), radius - 1e-3F);
            if (known->of_sample(0).eye != pose.eye) ++spared;
        }
    }
    EXPECT_GT(spared, 50);
}

}  // namespace
}  // namespace camdir::camera
