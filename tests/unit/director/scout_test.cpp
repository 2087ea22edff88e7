#include "director/scout.hpp"

#include <gtest/gtest.h>

#include "support/plan.hpp"

namespace camdir::director {
namespace {

// Players in a row in an empty hall, 12 units apart, who look along it.
Scout row_of(const freespace::Freespace& freespace, const Vec3f& first, std::size_t players) {
    Scout scout;
    for (std::size_t i = 0; i < players; ++i) {
        scout.add_player();
        scout.players[i].eye = first + 12.0F * static_cast<float>(i) * Vec3f::UnitX();
        scout.players[i].present = scout.players[i].alive = true;
        scout.present.push_back(static_cast<direction::Index>(i));
    }
    while (!scout.finished())
        scout.look(freespace::Space(freespace), 1.0F);
    return scout;
}

class ScoutTest : public testing::Test {
  protected:
    void expect_nearest(std::size_t players);

    test::Plan plan_{{"############", "#..........#", "#..........#", "############"}};
    freespace::Freespace freespace_ = plan_.freespace();
};

TEST_F(ScoutTest, OfAFewEverybodyIsLookedAt) {
    constexpr std::size_t players = most_looked_at + 1;
    const Scout scout = row_of(freespace_, plan_.eye(1, 1), players);
    for (std::size_t i = 0; i < players; ++i) {
        EXPECT_EQ(scout.players[i].sees.count(), players - 1) << i;
        EXPECT_FALSE(scout.players[i].sees[i]);
        for (std::size_t before = i; before < players; ++before)
            EXPECT_TRUE(scout.takes[i].shown[before]);
    }
}

TEST_F(ScoutTest, OfManyTheNearest) {
    for (const std::size_t players : {most_looked_at + 2, std::size_t{45}})
        expect_nearest(players);
}

void ScoutTest::expect_nearest(std::size_t players) {
    const Scout scout = row_of(freespace_, plan_.eye(1, 1), players);
    const auto looks_at = [&](std::size_t self, std::size_t other) {
        const auto distance = [&](std::size_t i) { return i > self ? i - self : self - i; };
        std::size_t nearer = 0;
        for (std::size_t i = 0; i < players; ++i)
            nearer +=
                i != self && (distance(i) < distance(other) || (distance(i) == distance(other) && i < other));
        return other != self && nearer < most_looked_at;
    };
    for (std::size_t i = 0; i < players; ++i)
        for (std::size_t j = 0; j < players; ++j) {
            EXPECT_EQ(scout.players[i].sees[j], looks_at(i, j) || looks_at(j, i)) << i << ' ' << j;
            EXPECT_TRUE(j <= i || scout.takes[i].shown[j] == looks_at(i, j)) << i << ' ' << j;
        }
}

}  // namespace
}  // namespace camdir::director
