#include "direction/moments.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "direction/grammar.hpp"

namespace camdir::direction {
namespace {

constexpr double chain_s = 3.0;  // between two kills of a multi-kill
constexpr std::size_t streak_kills = 3;
constexpr auto none = static_cast<std::size_t>(-1);

bool between_players(const Event& event) {
    return event.actor != nobody && event.subject != nobody && event.actor != event.subject;
}

std::optional<Trigger> trigger_of(EventKind kind) {
    switch (kind) {
        case EventKind::kill:
            return Trigger::kill;
        case EventKind::flag_taken:
            return Trigger::flag_taken;
        case EventKind::flag_captured:
            return Trigger::flag_captured;
        case EventKind::objective:
            return Trigger::objective;
        case EventKind::award:
            return Trigger::award;
        case EventKind::item:
            return Trigger::item;
        case EventKind::round_won:
            return Trigger::round_won;
        case EventKind::spawn:
            return Trigger::spawn;
        case EventKind::damage:
            break;
    }
    return {};
}

constexpr Beat out_after = 50;  // beats of death

// The only ones of their teams who live, where an enemy lives. Who died just now may come back at once.
PlayerSet last_of_teams(std::span<const PlayerState> players, std::span<const Beat> dead_since, Beat beat) {
    struct Team {
        std::size_t present = 0;
        std::size_t out = 0;
    };
    std::array<Team, 256> teams{};
    std::size_t alive = 0;
    for (std::size_t i = 0; i < players.size(); ++i) {
        if (!players[i].present) continue;
        Team& team = teams[players[i].team];
        ++team.present;
        team.out += !players[i].alive && beat - dead_since[i] >= out_after ? 1 : 0;
        alive += players[i].alive ? 1 : 0;
    }
    PlayerSet last;
    for (std::size_t i = 0; i < players.size(); ++i) {
        const Team& team = teams[players[i].team];
        last[i] = players[i].alive && players[i].team != 0 && team.present > 1 &&
                  team.out + 1 == team.present && alive > 1;
    }
    return last;
}

class Finder {
  public:
    Finder(const Footage& footage, std::span<const Event> events, const Rules& rules, double unit, Beat from,
           const Tally& tally)
        : footage_(footage), events_(events), rules_(rules), unit_(unit), from_(from), tally_(tally) {
        const double first = static_cast<double>(from) * beat_s - memory_s;
        recent_ = {std::ranges::lower_bound(events, first, {}, &Event::time), events.end()};
    }

    std::vector<Moment> find() {
        for (Index rule = 0; rule < rules_.moments.size(); ++rule)
            find(rule);
        std::ranges::stable_sort(moments_, {}, &Moment::begin);
        return std::move(moments_);
    }

  private:
    void find(Index rule) {
        switch (rules_.moments[rule].trigger) {
            case Trigger::sight:
                return find_sights(rule);
            case Trigger::last_alive:
                return find_last_alive(rule);
            case Trigger::exchange:
                return find_exchanges(rule);
            case Trigger::killer:
                return find_killers(rule);
            case Trigger::multi_kill:
                return find_multi_kills(rule);
            case Trigger::streak:
                return find_runs(rule, &Tally::Ended::streak, &Tally::streaks);
            case Trigger::flag_run:
                return find_runs(rule, &Tally::Ended::flag_run, &Tally::flag_runs);
            case Trigger::lead:
                return find_runs(rule, &Tally::Ended::lead, &Tally::leads);
            default:
                return find_events(rule);
        }
    }

    void add(Index rule, double first, double last, Index actor, Index subject) {
        const Rule& sentence = rules_.moments[rule];
        const Beat begin = std::max(footage_.first(), beat_of(first - sentence.before_s));
        const Beat end = std::min(footage_.beats(), beat_of(last + sentence.after_s) + 1);
        if (begin < end && end > from_) moments_.push_back({rule, begin, end, beat_of(last), actor, subject});
    }

