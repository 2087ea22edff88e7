#include "freespace/movers.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "support/mover_twins.hpp"

namespace camdir::freespace {
namespace {

using test::box_hull;
using test::PlacedMover;
using testing::HasSubstr;

constexpr float infinity = std::numeric_limits<float>::infinity();

// A door of 8 x 64 x 96 units, by its name.
MoverShape door(const std::string& name = "*1") {
    MoverShape shape;
    shape.name = name;
    shape.kind = "func_door";
    shape.hulls.push_back(box_hull({-4, -32, 0}, {4, 32, 96}));
    return shape;
}

Movers movers_of(const std::vector<MoverShape>& shapes) {
    auto movers = Movers::of(shapes);
    if (!movers) throw std::runtime_error(movers.error().message);
    return *std::move(movers);
}

std::size_t add(Movers& movers, double time, const std::vector<MoverPose>& poses) {
    return movers.add(time, poses);
}

MoverPose at(const Vec3f& position, std::uint32_t mover = 0, const Quatf& orientation = Quatf::Identity()) {
    return {mover, position, orientation};
}

TEST(Movers, WithoutAPoseThereIsNothing) {
    const Movers none_at_all;
    EXPECT_EQ(none_at_all.distance(Vec3f::Zero(), 0.0).value, infinity);
    EXPECT_TRUE(none_at_all.sweep({-50, 0, 50}, {50, 0, 50}, 5.0F, 0.0).clear);
    Movers movers = movers_of({door()});
    EXPECT_EQ(movers.distance({0, 0, 50}, 0.0).value, infinity);
    EXPECT_TRUE(movers.sweep({-50, 0, 50}, {50, 0, 50}, 5.0F, 0.0).clear);
    EXPECT_FALSE(movers.pose_at(0, 0.0));
    add(movers, 1.0, {at(Vec3f::Zero())});
    EXPECT_TRUE(movers.sweep({-50, 0, 50}, {50, 0, 50}, 5.0F, 0.9).clear) << "before its first pose";
    EXPECT_FALSE(movers.sweep({-50, 0, 50}, {50, 0, 50}, 5.0F, 1.0).clear);
    EXPECT_FALSE(movers.sweep({-50, 0, 50}, {50, 0, 50}, 5.0F, 100.0).clear) << "it stands";
    EXPECT_FALSE(movers.sweep({-50, 0, 50}, 1.0, {50, 0, 50}, 1e12, 5.0F).clear) << "the clock has leapt";
}

TEST(Movers, ADoorIsInTheWayWhereItIs) {
    Movers movers = movers_of({door()});
    add(movers, 0.0, {at({100, 0, 0})});
    const MoverDistance beside = movers.distance({90, 0, 50}, 0.0);
    EXPECT_FLOAT_EQ(beside.value, 6.0F);
    EXPECT_EQ(beside.mover, 0U);
    EXPECT_EQ(beside.way_out, -Vec3f::UnitX());
    EXPECT_FLOAT_EQ(movers.distance({98, 0, 50}, 0.0).value, -2.0F);
    EXPECT_EQ(movers.distance({90, 0, 50}, 0.0, 5.0F).value, 5.0F) << "the limit";
    EXPECT_EQ(movers.distance({90, 0, 50}, 0.0, 5.0F).mover, none);

    const MoverSweep line = movers.sweep({0, 0, 50}, {200, 0, 50}, 0.0F, 0.0);
    EXPECT_FALSE(line.clear);
    EXPECT_FLOAT_EQ(line.free_share, 96.0F / 200.0F);
    EXPECT_EQ(line.mover, 0U);
    EXPECT_EQ(line.normal, -Vec3f::UnitX());
    EXPECT_FLOAT_EQ(movers.sweep({0, 0, 50}, {200, 0, 50}, 6.0F, 0.0).free_share, 90.0F / 200.0F);
    EXPECT_TRUE(movers.sweep({0, 0, 99}, {200, 0, 99}, 0.0F, 0.0).clear);
    EXPECT_FALSE(movers.sweep({0, 0, 99}, {200, 0, 99}, 4.0F, 0.0).clear);
}

TEST(Movers, MoveFromPoseToPoseAndALittleFurther) {
    Movers movers = movers_of({door(), door("*2")});
    add(movers, 1.0, {at({0, 0, 0}), at({0, 500, 0}, 1)});
    add(movers, 2.0, {});
    add(movers, 2.1, {at({0, 0, 10})});
    const auto height = [&](double time) { return movers.pose_at(0, time)->position.z(); };
    EXPECT_FLOAT_EQ(height(2.0), 0.0F) << "a frame that does not name it says that it stands";
    EXPECT_FLOAT_EQ(height(2.05), 5.0F);
    EXPECT_FLOAT_EQ(height(2.1), 10.0F);
    EXPECT_FLOAT_EQ(height(2.2), 20.0F);
    EXPECT_FLOAT_EQ(height(9.0), 35.0F) << "prediction is 0.25 s";
    EXPECT_EQ(movers.pose_at(1, 9.0)->position, Vec3f(0, 500, 0));
    add(movers, 2.2, {});
    EXPECT_FLOAT_EQ(height(2.25), 10.0F) << "it has stopped";
}

TEST(Movers, TurnAboutTheirOrigin) {
    Movers movers = movers_of({door()});
    const auto turned = [](float degrees) {
        return Quatf(Eigen::AngleAxisf(degrees * radians_of_a_degree<float>, Vec3f::UnitZ()));
    };
    add(movers, 0.0, {at({0, 0, 0})});
    add(movers, 0.1, {at({0, 0, 0}, 0, turned(90.0F))});
    EXPECT_NEAR(movers.distance({0, 20, 50}, 0.0).value, -4.0F, 1e-4F);
    EXPECT_NEAR(movers.distance({0, 20, 50}, 0.1).value, 16.0F, 1e-4F);
    EXPECT_NEAR(movers.pose_at(0, 0.05)->orientation.angularDistance(turned(45.0F)), 0.0F, 1e-3F);
    EXPECT_NEAR(movers.pose_at(0, 0.15)->orientation.angularDistance(turned(135.0F)), 0.0F, 1e-3F);
    EXPECT_NEAR(movers.distance({0, 20, 50}, 0.2).value, -4.0F, 1e-3F) << "half a turn, as predicted";
}

TEST(Movers, ThatComeOverAPlaceAreInItsWay) {
    Movers movers = movers_of({door()});
    add(movers, 0.0, {at({-20, 0, 0})});
    add(movers, 0.02, {at({20, 0, 0})});
    const Vec3f place(0, 0, 50);
    EXPECT_TRUE(movers.sweep(place, place, 2.0F, 0.0).clear);
    EXPECT_TRUE(movers.sweep(place, place, 2.0F, 0.02).clear);
    const MoverSweep overtaken = movers.sweep(place, 0.0, place, 0.02, 0.0F);
    EXPECT_FALSE(overtaken.clear);
    EXPECT_FLOAT_EQ(overtaken.free_share, 16.0F / 40.0F);
    EXPECT_EQ(overtaken.normal, Vec3f::UnitX());
    const Vec3f ahead = movers.carried(0, place, 0.0, 0.02);
    EXPECT_EQ(ahead, Vec3f(40, 0, 50));
    EXPECT_TRUE(movers.sweep(place, 0.0, ahead, 0.02, 2.0F).clear);
}

TEST(Movers, RefuseWhatIsNoPose) {
    Movers movers = movers_of({door()});
    EXPECT_EQ(add(movers, NAN, {at({0, 0, 0})}), 1U);
    EXPECT_EQ(add(movers, 1.0, {at({0, 0, 0}), at({0, 0, 0}, 1), at({NAN, 0, 0}), at({2e8F, 0, 0})}), 3U);
    EXPECT_EQ(add(movers, 1.5, {at({0, 0, 0}, 0, Quatf(2, 0, 0, 0))}), 1U);
    EXPECT_EQ(add(movers, 1.5, {at({0, 0, 0})}), 1U) << "not later";
    const Vec3f nowhere(NAN, 0, 0);
    EXPECT_EQ(movers.distance(nowhere, 1.0).value, -infinity);
    EXPECT_FALSE(movers.sweep(nowhere, {0, 0, 0}, 0.0F, 1.0).clear);
    EXPECT_EQ(movers.sweep(nowhere, {0, 0, 0}, 0.0F, 1.0).free_share, 0.0F);
}

TEST(Movers, RefuseShapesBeyondTheLimits) {
    const auto error_of = [](const std::vector<MoverShape>& shapes) {
        const auto movers = Movers::of(shapes);
        return movers ? std::string() : movers.error().message;
    };
    EXPECT_THAT(error_of(std::vector<MoverShape>(max_movers + 1)), HasSubstr("257 movers"));
    EXPECT_THAT(error_of({door("*7"), door("*7")}), HasSubstr("*7"));
    MoverShape shape = door();
    shape.hulls.assign(max_hulls + 1, shape.hulls[0]);
    EXPECT_THAT(error_of({shape}), HasSubstr("257 hulls"));
    shape = door();
    shape.hulls[0].half_spaces.resize(3);
    EXPECT_THAT(error_of({shape}), HasSubstr("3 half spaces"));
    shape = door();
    shape.hulls[0].half_spaces[2].normal *= 2.0F;
    EXPECT_THAT(error_of({shape}), HasSubstr("normal"));
    shape = door();
    shape.hulls[0].bounds.setEmpty();
    EXPECT_THAT(error_of({shape}), HasSubstr("bounds"));
    shape = door();
    shape.balls.push_back({Vec3f::Zero(), NAN});
    EXPECT_THAT(error_of({shape}), HasSubstr("ball 0"));
}

TEST(Movers, ForgetWhatIsNoLongerAsked) {
    Movers movers = movers_of({door()});
    for (int i = 0; i <= 100; ++i)
        add(movers, 0.1 * i, {at({static_cast<float>(i), 0, 0})});
    movers.forget_before(5.05);
    EXPECT_FLOAT_EQ(movers.pose_at(0, 5.05)->position.x(), 50.5F);
    EXPECT_FALSE(movers.pose_at(0, 4.9));
    movers.forget_before(1000.0);
    EXPECT_FLOAT_EQ(movers.pose_at(0, 1000.0)->position.x(), 100.0F);
    for (int i = 0; i < 3000; ++i)
        add(movers, 2000.0 + i, {at({static_cast<float>(i), 0, 0})});
    EXPECT_FALSE(movers.pose_at(0, 2000.0)) << "no more than most_poses are kept";
    EXPECT_TRUE(movers.pose_at(0, 2000.0 + 3000 - Movers::most_poses / 2));
}

// Random movers on their way through two frames.
class RandomMovers {
  public:
    explicit RandomMovers(std::mt19937& random) {
        std::uniform_real_distribution<float> place(-120.0F, 120.0F);
        const auto position = [&] { return Vec3f(place(random), place(random), place(random)); };
        std::vector<MoverPose> first;
        std::vector<MoverPose> second;
        for (std::uint32_t i = 0; i < 6; ++i) {
            shapes_.push_back(test::random_mover(random, "*" + std::to_string(i)));
            const Quatf orientation = test::random_rotation(random, 3.0F);
            first.push_back(at(position(), i, orientation));
            const bool turns = random() % 2 == 0;
            second.push_back(at(first[i].position + 0.1F * position(), i,
                                turns ? test::random_rotation(random, 0.1F) * orientation : orientation));
        }
        movers = movers_of(shapes_);
        movers.add(0.0, first);
        movers.add(frame, second);
    }

