#include "freespace/fixed_shots.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "freespace/lookouts.hpp"
#include "freespace/visibility.hpp"
#include "support/plan.hpp"

namespace camdir::freespace {
namespace {

constexpr float unit = 1.0F;  // of the plans

bool shows(const Freespace& freespace, const FixedShot& shot, const Vec3f& point) {
    return frames(shot, point, unit) && sight(freespace, shot.position, point).clear;
}

TEST(FixedShots, TheFirstHasMoreInItsPictureThanAnyOther) {
    const Freespace freespace = test::l_corridor().freespace();
    const auto positions = freespace.lookouts().positions();
    const auto count = [&](const FixedShot& shot) {
        return std::ranges::count_if(positions,
                                     [&](const Vec3f& point) { return shows(freespace, shot, point); });
    };
    const auto shots = find_fixed_shots(freespace);
    ASSERT_FALSE(shots.empty());
    const auto most = count(shots.front());
    for (const Vec3f& place : positions)
        for (int turn = 0; turn < 16; ++turn)
            for (const float pitch : {-0.5F, -0.2F})
                EXPECT_LE(count({place, static_cast<float>(turn) * std::numbers::pi_v<float> / 8.0F, pitch}),
                          most);
}

TEST(FixedShots, StandAtLookoutsAndTogetherShowMostOfTheMap) {
    const Freespace freespace = test::l_corridor().freespace();
    const auto positions = freespace.lookouts().positions();
    const auto shots = find_fixed_shots(freespace);
    EXPECT_LE(shots.size(), max_fixed_shots);
    std::size_t shown = 0;
    for (const Vec3f& point : positions)
        shown +=
            std::ranges::any_of(shots, [&](const FixedShot& shot) { return shows(freespace, shot, point); });
    EXPECT_GT(static_cast<double>(shown), 0.8 * static_cast<double>(positions.size()));
    for (const FixedShot& shot : shots) {
        EXPECT_NE(std::ranges::find(positions, shot.position), positions.end());
        EXPECT_LT(shot.spawn_point, freespace.spawn_points().size());
    }
}

TEST(FixedShots, TheNearestSpawnPointNamesThem) {
    const Freespace freespace = test::l_corridor().freespace();
    const auto spawns = freespace.spawn_points();
    for (const FixedShot& shot : find_fixed_shots(freespace))
        for (const SpawnPoint& spawn : spawns)
            EXPECT_LE((spawns[shot.spawn_point].eye - shot.position).norm(),
                      (spawn.eye - shot.position).norm());
}

TEST(FixedShots, APictureIsNinetyDegreesWide) {
    const FixedShot shot{Vec3f::Zero(), 0.0F, 0.0F, none};
    EXPECT_TRUE(frames(shot, {100.0F, 99.0F, 0.0F}, unit));
    EXPECT_FALSE(frames(shot, {100.0F, 101.0F, 0.0F}, unit));
    EXPECT_TRUE(frames(shot, {100.0F, 0.0F, 56.0F}, unit));
    EXPECT_FALSE(frames(shot, {100.0F, 0.0F, -57.0F}, unit));
    EXPECT_FALSE(frames(shot, {-100.0F, 0.0F, 0.0F}, unit));
    EXPECT_FALSE(frames(shot, {fixed_shot_range + 1.0F, 0.0F, 0.0F}, unit));
    EXPECT_FALSE(frames(shot, {fixed_shot_range, 0.0F, 0.0F}, 0.5F * unit));
    const FixedShot down{Vec3f::Zero(), std::numbers::pi_v<float> / 2.0F, -0.5F, none};
    EXPECT_TRUE(frames(down, {0.0F, 100.0F, -55.0F}, unit));
    EXPECT_FALSE(frames(down, {0.0F, 100.0F, 55.0F}, unit));
}

}  // namespace
}  // namespace camdir::freespace
