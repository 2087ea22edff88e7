// Matches of a few players and beats, written by hand or at random.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <random>
#include <span>
#include <vector>

#include "direction/footage.hpp"
#include "direction/rules.hpp"

namespace camdir::direction::test {

inline constexpr double unit = 1.0;

inline std::vector<Index> following(std::size_t players) {
    std::vector<Index> followed;
    for (std::size_t i = 0; i < players; ++i)
        followed.push_back(static_cast<Index>(i));
    return followed;
}

// Beats that are written before they are appended. Everybody lives, is everybody's enemy and runs; the first
// rushes follow the player of their number and show them. Fixed ones come last and show nobody.
class Script {
  public:
    Script(std::size_t players, std::size_t beats, std::size_t fixed = 0)
        : followed_(following(players)), players_(beats, std::vector<PlayerState>(players)) {
        followed_.resize(players + fixed, nobody);
        takes_.assign(beats, std::vector<Take>(followed_.size()));
        for (std::size_t beat = 0; beat < beats; ++beat)
            for (std::size_t i = 0; i < players; ++i) {
                PlayerState& state = players_[beat][i];
                state.eye = {100.0F * static_cast<float>(i), 0.0F, 0.0F};
                state.speed = 320.0F;
                state.present = state.alive = true;
                // Each looks at its player from another side, so that no cut is a jump cut.
                const float angle = 1.3F * static_cast<float>(i);
                takes_[beat][i].position = state.eye + 100.0F * Vec3f(std::cos(angle), std::sin(angle), 0.2F);
                takes_[beat][i].shown.set(i);
                takes_[beat][i].subject = static_cast<Index>(i);
            }
    }

    PlayerState& player(std::size_t beat, std::size_t player) { return players_[beat][player]; }
    Take& take(std::size_t beat, std::size_t rush) { return takes_[beat][rush]; }
    void meet(std::size_t beat, std::size_t a, std::size_t b) {
        players_[beat][a].sees.set(b);
        players_[beat][b].sees.set(a);
    }

    [[nodiscard]] Footage footage() const {
        Footage made(players_.front().size(), followed_);
        for (std::size_t beat = 0; beat < players_.size(); ++beat)
            made.append(players_[beat], takes_[beat]);
        return made;
    }

  private:
    std::vector<Index> followed_;
    std::vector<std::vector<PlayerState>> players_;
    std::vector<std::vector<Take>> takes_;
};

inline Event kill(double time, Index killer, Index victim) {
    return {time, EventKind::kill, killer, victim, 0.0};
}

// Players who meet, are lost from sight, die and respawn. A fixed rush has a player to show for
// a few beats at a time.
inline Script random_script(std::size_t players, std::size_t beats, std::mt19937& random,
                            std::size_t fixed = 0) {
    Script script(players, beats, fixed);
    const auto chance = [&](double share) { return std::bernoulli_distribution(share)(random); };
    for (std::size_t i = 0; i < players; ++i) {
        bool alive = true;
        for (std::size_t beat = 0; beat < beats; ++beat) {
            if (chance(0.1)) alive = !alive;
            script.player(beat, i).alive = alive;
            script.take(beat, i).shown.set(i, chance(0.85));
            script.take(beat, i).cut = chance(0.02);
            for (std::size_t other = 0; other < players; ++other) {
                if (other != i && chance(0.3)) script.take(beat, i).shown.set(other);
                if (other < i && chance(0.4)) script.meet(beat, i, other);
            }
        }
    }
    const auto any = [&] { return static_cast<Index>(random() % players); };
    for (std::size_t rush = players; rush < players + fixed; ++rush) {
        Index subject = nobody;
        for (std::size_t beat = 0; beat < beats; ++beat) {
            if (chance(0.15)) subject = chance(0.6) ? any() : nobody;
            Take& take = script.take(beat, rush);
            take.subject = subject;
            take.position = {static_cast<float>(rush) * 70.0F, chance(0.5) ? 200.0F : -200.0F, 50.0F};
            if (subject != nobody) take.shown.set(subject, chance(0.9));
        }
    }
    // Who is shown soon is in the picture already.
    for (std::size_t rush = 0; rush < players + fixed; ++rush)
        for (std::size_t beat = 0; beat < beats; ++beat)
            script.take(beat, rush).framed =
                script.take(beat, rush).shown | script.take(std::min(beat + 1, beats - 1), rush).shown;
    return script;
}

inline std::vector<Event> random_kills(std::size_t players, double seconds, std::size_t count,
                                       std::mt19937& random) {
    std::uniform_real_distribution<double> time(0.0, seconds);
    std::uniform_int_distribution<int> player(0, static_cast<int>(players) - 1);
    std::vector<Event> events;
    for (std::size_t i = 0; i < count; ++i)
        events.push_back(
            kill(time(random), static_cast<Index>(player(random)), static_cast<Index>(player(random))));
    std::ranges::sort(events, {}, &Event::time);
    return events;
}

}  // namespace camdir::direction::test