    [[nodiscard]] std::vector<PlacedMover> placed_at(double time) const {
        std::vector<PlacedMover> placed;
        for (std::uint32_t i = 0; i < shapes_.size(); ++i) {
            const auto pose = movers.pose_at(i, time);
            placed.emplace_back(shapes_[i], pose->position.cast<double>(), pose->orientation.cast<double>());
        }
        return placed;
    }

    static constexpr double frame = 0.02;
    Movers movers;

  private:
    std::vector<MoverShape> shapes_;
};

double distance_of(const std::vector<PlacedMover>& movers, const Vec3d& point) {
    double least = infinity;
    for (const PlacedMover& mover : movers)
        least = std::min(least, mover.distance(point));
    return least;
}

Vec3f point_among_them(std::mt19937& random) {
    std::uniform_real_distribution<float> place(-180.0F, 180.0F);
    return {place(random), place(random), place(random)};
}

constexpr double rounding = 1e-3;

TEST(Movers, DistancesAreLowerBoundsOfTheExactOnes) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const RandomMovers scene(random);
        for (const double time : {0.0, 0.3 * RandomMovers::frame, 1.5 * RandomMovers::frame}) {
            const auto placed = scene.placed_at(time);
            double missing = 0.0;
            for (int i = 0; i < 60; ++i) {
                const Vec3f point = point_among_them(random);
                const double exact = distance_of(placed, point.cast<double>());
                const MoverDistance found = scene.movers.distance(point, time);
                ASSERT_LE(found.value, exact + rounding);
                ASSERT_EQ(found.value <= 0.0F, exact <= rounding) << found.value << ", " << exact;
                missing += exact - found.value;
                const MoverDistance limited = scene.movers.distance(point, time, 20.0F);
                ASSERT_FLOAT_EQ(limited.value, std::min(found.value, 20.0F));
            }
            EXPECT_LT(missing / 60.0, 12.0) << "they are near the exact ones";
        }
    }
}

