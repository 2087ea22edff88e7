#include "direction/footage.hpp"

#include <gtest/gtest.h>

#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::random_script;
using test::Script;

bool is_showing(const Footage& footage, Beat beat, std::size_t rush, Index player) {
    return (footage.showing(beat, player)[rush / Footage::word_bits] >> rush % Footage::word_bits & 1U) != 0;
}

// 60 rushes that follow and 10 fixed ones take two words.
TEST(Footage, KnowsWhichRushesShowAPlayer) {
    std::mt19937 random(11);
    const Footage footage = random_script(60, 5, random, 10).footage();
    for (Beat beat = 0; beat < footage.beats(); ++beat)
        for (std::size_t rush = 0; rush < footage.rushes(); ++rush) {
            for (Index player = 0; player < footage.players(); ++player)
                ASSERT_EQ(is_showing(footage, beat, rush, player), footage.take(beat, rush).shown[player]);
            ASSERT_FALSE(is_showing(footage, beat, rush, nobody));
        }
}

TEST(Footage, MeetingsAreOfLivingEnemiesInSight) {
    std::mt19937 random(12);
    Script script = random_script(6, 40, random);
    for (std::size_t beat = 0; beat < 40; ++beat)
        for (std::size_t player = 0; player < 6; ++player)
            script.player(beat, player).team = static_cast<std::uint8_t>(random() % 3);
    const Footage footage = script.footage();
    for (Beat beat = 0; beat < footage.beats(); ++beat) {
        std::size_t met = 0;
        for (Index a = 0; a < 6; ++a)
            for (Index b = a + 1; b < 6; ++b) {
                const PlayerState& one = footage.player(beat, a);
                const PlayerState& other = footage.player(beat, b);
                if (!one.alive || !other.alive || !one.sees[b] || !enemies(one, other)) continue;
                ASSERT_LT(met, footage.meetings_at(beat).size());
                const Meeting& meeting = footage.meetings_at(beat)[met++];
                EXPECT_EQ(meeting.a, a);
                EXPECT_EQ(meeting.b, b);
                EXPECT_FLOAT_EQ(meeting.distance, 100.0F * static_cast<float>(b - a));
                EXPECT_FLOAT_EQ(meeting.cosine, 1.0F) << "a looks along x, to b";
            }
        EXPECT_EQ(met, footage.meetings_at(beat).size());
    }
}

TEST(Footage, KnowsTheJumpsOfEachRush) {
    std::mt19937 random(13);
    Footage footage = random_script(5, 60, random, 2).footage();
    for (const Beat forgotten : {0, 7, 60}) {
        footage.forget_before(forgotten);
        for (std::size_t rush = 0; rush < footage.rushes(); ++rush) {
            std::vector<Beat> jumps;
            for (Beat beat = footage.first(); beat < footage.beats(); ++beat)
                if (footage.take(beat, rush).cut) jumps.push_back(beat);
            EXPECT_EQ(footage.jumps(rush), jumps) << rush;
        }
    }
    footage.add_player();
    EXPECT_TRUE(footage.jumps(footage.rushes() - 1).empty());
}

TEST(Footage, WhoComesLaterIsShownByNoRushBefore) {
    Footage footage(0, {nobody});
    const std::vector<Take> takes(1);
    footage.append({}, takes);
    footage.add_player();
    EXPECT_EQ(footage.rushes(), 2U);
    EXPECT_TRUE(footage.is_fixed(0));
    EXPECT_EQ(footage.rush_following(0), 1U);
    EXPECT_EQ(footage.take(0, 1).subject, 0);
    EXPECT_FALSE(is_showing(footage, 0, 1, 0));
}

// From one word of rushes to three.
TEST(Footage, WhoComesLaterChangesNothingOfWhatWasShown) {
    std::mt19937 random(14);
    const Script script = random_script(60, 5, random, 2);
    const Footage before = script.footage();
    Footage footage = before;
    for (int i = 0; i < 80; ++i)
        footage.add_player();
    ASSERT_EQ(footage.words(), 3U);
    for (Beat beat = 0; beat < footage.beats(); ++beat)
        for (std::size_t rush = 0; rush < footage.rushes(); ++rush) {
            for (Index player = 0; player < footage.players(); ++player)
                ASSERT_EQ(is_showing(footage, beat, rush, player),
                          rush < before.rushes() && player < 60 && before.take(beat, rush).shown[player]);
            ASSERT_FALSE(is_showing(footage, beat, rush, nobody));
        }
}

TEST(Footage, APictureIsOfTheNearestWhoMeetsAnEnemy) {
    Script script(4, 1);  // 100 units apart along x
    Take take;
    const auto subject = [&] {
        const Footage footage = script.footage();
        return subject_in(take, footage.players_at(0));
    };
    EXPECT_EQ(subject(), nobody);
    take.shown.set(1).set(2).set(3);
    EXPECT_EQ(subject(), 1);
    script.meet(0, 2, 0);
    script.meet(0, 3, 0);
    EXPECT_EQ(subject(), 2);
    script.player(0, 2).alive = false;
    EXPECT_EQ(subject(), 3);
    script.player(0, 0).alive = false;
    EXPECT_EQ(subject(), 1) << "nobody meets anybody";
}

}  // namespace
}  // namespace camdir::direction