    void find_events(Index rule) {
        for (const Event& event : recent_)
            if (trigger_of(event.kind) == rules_.moments[rule].trigger &&
                (event.kind != EventKind::kill || between_players(event)))
                add(rule, event.time, event.time, event.actor, event.subject);
    }

    void find_killers(Index rule) {
        for (const Event& event : recent_)
            if (event.kind == EventKind::kill && between_players(event))
                add(rule, event.time, event.time, event.actor, nobody);
    }

    void find_multi_kills(Index rule) {
        const auto kills = kills_of(recent_);
        std::vector<bool> is_one_of_several(kills.size());
        for (std::size_t i = 0; i < kills.size(); ++i)
            if (kills[i].first != i) is_one_of_several[i] = is_one_of_several[kills[i].first] = true;
        for (std::size_t i = 0; i < kills.size(); ++i)
            if (is_one_of_several[i])
                add(rule, kills[i].time, kills[i].time, kills[i].killer, kills[i].victim);
    }

    // Those that have ended, and those that go on.
    void find_runs(Index rule, std::optional<Tally::Run> Tally::Ended::*kind,
                   std::vector<Tally::Run> (Tally::*going_on)() const) {
        const auto add_run = [&](const Tally::Run& run, double end) {
            add(rule, run.since, end, run.player, nobody);
        };
        Tally tally = tally_;
        for (const Event& event : events_)
            if (const Tally::Ended ended = tally.count(event); ended.*kind)
                add_run(*(ended.*kind), event.time);
        const double end_s = static_cast<double>(footage_.beats()) * beat_s;
        for (const Tally::Run& run : (tally.*going_on)())
            add_run(run, end_s);
    }

    // Wounds of two players, each within the sentence's time of the one before.
    void find_exchanges(Index rule) {
        const double after = rules_.moments[rule].after_s;
        struct Exchange {
            double first;
            double last;
            Index a;
            Index b;
        };
        std::vector<Exchange> open;
        std::vector<std::size_t> places(footage_.players() * footage_.players(), none);  // in `open`
        const auto close = [&](const Exchange& exchange) {
            add(rule, exchange.first, exchange.last, exchange.a, exchange.b);
        };
        for (const Event& event : recent_) {
            if (event.kind != EventKind::damage || event.actor == nobody || event.subject == nobody) continue;
            const auto [a, b] = std::minmax(event.actor, event.subject);
            if (a == b) continue;
            std::size_t& place = places[a * footage_.players() + b];
            if (place == none) {
                place = open.size();
                open.push_back({event.time, event.time, a, b});
            } else if (event.time - open[place].last <= after) {
                open[place].last = event.time;
            } else {
                close(open[place]);
                open[place] = {event.time, event.time, a, b};
            }
        }
        std::ranges::for_each(open, close);
    }

    // Runs of beats of each pair.
    void find_sights(Index rule) {
        const Rule& sentence = rules_.moments[rule];
        const auto range = static_cast<float>(sentence.range * unit_);
        const auto cosine = static_cast<float>(std::cos(sentence.facing * radians_of_a_degree<double>));
        struct Run {
            Beat begin = 0;
            Beat end = -1;
        };
        const std::size_t players = footage_.players();
        std::vector<Run> runs(players * players);
        const auto close = [&](const Run& run, Index a, Index b) {
            if (run.end > run.begin) moments_.push_back({rule, run.begin, run.end, run.begin, a, b});
        };
        for (Beat beat = from_; beat < footage_.beats(); ++beat)
            for (const Meeting& meeting : footage_.meetings_at(beat)) {
                if (meeting.distance > range || meeting.cosine < cosine) continue;
                Run& run = runs[meeting.a * players + meeting.b];
                if (run.end != beat) {
                    close(run, meeting.a, meeting.b);
                    run.begin = beat;
                }
                run.end = beat + 1;
            }
        for (Index a = 0; a < players; ++a)
            for (Index b = a + 1; b < players; ++b)
                close(runs[a * players + b], a, b);
    }

