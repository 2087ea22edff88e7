// bench-direction: what a decision of the editor costs, of players who run about in one arena.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "direction/cutter.hpp"
#include "direction/material.hpp"

namespace camdir::bench {
namespace {

using namespace direction;
using Clock = std::chrono::steady_clock;

constexpr float arena = 3000.0F;  // edge, units of 0.0254 m
constexpr float pillar = 150.0F;  // radius
constexpr int pillars_a_row = 4;
constexpr std::size_t fixed_shots = 16;
constexpr Beat beats = 1200;
constexpr double kill_every_s = 1.0;
constexpr Beat dead_for = 20;
constexpr float behind = 100.0F;
constexpr float range = 1500.0F;

// Pillars hide; nothing else does.
bool sees(const Vec3f& from, const Vec3f& to) {
    const float spacing = arena / pillars_a_row;
    const Vec3f way = to - from;
    if (way.norm() > range) return false;
    for (int row = 0; row < pillars_a_row; ++row)
        for (int column = 0; column < pillars_a_row; ++column) {
            const Vec3f middle((static_cast<float>(row) + 0.5F) * spacing,
                               (static_cast<float>(column) + 0.5F) * spacing, from.z());
            const float along = std::clamp((middle - from).dot(way) / way.squaredNorm(), 0.0F, 1.0F);
            if ((from + along * way - middle).head<2>().norm() < pillar) return false;
        }
    return true;
}

// Runs to one place after another, looks where they run, is dead for two seconds after a kill.
class Crowd {
  public:
    explicit Crowd(std::size_t players)
        : places_(players), targets_(players), dead_until_(players, 0), respawns_(players) {
        for (std::size_t i = 0; i < players; ++i) {
            places_[i] = anywhere();
            targets_[i] = anywhere();
        }
    }

    std::vector<PlayerState> step(Beat beat, std::vector<Event>& events) {
        std::vector<PlayerState> states(places_.size());
        for (std::size_t i = 0; i < places_.size(); ++i) {
            if ((targets_[i] - places_[i]).norm() < 32.0F) targets_[i] = anywhere();
            const Vec3f ahead = (targets_[i] - places_[i]).normalized();
            places_[i] += 32.0F * ahead;
            states[i].eye = places_[i];
            states[i].facing = ahead;
            states[i].speed = 320.0F;
            states[i].present = true;
            states[i].alive = beat >= dead_until_[i];
            respawns_[i] = beat > 0 && beat == dead_until_[i];
        }
        for (std::size_t i = 0; i < states.size(); ++i)
            for (std::size_t other = 0; other < i; ++other)
                if (sees(states[i].eye, states[other].eye)) {
                    states[i].sees.set(other);
                    states[other].sees.set(i);
                }
        if (std::bernoulli_distribution(beat_s / kill_every_s)(random_)) kill(beat, states, events);
        return states;
    }

    // In the last step.
    [[nodiscard]] bool respawns(std::size_t player) const { return respawns_[player]; }

  private:
    Vec3f anywhere() {
        std::uniform_real_distribution<float> place(0.0F, arena);
        return {place(random_), place(random_), 50.0F};
    }

    void kill(Beat beat, const std::vector<PlayerState>& states, std::vector<Event>& events) {
        const std::size_t killer = random_() % states.size();
        for (std::size_t victim = 0; victim < states.size(); ++victim) {
            if (!states[killer].alive || !states[victim].alive || !states[killer].sees[victim]) continue;
            const double time = (static_cast<double>(beat) + 0.5) * beat_s;
            for (const EventKind kind : {EventKind::damage, EventKind::kill})
                events.push_back({time, kind, static_cast<Index>(killer), static_cast<Index>(victim), 0.0});
            dead_until_[victim] = beat + dead_for;
            return;
        }
    }