TEST(Movers, FreeWaysAreFreeAndBlockedOnesAreNot) {
    int blocked = 0;
    int clear = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const RandomMovers scene(random);
        const auto placed = scene.placed_at(0.01);
        for (int i = 0; i < 40; ++i) {
            const Vec3f from = point_among_them(random);
            const Vec3f to = point_among_them(random);
            const float radius = i % 2 == 0 ? 0.0F : 4.0F;
            const MoverSweep swept = scene.movers.sweep(from, to, radius, 0.01);
            const Vec3d way = (to - from).cast<double>();
            const auto point = [&](double share) { return Vec3d(from.cast<double>() + share * way); };
            constexpr int samples = 60;
            for (int k = 1; swept.free_share > 0.0F && k < samples; ++k) {
                const double share = static_cast<double>(swept.free_share) * k / samples;
                ASSERT_GT(distance_of(placed, point(share)), std::max(radius - rounding, 0.0));
            }
            ++(swept.clear ? clear : blocked);
            if (swept.clear) continue;
            const Vec3f end = point(swept.free_share).cast<float>();
            EXPECT_LE(scene.movers.distance(end, 0.01).value, 1.74F * radius + 0.01F) << "something is there";
        }
    }
    EXPECT_GT(blocked, 50);
    EXPECT_GT(clear, 50);
}