    // Runs of beats of each player.
    void find_last_alive(Index rule) {
        const std::size_t players = footage_.players();
        const Beat first = std::max(footage_.first(), from_ - out_after);
        std::vector<Beat> dead_since(players, first);
        std::vector<Beat> last_since(players, -1);
        for (Beat beat = first; beat <= footage_.beats(); ++beat) {
            PlayerSet last;
            if (beat < footage_.beats()) {
                const auto states = footage_.players_at(beat);
                for (std::size_t i = 0; i < players; ++i)
                    if (states[i].alive) dead_since[i] = beat + 1;
                if (beat >= from_) last = last_of_teams(states, dead_since, beat);
            }
            for (Index player = 0; player < players; ++player) {
                if (last[player] == (last_since[player] >= 0)) continue;
                const Beat begin = std::exchange(last_since[player], last[player] ? beat : -1);
                if (!last[player]) moments_.push_back({rule, begin, beat, begin, player, nobody});
            }
        }
    }

    const Footage& footage_;
    std::span<const Event> events_;
    std::span<const Event> recent_;
    const Rules& rules_;
    double unit_;
    Beat from_;
    const Tally& tally_;
    std::vector<Moment> moments_;
};

}  // namespace

std::vector<Moment> find_moments(const Footage& footage, std::span<const Event> events, const Rules& rules,
                                 double unit, Beat from, const Tally& tally) {
    return Finder(footage, events, rules, unit, from, tally).find();
}

Tally::Ended Tally::count(const Event& event) {
    Ended ended;
    if (event.kind == EventKind::flag_taken && event.actor != nobody) {
        auto& since = player(event.actor).carries_since;
        since = since.value_or(event.time);
    }
    if (event.kind == EventKind::flag_captured && event.actor != nobody)
        ended.flag_run = end_flag_run(event.actor);
    if (event.kind != EventKind::kill) return ended;
    if (between_players(event)) {
        Player& killer = player(event.actor);
        if (++killer.kills_of_this_life == streak_kills) killer.streak_since = event.time;
        ++killer.kills;
        if (!lead_ || killer.kills > player(lead_->player).kills)
            ended.lead = std::exchange(lead_, Run{event.actor, event.time});
    }
    if (event.subject == nobody) return ended;
    Player& victim = player(event.subject);
    if (std::exchange(victim.kills_of_this_life, 0) >= streak_kills)
        ended.streak = Run{event.subject, victim.streak_since};
    ended.flag_run = end_flag_run(event.subject);
    return ended;
}

std::optional<Tally::Run> Tally::end_flag_run(Index carrier) {
    const auto since = std::exchange(player(carrier).carries_since, {});
    return since ? std::optional(Run{carrier, *since}) : std::nullopt;
}

std::vector<Tally::Run> Tally::streaks() const {
    std::vector<Run> streaks;
    for (Index i = 0; i < players_.size(); ++i)
        if (players_[i].kills_of_this_life >= streak_kills) streaks.push_back({i, players_[i].streak_since});
    return streaks;
}

std::vector<Tally::Run> Tally::leads() const {
    return lead_ ? std::vector{*lead_} : std::vector<Run>{};
}

std::vector<Tally::Run> Tally::flag_runs() const {
    std::vector<Run> runs;
    for (Index i = 0; i < players_.size(); ++i)
        if (const auto& since = players_[i].carries_since) runs.push_back({i, *since});
    return runs;
}

Tally::Player& Tally::player(Index index) {
    if (index >= players_.size()) players_.resize(static_cast<std::size_t>(index) + 1);
    return players_[index];
}

std::vector<Kill> kills_of(std::span<const Event> events) {
    std::vector<Kill> kills;
    std::array<std::size_t, max_players> last{};
    std::array<bool, max_players> any{};
    for (const Event& event : events) {
        if (event.kind != EventKind::kill || !between_players(event)) continue;
        Kill kill{event.time, event.actor, event.subject, kills.size()};
        if (any[event.actor] && event.time - kills[last[event.actor]].time <= chain_s)
            kill.first = kills[last[event.actor]].first;
        any[event.actor] = true;
        last[event.actor] = kills.size();
        kills.push_back(kill);
    }
    return kills;
}

}  // namespace camdir::direction