    std::mt19937 random_{7};
    std::vector<Vec3f> places_, targets_;
    std::vector<Beat> dead_until_;
    std::vector<bool> respawns_;
};

Take take_from(const Vec3f& position, const Vec3f& ahead, const std::vector<PlayerState>& players) {
    Take take;
    take.position = position;
    for (std::size_t i = 0; i < players.size(); ++i) {
        const Vec3f way = players[i].eye - position;
        if (way.dot(ahead) < 0.7F * way.norm()) continue;
        take.framed.set(i);
        if (sees(position, players[i].eye)) take.shown.set(i);
    }
    return take;
}

std::vector<Take> takes_of(const std::vector<PlayerState>& players) {
    std::vector<Take> takes;
    for (std::size_t i = 0; i < players.size(); ++i) {
        takes.push_back(take_from(players[i].eye - behind * players[i].facing, players[i].facing, players));
        takes.back().subject = static_cast<Index>(i);
    }
    for (std::size_t i = 0; i < fixed_shots; ++i) {
        const float angle = 6.2832F * static_cast<float>(i) / fixed_shots;
        const Vec3f out(std::cos(angle), std::sin(angle), 0.0F);
        const Vec3f middle(0.5F * arena, 0.5F * arena, 50.0F);
        takes.push_back(take_from(middle + 0.45F * arena * out, -out, players));
        takes.back().subject = subject_in(takes.back(), players);
    }
    return takes;
}

struct Match {
    Footage footage;
    std::vector<Event> events;
};

Match match_of(std::size_t players) {
    std::vector<Index> followed;
    for (std::size_t i = 0; i < players; ++i)
        followed.push_back(static_cast<Index>(i));
    followed.resize(players + fixed_shots, nobody);
    Match match{Footage(players, followed), {}};
    Crowd crowd(players);
    for (Beat beat = 0; beat < beats; ++beat) {
        const auto states = crowd.step(beat, match.events);
        auto takes = takes_of(states);
        for (std::size_t i = 0; i < players; ++i)
            takes[i].cut = crowd.respawns(i);
        match.footage.append(states, takes);
    }
    return match;
}

// Milliseconds.
struct Times {
    std::vector<double> moments, decisions;
};

Times direct_at(const Match& match, Beat delay) {
    const Rules rules = default_rules();
    Material known(match.footage.players(), match.footage.followed());
    Cutter cutter;
    Times times;
    std::size_t next_event = 0;
    const auto ms_since = [](Clock::time_point begin) {
        return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
    };
    for (Beat now = 0; now + delay < beats; now += cut_every) {
        for (Beat next = known.footage().beats(); next < now + std::max<Beat>(delay, 1); ++next)
            known.append(match.footage.players_at(next), match.footage.takes_at(next));
        for (; next_event < match.events.size() && beat_of(match.events[next_event].time) < now + delay;
             ++next_event)
            known.add(match.events[next_event]);
        known.forget_before(now);
        const auto begin = Clock::now();
        const auto moments = known.moments(rules, 1.0, now);
        times.moments.push_back(ms_since(begin));
        const auto found = Clock::now();
        cutter.decide(known, moments, rules, 1.0, now);
        times.decisions.push_back(ms_since(found));
    }
    return times;
}

double quantile(std::vector<double> values, double part) {
    std::ranges::sort(values);
    return values[static_cast<std::size_t>(part * static_cast<double>(values.size() - 1))];
}

void measure(std::size_t players, double delay_s) {
    const Match match = match_of(players);
    const Times times = direct_at(match, beat_of(delay_s));
    std::printf("| %zu | %.0f | %.3f | %.3f | %.3f | %.3f |\n", players, delay_s,
                quantile(times.moments, 0.5), quantile(times.moments, 0.99), quantile(times.decisions, 0.5),
                quantile(times.decisions, 0.99));
    std::fflush(stdout);
}

}  // namespace
}  // namespace camdir::bench

int main() {
    std::puts(
        "Milliseconds, one thread. Decisions are made five times a second; moments are found once for all "
        "shots of a "
        "match.\n");
    std::puts("| players | known, s | moments p50 | p99 | a decision p50 | p99 |");
    std::puts("|---|---|---|---|---|---|");
    for (const std::size_t players : {8U, 16U, 32U})
        for (const double delay_s : {0.0, 10.0})
            camdir::bench::measure(players, delay_s);
}
