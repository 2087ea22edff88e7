#include "direction/editor.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "direction/grammar.hpp"
#include "small_match.hpp"

namespace camdir::direction {
namespace {

using test::kill;
using test::random_kills;
using test::random_script;
using test::Script;

// Shots of 4 to 7 beats, 5 preferred, no plan beyond what is known. Kills span four beats: a cut may divide
// one, two cuts may not.
Rules small_rules() {
    Rules rules;
    rules.grammar.minimum_shot_s = 0.4;
    rules.grammar.preferred_shot_s = 0.5;
    rules.grammar.maximum_shot_s = 0.7;
    rules.grammar.length = 0.4;
    rules.grammar.cut = 0.1;
    rules.grammar.fresh = 0.0;
    rules.grammar.foresight_s = 0.0;
    rules.moments = {
        {.name = "sight", .trigger = Trigger::sight, .worth = 2.0, .worth_both = 0.7},
        {.name = "kill",
         .trigger = Trigger::kill,
         .before_s = 0.2,
         .after_s = 0.1,
         .worth = 3.0,
         .whole = true},
    };
    return rules;
}

OnAir nothing_yet(const Footage& footage) {
    return {{}, std::vector<Beat>(footage.rushes(), 0)};
}

// What a programme is worth, from the definitions.
class Worth {
  public:
    Worth(const Footage& footage, std::span<const Moment> moments, const Rules& rules)
        : footage_(footage), moments_(moments), rules_(rules) {}

    [[nodiscard]] double of(const std::vector<Shot>& shots) const {
        double worth = 0.0;
        for (std::size_t i = 0; i < shots.size(); ++i) {
            for (Beat beat = shots[i].begin; beat < shots[i].end; ++beat)
                worth += of_beat(beat, shots[i].rush);
            const bool last = i + 1 == shots.size();
            worth -= of_pieces(shots[i], last);
            if (!last) worth -= of_cut(shots[i], shots[i + 1]);
        }
        for (const Moment& moment : moments_)
            if (rules_.moments[moment.rule].whole && counts(moment, shots))
                worth += rules_.moments[moment.rule].worth;
        return worth;
    }

    [[nodiscard]] bool counts(const Moment& moment, const std::vector<Shot>& shots) const {
        return seen(moment, shots) && may_count(moment, shots);
    }

  private:
    [[nodiscard]] bool shown(const Moment& moment, Beat beat, std::size_t rush) const {
        const PlayerSet& shown = footage_.take(beat, rush).shown;
        return shown[moment.actor] || shown[moment.subject];
    }

    // The last piece of all is not over.
    [[nodiscard]] double of_pieces(const Shot& shot, bool last) const {
        double cost = 0.0;
        Beat begin = shot.begin;
        for (Beat beat = begin + 1; beat < shot.end; ++beat) {
            if (!footage_.take(beat, shot.rush).cut) continue;
            const bool second_in_short = begin != shot.begin && beat - begin < 15;
            cost += second_in_short ? never : rules_.grammar.inner_cut;
            cost += length_cost(rules_.grammar, beat - std::exchange(begin, beat));
        }
        const Beat preferred = beat_of(rules_.grammar.preferred_shot_s);
        return cost +
               length_cost(rules_.grammar, last ? std::max(preferred, shot.end - begin) : shot.end - begin);
    }

    [[nodiscard]] double of_beat(Beat beat, std::size_t rush) const {
        const Grammar& grammar = rules_.grammar;
        const Take& take = footage_.take(beat, rush);
        double worth = 0.0;
        worth -= (take.subject == nobody || !take.shown[take.subject] ? grammar.hidden : 0.0) * beat_s;
        worth -= (is_of_the_dead(take, beat) ? grammar.dead : 0.0) * beat_s;
        for (const Moment& moment : moments_) {
            const Rule& rule = rules_.moments[moment.rule];
            if (rule.whole || beat < moment.begin || beat >= moment.end) continue;
            const bool actor = take.shown[moment.actor];
            const bool other = take.shown[moment.subject];
            worth += (actor || other ? rule.worth : 0.0) * beat_s +
                     (actor && other ? rule.worth_both : 0.0) * beat_s;
        }
        return worth;
    }

