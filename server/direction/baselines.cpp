#include "direction/baselines.hpp"

#include <algorithm>
#include <cmath>
#include <random>

namespace camdir::direction {
namespace {

constexpr Beat half_second = 5;

// Appends the beats from `begin` to `end` behind a player to the programme.
void show(const Footage& footage, std::vector<Shot>& shots, Index player, Beat begin, Beat end) {
    const std::size_t rush = footage.rush_following(player);
    if (!shots.empty() && shots.back().rush == rush)
        shots.back().end = end;
    else
        shots.push_back({rush, begin, end, {}});
}

// Whom the programme shows last.
Index followed(const Footage& footage, const std::vector<Shot>& shots) {
    return shots.empty() ? Index{0} : footage.followed()[shots.back().rush];
}

bool lives(const Footage& footage, Beat beat, Index player) {
    const PlayerState& state = footage.player(beat, player);
    return state.present && state.alive;
}

double rank(const Footage& footage, Beat beat, Index player, double range) {
    const PlayerState& self = footage.player(beat, player);
    double sum = 0.0;
    for (Index other = 0; other < footage.players(); ++other) {
        if (other == player || !self.sees[other] || !footage.player(beat, other).alive) continue;
        const Vec3f way = footage.player(beat, other).eye - self.eye;
        const auto distance = static_cast<double>(way.norm());
        if (distance > range || distance <= 0.0) continue;
        const double facing = std::max(0.0, static_cast<double>(self.facing.dot(way)) / distance);
        sum += facing * facing / std::sqrt(distance);
    }
    return sum;
}

Index best_rank(const Footage& footage, Beat beat, double range) {
    Index best = 0;
    double most = -1.0;
    for (Index player = 0; player < footage.players(); ++player) {
        const double value = lives(footage, beat, player) ? rank(footage, beat, player, range) : -0.5;
        if (value > most) {
            most = value;
            best = player;
        }
    }
    return best;
}

const Event* kill_in(std::span<const Event> events, double from, double to) {
    for (const Event& event : events)
        if (event.kind == EventKind::kill && event.actor != nobody && event.actor != event.subject &&
            event.time >= from && event.time < to)
            return &event;
    return nullptr;
}

// Kills and belongings of each player up to a beat that ascends from call to call.
class Standing {
  public:
    Standing(const Footage& footage, std::span<const Event> events)
        : footage_(footage), events_(events), kills_(footage.players()), carried_(footage.players()) {}

    void advance(Beat beat) {
        for (; next_ < events_.size() && events_[next_].time < static_cast<double>(beat) * beat_s; ++next_)
            count(events_[next_]);
    }

    [[nodiscard]] Index leader(Beat beat) const {
        Index best = 0;
        double most = -1.0;
        for (Index player = 0; player < footage_.players(); ++player) {
            const double value = lives(footage_, beat, player) ? score(player) : -0.5;
            if (value > most) {
                most = value;
                best = player;
            }
        }
        return best;
    }
    [[nodiscard]] double score(Index player) const { return kills_[player] + carried_[player]; }

  private:
    void count(const Event& event) {
        if (event.kind == EventKind::item && event.actor != nobody) carried_[event.actor] += event.value;
        if (event.kind != EventKind::kill) return;
        if (event.actor != nobody && event.actor != event.subject) kills_[event.actor] += 1.0;
        if (event.subject != nobody) carried_[event.subject] = 0.0;
    }

    const Footage& footage_;
    std::span<const Event> events_;
    std::vector<double> kills_;
    std::vector<double> carried_;
    std::size_t next_ = 0;
};

}  // namespace

std::vector<Shot> random_switch(const Footage& footage, std::uint64_t seed) {
    constexpr Beat length = 60;
    std::vector<Shot> shots;
    std::mt19937_64 random(seed);
    for (Beat beat = 0; beat < footage.beats(); beat += length) {
        std::vector<Index> choices;
        const Index stay = followed(footage, shots);
        for (Index player = 0; player < footage.players(); ++player)
            if (lives(footage, beat, player) && (shots.empty() || player != stay)) choices.push_back(player);
        show(footage, shots, choices.empty() ? stay : choices[random() % choices.size()], beat,
             std::min(beat + length, footage.beats()));
    }
    return shots;
}

std::vector<Shot> hltv(const Footage& footage, std::span<const Event> events, double unit, double delay_s) {
    constexpr double buckets[] = {2.0, 0.0, 4.0, 6.0};  // in order of preference, 2 s each
    constexpr double least_delay = 10.0;
    constexpr double range = 1024.0;
    constexpr Beat shortest = 40;
    constexpr Beat usual = 60;
    constexpr Beat longest = 80;
    std::vector<Shot> shots;
    for (Beat beat = 0; beat < footage.beats();) {
        const double now = static_cast<double>(beat) * beat_s;
        const Event* kill = nullptr;
        for (const double bucket : buckets)
            if (kill == nullptr && delay_s >= least_delay)
                kill = kill_in(events, now + bucket, now + bucket + 2.0);
        Index player = kill == nullptr ? nobody : kill->actor;
        Beat length = usual;
        if (player != nobody)
            length = std::clamp(beat_of(kill->time + 2.0) - beat, shortest, longest);
        else
            player = best_rank(footage, beat, range * unit);
        show(footage, shots, player, beat, std::min(beat + length, footage.beats()));
        beat += length;
    }
    return shots;
}

std::vector<Shot> quakeworld(const Footage& footage, std::span<const Event> events) {
    constexpr Beat wait_on_the_dead = 20;
    std::vector<Shot> shots;
    Standing standing(footage, events);
    Beat died = -1;
    for (Beat beat = 0; beat < footage.beats(); beat += half_second) {
        standing.advance(beat);
        const Index leader = standing.leader(beat);
        Index player = shots.empty() ? leader : followed(footage, shots);
        if (lives(footage, beat, player)) {
            died = -1;
            if (standing.score(leader) > standing.score(player)) player = leader;
        } else {
            if (died < 0) died = beat;
            if (beat - died >= wait_on_the_dead) player = leader;
        }
        show(footage, shots, player, beat, std::min(beat + half_second, footage.beats()));
    }
    return shots;
}

}  // namespace camdir::direction
