#include "direction/material.hpp"

#include <gtest/gtest.h>

#include "direction/cutter.hpp"
#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::kill;
using test::Script;

void append(Material& material, const Footage& footage, Beat end) {
    while (material.footage().beats() < end) {
        const Beat next = material.footage().beats();
        material.append(footage.players_at(next), footage.takes_at(next));
    }
}

TEST(Material, KeepsLessThanAMinute) {
    const Footage footage = Script(2, 2000).footage();
    Material material(2, test::following(2));
    for (Beat now = 0; now < footage.beats(); ++now) {
        append(material, footage, now + 1);
        material.forget_before(now);
        EXPECT_LT(now - material.footage().first(), 600);
    }
    EXPECT_EQ(material.footage().player(1999, 1).eye, footage.player(1999, 1).eye);
}

TEST(Material, EventsCountFromWhereTheyAreKnown) {
    const Footage footage = Script(2, 40).footage();
    Material material(2, test::following(2));
    material.add(kill(2.5, 0, 1));
    material.add(kill(1.5, 1, 0));
    append(material, footage, 20);
    const auto kills = [&] {
        const auto moments = material.moments(default_rules(), test::unit, 18);
        return std::ranges::count_if(moments, [](const Moment& moment) {
            return default_rules().moments[moment.rule].trigger == Trigger::kill;
        });
    };
    EXPECT_EQ(kills(), 1);
    append(material, footage, 30);
    EXPECT_EQ(kills(), 2);
}

TEST(Material, AFloodOfEventsIsBoundedAndItsKillsCountForTheLead) {
    Material material(2, test::following(2));
    for (std::size_t i = 0; i < 3 * Material::max_events; ++i)
        material.add(kill(1.0, 1, 0));
    append(material, Script(2, 30).footage(), 30);
    const Rules rules = default_rules();
    const auto moments = material.moments(rules, test::unit, 28);
    EXPECT_LE(moments.size(), 4 * Material::max_events);
    const auto lead = std::ranges::find_if(
        moments, [&](const Moment& moment) { return rules.moments[moment.rule].trigger == Trigger::lead; });
    ASSERT_NE(lead, moments.end());
    EXPECT_EQ(lead->actor, 1);
}

TEST(Material, PlayersMayComeLater) {
    const Footage two = Script(2, 20).footage();
    Material material(0, {});
    material.add_player();
    material.append(two.players_at(0).first(1), two.takes_at(0).first(1));
    material.add_player();
    append(material, two, 20);
    EXPECT_TRUE(material.footage().player(0, 0).present);
    EXPECT_FALSE(material.footage().player(0, 1).present);
    EXPECT_EQ(material.footage().player(1, 1).eye, two.player(1, 1).eye);
    EXPECT_TRUE(material.footage().take(1, 1).shown[1]);
    EXPECT_EQ(material.footage().rush_following(1), 1U);
    EXPECT_EQ(material.footage().take(0, 1).subject, 1);
}

TEST(Cutter, ChoosesFromWhatMayBeOnTheAir) {
    Material material(3, test::following(3));
    const Rules rules = default_rules();
    append(material, Script(3, 100).footage(), 100);
    for (const double time : {3.0, 4.0, 5.0})
        material.add(kill(time, 0, 1));
    const auto decide = [&](Cutter& cutter, Beat now, std::span<const std::size_t> choice) {
        return cutter.decide(material, material.moments(rules, test::unit, now), rules, test::unit, now,
                             choice);
    };
    Cutter free;
    EXPECT_NE(decide(free, 20, {})->rush, 2U);
    const std::vector<std::size_t> only{2};
    Cutter bound;
    EXPECT_EQ(decide(bound, 20, only)->rush, 2U);
    for (Beat now = 22; now < 100; now += cut_every)
        EXPECT_FALSE(decide(bound, now, only));
    const std::vector<std::size_t> another{1};
    EXPECT_EQ(decide(bound, 60, another)->rush, 1U) << "what may not be on the air ends at once";
}

TEST(Cutter, GoesOnWithWhatSomebodyElseHasDecided) {
    Material material(2, test::following(2));
    const Rules rules = default_rules();
    append(material, Script(2, 60).footage(), 60);
    Cutter cutter;
    cutter.cut_to({1, 30, 30, {}});
    EXPECT_FALSE(cutter.decide(material, {}, rules, test::unit, 30));
    ASSERT_TRUE(cutter.on_air());
    EXPECT_EQ(cutter.on_air()->rush, 1U);
}

}  // namespace
}  // namespace camdir::direction