    [[nodiscard]] bool is_of_the_dead(const Take& take, Beat beat) const {
        const Index subject = take.subject;
        if (subject == nobody) return true;
        const Beat earlier = beat - beat_of(rules_.grammar.beat_after_death_s);
        return !footage_.player(beat, subject).alive &&
               (earlier < 0 || !footage_.player(earlier, subject).alive);
    }

    [[nodiscard]] double of_cut(const Shot& before, const Shot& after) const {
        double cost = rules_.grammar.cut;
        const Beat cut = before.end;
        if (may_be_jump_cut(footage_, rules_.grammar, cut, before.rush, after.rush) ||
            may_cross_line(footage_, cut, before.rush, after.rush))
            cost += never;
        if (jumped_just_before(footage_, cut, before.rush) || jumps_soon_after(footage_, cut, after.rush))
            cost += never;
        for (const Moment& moment : moments_) {
            const bool is_kill = rules_.moments[moment.rule].trigger == Trigger::kill;
            if (!is_kill || cut <= moment.begin || cut > moment.peak) continue;
            if (!seen(moment, {before, after})) cost += never;
        }
        return cost;
    }

    [[nodiscard]] bool seen(const Moment& moment, const std::vector<Shot>& shots) const {
        for (Beat beat = moment.begin; beat < moment.end; ++beat) {
            const auto shot = std::ranges::find_if(shots, [&](const Shot& candidate) {
                return beat >= candidate.begin && beat < candidate.end;
            });
            if (shot == shots.end() || !shown(moment, beat, shot->rush)) return false;
        }
        return true;
    }

    // Of the moments that a cut divides only those that no other could divide too.
    [[nodiscard]] bool may_count(const Moment& moment, const std::vector<Shot>& shots) const {
        const Beat end = std::min(moment.end, footage_.beats());
        const Beat shortest = beat_of(rules_.grammar.minimum_shot_s);
        return std::ranges::all_of(shots, [&](const Shot& shot) {
            return shot.begin <= moment.begin || shot.begin >= end ||
                   (shot.begin - moment.begin <= shortest && end - shot.begin <= shortest);
        });
    }