// What turns by 0.1 in a frame, 120 units from its origin, goes by so much off the chord.
constexpr double off_chord = 0.2;

TEST(Movers, WaysWhileTheyMoveAreJudgedInstantByInstant) {
    int blocked = 0;
    int clear = 0;
    for (unsigned seed = 1; seed <= 8; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        std::mt19937 random(seed);
        const RandomMovers scene(random);
        constexpr int instants = 100;
        std::vector<std::vector<PlacedMover>> placed;
        for (int k = 0; k <= instants; ++k)
            placed.push_back(scene.placed_at(RandomMovers::frame * k / instants));
        for (int i = 0; i < 40; ++i) {
            const Vec3f from = point_among_them(random);
            const Vec3f to = from + 0.2F * (point_among_them(random) - from);
            const MoverSweep swept = scene.movers.sweep(from, 0.0, to, RandomMovers::frame, 0.0F);
            double deepest = 0.0;  // how surely something is in the way
            for (int k = 0; k <= instants; ++k) {
                const float share = static_cast<float>(k) / instants;
                const Vec3f point = from + share * (to - from);
                const double time = RandomMovers::frame * k / instants;
                const bool inside =
                    distance_of(placed[static_cast<std::size_t>(k)], point.cast<double>()) == 0.0;
                const double depth = scene.movers.distance(point, time).value;
                ASSERT_FALSE(share < swept.free_share && inside && depth < -off_chord);
                deepest = std::min(deepest, depth);
            }
            EXPECT_FALSE(swept.clear && deepest < -off_chord);
            ++(swept.clear ? clear : blocked);
        }
    }
    EXPECT_GT(blocked, 20);
    EXPECT_GT(clear, 50);
}

}  // namespace
}  // namespace camdir::freespace