    const Footage& footage_;
    std::span<const Moment> moments_;
    const Rules& rules_;
};

// The greatest worth of all programmes from `shots` on, which end at `begin`.
double best_of_all(const Footage& footage, const Grammar& grammar, const Worth& worth,
                   std::vector<Shot>& shots, Beat begin) {
    const Beat shortest = beat_of(grammar.minimum_shot_s);
    const Beat longest = beat_of(grammar.maximum_shot_s);
    if (begin == footage.beats()) return worth.of(shots);
    double best = -std::numeric_limits<double>::infinity();
    for (std::size_t rush = 0; rush < footage.rushes(); ++rush) {
        if (!shots.empty() && shots.back().rush == rush) continue;
        if (footage.take(begin, rush).subject == nobody) continue;
        for (Beat end = begin + 1; end <= std::min(begin + longest, footage.beats()); ++end) {
            if ((end - begin < shortest || end % cut_every != 0) && end < footage.beats()) continue;
            shots.push_back({rush, begin, end, {}});
            best = std::max(best, best_of_all(footage, grammar, worth, shots, end));
            shots.pop_back();
        }
    }
    return best;
}

double best_of_all(const Footage& footage, const Grammar& grammar, const Worth& worth) {
    std::vector<Shot> shots;
    return best_of_all(footage, grammar, worth, shots, 0);
}

TEST(Editor, NoProgrammeIsWorthMore) {
    std::mt19937 random(5);
    int within_grammar = 0;
    for (int round = 0; round < 60; ++round) {
        const Footage footage = random_script(3, 14, random, round % 2 == 0 ? 2 : 0).footage();
        const auto events = random_kills(3, 1.4, 4, random);
        const Rules rules = small_rules();
        const auto moments = find_moments(footage, events, rules, test::unit, 0);
        const Worth worth(footage, moments, rules);
        const auto plan = plan_shots(footage, moments, rules, test::unit, nothing_yet(footage), 0);
        const double best = best_of_all(footage, rules.grammar, worth);
        if (best < -never / 2.0) continue;  // all break it, and the plan may by a shot that is too long
        ++within_grammar;
        EXPECT_NEAR(worth.of(plan), best, 1e-6) << round;
    }
    EXPECT_GT(within_grammar, 50);
}

// Longer than two of the shortest shots: of all the cuts that divide one none counts, or that in its middle.
TEST(Editor, NoProgrammeIsWorthMoreOfLongMoments) {
    std::mt19937 random(11);
    int within_grammar = 0;
    int divided = 0;
    for (int round = 0; round < 120; ++round) {
        const Footage footage = random_script(3, 16, random).footage();
        const auto events = random_kills(3, 1.6, 4, random);
        Rules rules = small_rules();
        rules.moments.push_back({.name = "several",
                                 .trigger = Trigger::multi_kill,
                                 .before_s = round % 2 == 0 ? 0.4 : 0.6,
                                 .after_s = 0.3,
                                 .worth = 5.0,
                                 .whole = true});
        const auto moments = find_moments(footage, events, rules, test::unit, 0);
        const Worth worth(footage, moments, rules);
        const auto plan = plan_shots(footage, moments, rules, test::unit, nothing_yet(footage), 0);
        const double best = best_of_all(footage, rules.grammar, worth);
        if (best < -never / 2.0) continue;
        ++within_grammar;
        EXPECT_NEAR(worth.of(plan), best, 1e-6) << round;
        for (const Moment& moment : moments)
            divided += moment.rule == 2 && worth.counts(moment, plan) &&
                       std::ranges::any_of(plan, [&](const Shot& shot) {
                           return shot.begin > moment.begin && shot.begin < moment.end;
                       });
    }
    EXPECT_GT(within_grammar, 50);
    EXPECT_GT(divided, 5);
}

// Two players for 8 s, whose cameras jump at times.
Footage jumping_match(std::mt19937& random) {
    constexpr Beat beats = 80;
    Script script(2, beats);
    for (std::size_t rush = 0; rush < 2; ++rush) {
        for (std::size_t beat = random() % 20; beat < beats; beat += 15 + random() % 30)
            script.take(beat, rush).jump(random() % 2 == 0);
        for (std::size_t beat = 0; beat < beats; ++beat)
            script.take(beat, rush).shown.set(rush, random() % 4 != 0);
    }
    return script.footage();
}

// Shots of 1.6 s and more, which a jump may divide into pieces of 1.5 s and more.
Rules rules_of_long_shots() {
    Rules rules = small_rules();
    rules.grammar.minimum_shot_s = 1.6;
    rules.grammar.preferred_shot_s = 3.0;
    rules.grammar.maximum_shot_s = 6.0;
    rules.grammar.inner_cut = 0.2;
    return rules;
}

int jumps_in(const std::vector<Shot>& shots, const Footage& footage) {
    int jumps = 0;
    for (const Shot& shot : shots)
        for (Beat beat = shot.begin + 1; beat < shot.end; ++beat)
            jumps += footage.take(beat, shot.rush).cut ? 1 : 0;
    return jumps;
}

TEST(Editor, NoProgrammeIsWorthMoreWhereCamerasJump) {
    std::mt19937 random(8);
    int within_grammar = 0;
    int jumps = 0;
    const Rules rules = rules_of_long_shots();
    for (int round = 0; round < 60; ++round) {
        const Footage footage = jumping_match(random);
        const auto events = random_kills(2, 8.0, 8, random);
        const auto moments = find_moments(footage, events, rules, test::unit, 0);
        const Worth worth(footage, moments, rules);
        const auto plan = plan_shots(footage, moments, rules, test::unit, nothing_yet(footage), 0);
        const double best = best_of_all(footage, rules.grammar, worth);
        if (best < -never / 2.0) continue;
        ++within_grammar;
        EXPECT_NEAR(worth.of(plan), best, 1e-6) << round;
        jumps += jumps_in(plan, footage);
    }
    EXPECT_GT(within_grammar, 15);
    EXPECT_GT(jumps, 10);
}

// Of which a jump, before now or later, has divided some.
TEST(Editor, NoProgrammeIsWorthMoreThatGoesOnWithTheShotOnTheAir) {
    std::mt19937 random(9);
    int within_grammar = 0;
    int divided_before = 0;
    const Rules rules = rules_of_long_shots();
    for (int round = 0; round < 100; ++round) {
        const Beat begin = round % 2 == 0 ? 4 : 5;
        const Beat now = round % 4 < 2 ? 30 : 10;
        const Footage footage = jumping_match(random);
        const auto events = random_kills(2, 8.0, 8, random);
        const auto moments = find_moments(footage, events, rules, test::unit, 0);
        const Worth worth(footage, moments, rules);
        OnAir on_air = nothing_yet(footage);
        on_air.shot = Shot{0, begin, 0, {}};
        const auto plan = plan_shots(footage, moments, rules, test::unit, on_air, now);
        double best = -std::numeric_limits<double>::infinity();
        const Beat first = std::max(now, (begin + 17) / cut_every * cut_every);
        for (Beat end = first; end <= begin + 60; end += cut_every) {
            std::vector<Shot> shots = {{0, begin, end, {}}};
            best = std::max(best, best_of_all(footage, rules.grammar, worth, shots, end));
        }
        if (best < -never / 2.0) continue;
        ++within_grammar;
        std::vector<Shot> shown = plan;
        if (shown.front().rush != 0) shown.insert(shown.begin(), {0, begin, now, {}});
        EXPECT_NEAR(worth.of(shown), best, 1e-6) << round;
        divided_before += jumps_in({{0, begin, now, {}}}, footage);
    }
    EXPECT_GT(within_grammar, 15);
    EXPECT_GT(divided_before, 5);
}

TEST(Editor, APlanIsOneSequenceOfShotsWithinTheGrammar) {
    std::mt19937 random(6);
    for (int round = 0; round < 200; ++round) {
        const Footage footage = random_script(5, 60, random).footage();
        const Rules rules = small_rules();
        const auto moments = find_moments(footage, random_kills(5, 6.0, 8, random), rules, test::unit, 0);
        const auto plan = plan_shots(footage, moments, rules, test::unit, nothing_yet(footage), 0);
        ASSERT_FALSE(plan.empty());
        EXPECT_EQ(plan.front().begin, 0);
        EXPECT_EQ(plan.back().end, 60);
        for (std::size_t i = 0; i + 1 < plan.size(); ++i) {
            EXPECT_EQ(plan[i].end, plan[i + 1].begin);
            EXPECT_NE(plan[i].rush, plan[i + 1].rush);
            EXPECT_GE(plan[i].end - plan[i].begin, 4);
            EXPECT_LE(plan[i].end - plan[i].begin, 7);
        }
    }
}

TEST(Editor, AMaximumBelowTheMinimumCountsAsTheMinimum) {
    std::mt19937 random(7);
    const Footage footage = random_script(5, 60, random).footage();
    const auto lengths = [&](double maximum_shot_s) {
        Rules rules = small_rules();
        rules.grammar.minimum_shot_s = 0.6;
        rules.grammar.maximum_shot_s = maximum_shot_s;
        std::vector<Beat> beats;
        for (const Shot& shot : plan_shots(footage, {}, rules, test::unit, nothing_yet(footage), 0))
            beats.push_back(shot.end - shot.begin);
        return beats;
    };
    EXPECT_THAT(lengths(0.4), testing::Each(6));
    EXPECT_EQ(lengths(0.4), lengths(0.6));
}

TEST(Editor, CutsToAFightBeforeItBeginsWhenItIsKnown) {
    Script script(3, 100);
    for (std::size_t beat = 60; beat < 80; ++beat)
        script.meet(beat, 1, 2);
    const std::vector<Event> events = {kill(8.0, 2, 1)};
    const Footage footage = script.footage();
    const Rules rules = default_rules();
    OnAir on_air = nothing_yet(footage);
    on_air.shot = Shot{0, 0, 0, {}};
    const auto plan = plan_shots(footage, find_moments(footage, events, rules, test::unit, 0), rules,
                                 test::unit, on_air, 0);
    const auto shot =
        std::ranges::find_if(plan, [](const Shot& one) { return one.begin <= 80 && one.end > 80; });
    ASSERT_NE(shot, plan.end());
    EXPECT_NE(shot->rush, 0U);
    EXPECT_LE(shot->begin, 70);
    EXPECT_GE(shot->end, 86);
    EXPECT_EQ(shot->reason.why, Reason::Why::moment);
}

TEST(Editor, ARuleThatIsSwitchedOffIsNoReason) {
    Script script(2, 100);
    for (std::size_t beat = 0; beat < 100; ++beat)
        script.meet(beat, 0, 1);
    const std::vector<Event> events = {kill(5.0, 0, 1)};
    Rules rules;
    rules.moments = {
        {.name = "sight", .trigger = Trigger::sight, .worth = 1.0},
        {.name = "kill", .trigger = Trigger::kill, .before_s = 1.0, .after_s = 0.5, .whole = true}};
    const Footage footage = script.footage();
    const auto plan = plan_shots(footage, find_moments(footage, events, rules, test::unit, 0), rules,
                                 test::unit, nothing_yet(footage), 0);
    EXPECT_EQ(plan[0].reason.why, Reason::Why::moment);
    EXPECT_EQ(plan[0].reason.rule, 0);
}

TEST(Editor, AShotOnTheAirIsNotCutBeforeItsTime) {
    Script script(2, 30);
    for (std::size_t beat = 0; beat < 30; ++beat)
        script.take(beat, 0).shown.reset();
    const Footage footage = script.footage();
    OnAir on_air = nothing_yet(footage);
    on_air.shot = Shot{0, 5, 0, {}};
    const Rules rules = default_rules();
    const auto plan = plan_shots(footage, {}, rules, test::unit, on_air, 10);
    ASSERT_GE(plan.size(), 2U);
    EXPECT_EQ(plan[0].rush, 0U);
    EXPECT_EQ(plan[0].begin, 5);
    EXPECT_GE(plan[0].end, 5 + beat_of(rules.grammar.minimum_shot_s));
    EXPECT_EQ(plan[1].reason.why, Reason::Why::hidden);
}

TEST(Editor, AFixedRushIsLeftAloneWhereItHasNobodyToShow) {
    Script script(1, 100, 1);
    for (std::size_t beat = 0; beat < 100; ++beat) {
        script.take(beat, 0).shown.reset();
        if (beat < 60) continue;
        script.take(beat, 1).subject = 0;
        script.take(beat, 1).position = {0.0F, 300.0F, 0.0F};
        script.take(beat, 1).shown.set(0);
    }
    const Footage footage = script.footage();
    const auto plan = plan_shots(footage, {}, default_rules(), test::unit, nothing_yet(footage), 0);
    ASSERT_EQ(plan.size(), 2U);
    EXPECT_EQ(plan[1].rush, 1U);
    EXPECT_EQ(plan[1].begin, 60);
    EXPECT_EQ(plan[1].reason.why, Reason::Why::hidden);
}

TEST(Editor, WhoIsInAFixedPictureIsNotTakenToStayThere) {
    Script script(2, 20, 1);
    for (std::size_t beat = 0; beat < 20; ++beat) {
        script.meet(beat, 0, 1);
        script.take(beat, 2).subject = 0;
        script.take(beat, 2).position = {50.0F, 900.0F, 0.0F};
        script.take(beat, 2).shown.set(0).set(1);
        script.take(beat, 0).shown.set(1);
    }
    Rules rules = default_rules();
    rules.moments = {{.name = "sight", .trigger = Trigger::sight, .worth = 1.0}};
    const Footage footage = script.footage();
    const auto plan = plan_shots(footage, find_moments(footage, {}, rules, test::unit, 0), rules, test::unit,
                                 nothing_yet(footage), 20);
    EXPECT_NE(plan.front().rush, 2U);
}

TEST(Editor, OneRushIsAProgrammeToo) {
    const Footage footage = Script(1, 30).footage();
    const auto plan = plan_shots(footage, {}, default_rules(), test::unit, nothing_yet(footage), 0);
    ASSERT_EQ(plan.size(), 1U);
    EXPECT_EQ(plan[0].reason.why, Reason::Why::opening);
}

TEST(Editor, NothingKnownIsNoError) {
    const Footage footage(3, test::following(3));
    EXPECT_EQ(plan_shots(footage, {}, default_rules(), test::unit, nothing_yet(footage), 0).front().begin, 0);
}

}  // namespace
}  // namespace camdir::direction
