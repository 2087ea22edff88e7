#include "direction/figures.hpp"

#include <algorithm>
#include <array>

#include "direction/grammar.hpp"
#include "direction/value.hpp"

namespace camdir::direction {
namespace {

constexpr double mourning_s = 1.0;
constexpr double fight_range = 1200.0;
constexpr double too_short_s = 1.5;

struct Beats {
    Beat begin = 0;
    Beat end = 0;  // not of it any more
};

// In which a kill is to be seen.
Beats beats_of_kill(double time) {
    return {beat_of(time - before_kill_s), beat_of(time + after_kill_s) + 1};
}

struct Seen {
    bool counted = false;
    bool one = true;
    bool both = true;
};

class Judge {
  public:
    Judge(const Footage& footage, std::span<const Shot> shots, const Grammar& grammar, double unit)
        : footage_(footage), shots_(shots), grammar_(grammar), unit_(unit) {
        for (const Shot& shot : shots)
            on_air_.insert(on_air_.end(), static_cast<std::size_t>(shot.end - shot.begin), shot.rush);
    }

    void judge_kills(std::span<const Event> events, Figures& figures) const {
        const auto kills = kills_of(events);
        std::vector<Seen> seen;
        for (const Kill& kill : kills) {
            seen.push_back(see(kill));
            if (!seen.back().counted) continue;
            figures.kills += 1.0;
            figures.kills_seen += seen.back().one ? 1.0 : 0.0;
            figures.kills_seen_both += seen.back().both ? 1.0 : 0.0;
            figures.missed_by_cut += !seen.back().one && cut_before(kill) ? 1.0 : 0.0;
        }
        judge_chains(kills, seen, figures);
    }

    void judge_cuts(Figures& figures) const {
        for (std::size_t i = 0; i + 1 < shots_.size(); ++i) {
            const Beat cut = shots_[i].end;
            const std::size_t from = shots_[i].rush;
            const std::size_t to = shots_[i + 1].rush;
            figures.jump_cuts += jump_cut(footage_, grammar_, cut, from, to) ? 1.0 : 0.0;
            figures.line_crossings += crosses_line(footage_, cut, from, to) ? 1.0 : 0.0;
        }
        auto lengths = lengths_of_pieces();
        const double minutes = static_cast<double>(footage_.beats()) * beat_s / 60.0;
        figures.cuts_per_minute = static_cast<double>(lengths.size()) / minutes;
        std::ranges::sort(lengths);
        figures.shots_under_1_5 =
            static_cast<double>(std::ranges::lower_bound(lengths, too_short_s - 1e-9) - lengths.begin());
        figures.shot_s_p10 = percentile(lengths, 0.1);
        figures.shot_s_p50 = percentile(lengths, 0.5);
        figures.shot_s_p90 = percentile(lengths, 0.9);
    }

    void judge_delays(std::span<const Moment> moments, Figures& figures) const {
        Beat sum = 0;
        Beat shown = 0;
        for (const Moment& moment : moments) {
            Beat beat = moment.begin;
            while (beat < moment.end && !shows(footage_.take(beat, rush_at(beat)), moment))
                ++beat;
            if (beat == moment.end) continue;
            sum += beat - moment.begin;
            ++shown;
        }
        if (shown > 0)
            figures.moment_delay_s = static_cast<double>(sum) * beat_s / static_cast<double>(shown);
    }

    void judge_idleness(Figures& figures) const {
        double idle = 0.0;
        for (Beat beat = 0; beat < footage_.beats(); ++beat)
            idle += out_of_action(beat, footage_.take(beat, rush_at(beat)).subject) && somebody_fights(beat)
                        ? 1.0
                        : 0.0;
        figures.idle_share = idle / static_cast<double>(footage_.beats());
    }

    [[nodiscard]] Seen see(const Kill& kill) const {
        const auto [begin, end] = beats_of_kill(kill.time);
        Seen seen{kill_counts(footage_, kill.time)};
        for (Beat beat = begin; seen.counted && beat < end; ++beat) {
            const PlayerSet& shown = footage_.take(beat, rush_at(beat)).shown;
            seen.one = seen.one && (shown[kill.killer] || shown[kill.victim]);
            seen.both = seen.both && shown[kill.killer] && shown[kill.victim];
        }
        return seen;
    }

  private:
    [[nodiscard]] std::size_t rush_at(Beat beat) const { return on_air_[static_cast<std::size_t>(beat)]; }

    // Between two cuts, whoever makes them, and before the first.
    [[nodiscard]] std::vector<double> lengths_of_pieces() const {
        std::vector<double> lengths;
        Beat begin = 0;
        for (Beat beat = 1; beat < footage_.beats(); ++beat) {
            const std::size_t rush = rush_at(beat);
            const bool changes = rush != rush_at(beat - 1);
            if (!changes && !footage_.take(beat, rush).cut) continue;
            lengths.push_back(static_cast<double>(beat - begin) * beat_s);
            begin = beat;
            if (changes && footage_.jumps_late(beat, rush)) lengths.push_back(0.0);
        }
        return lengths;
    }

    [[nodiscard]] bool cut_before(const Kill& kill) const {
        return std::ranges::any_of(shots_.subspan(1), [&](const Shot& shot) {
            return shot.begin > beat_of(kill.time - before_kill_s) && shot.begin <= beat_of(kill.time);
        });
    }

    static void judge_chains(std::span<const Kill> kills, std::span<const Seen> seen, Figures& figures) {
        struct Chain {
            std::size_t links = 0;
            bool counted = true;
            bool all = true;
        };
        std::vector<Chain> chains(kills.size());  // at the place of their first kill
        for (std::size_t i = 0; i < kills.size(); ++i) {
            Chain& chain = chains[kills[i].first];
            ++chain.links;
            chain.counted = chain.counted && seen[i].counted;
            chain.all = chain.all && seen[i].one;
        }
        for (const Chain& chain : chains) {
            if (chain.links < 2 || !chain.counted) continue;
            figures.multi_kills += 1.0;
            figures.multi_kills_seen += chain.all ? 1.0 : 0.0;
        }
    }

    [[nodiscard]] bool out_of_action(Beat beat, Index player) const {
        if (player == nobody) return true;
        const Beat earlier = beat - beat_of(mourning_s);
        const bool dead =
            earlier >= 0 && !footage_.player(beat, player).alive && !footage_.player(earlier, player).alive;
        return dead || stands_idle(footage_, beat, player, idle_speed * unit_);
    }

    [[nodiscard]] bool somebody_fights(Beat beat) const {
        for (std::size_t a = 0; a < footage_.players(); ++a)
            for (std::size_t b = a + 1; b < footage_.players(); ++b) {
                const PlayerState& one = footage_.player(beat, a);
                const PlayerState& other = footage_.player(beat, b);
                if (one.sees[b] && one.alive && other.alive && enemies(one, other) &&
                    (one.eye - other.eye).norm() < static_cast<float>(fight_range * unit_))
                    return true;
            }
        return false;
    }

    static double percentile(std::span<const double> sorted, double share) {
        if (sorted.empty()) return 0.0;
        return sorted[static_cast<std::size_t>(share * static_cast<double>(sorted.size() - 1) + 0.5)];
    }

    const Footage& footage_;
    std::span<const Shot> shots_;
    Grammar grammar_;
    double unit_;
    std::vector<std::size_t> on_air_;  // the rush of each beat
};

constexpr std::array<FigureName, 15> names{{
    {"kills", &Figures::kills, 0, "of one player by another"},
    {"kills_seen", &Figures::kills_seen, 0,
     "killer or victim is in view from 1 s before to 0.5 s after: more is better"},
    {"kills_seen_both", &Figures::kills_seen_both, 0, "both are"},
    {"multi_kills", &Figures::multi_kills, 0,
     "two or more kills of one player, each within 3 s of the one before"},
    {"multi_kills_seen", &Figures::multi_kills_seen, 0, "all of their kills are seen"},
    {"cuts_per_minute", &Figures::cuts_per_minute, 1, "those that a camera makes by itself too"},
    {"shot_s_p10", &Figures::shot_s_p10, 1,
     "seconds between two cuts: one in ten is shorter; wanted 2 or more"},
    {"shot_s_p50", &Figures::shot_s_p50, 1, "their median; wanted 4 to 8"},
    {"shot_s_p90", &Figures::shot_s_p90, 1, "one in ten is longer"},
    {"shots_under_1_5", &Figures::shots_under_1_5, 0, "too short to be read: wanted 0"},
    {"jump_cuts", &Figures::jump_cuts, 0, "the same player from nearly the same side: wanted 0"},
    {"line_crossings", &Figures::line_crossings, 0, "two who fight change places on the screen: wanted 0"},
    {"idle_share", &Figures::idle_share, 2,
     "share of the time on the dead or idle while others fight: wanted 0.02 or less"},
    {"missed_by_cut", &Figures::missed_by_cut, 0,
     "kills that are not seen, with a cut in the second before: wanted 0"},
    {"moment_delay_s", &Figures::moment_delay_s, 2, "seconds from the begin of a moment to its being shown"},
}};

}  // namespace

Figures judge(const Footage& footage, std::span<const Event> events, std::span<const Moment> moments,
              std::span<const Shot> shots, const Grammar& grammar, double unit) {
    Figures figures;
    const Judge judge(footage, shots, grammar, unit);
    judge.judge_kills(events, figures);
    judge.judge_cuts(figures);
    judge.judge_delays(moments, figures);
    judge.judge_idleness(figures);
    return figures;
}

std::size_t kills_in_reach(const Footage& footage, std::span<const Event> events) {
    const auto kills = kills_of(events);
    const auto is_in_reach = [&](const Kill& kill) {
        if (!kill_counts(footage, kill.time)) return false;
        const auto [begin, end] = beats_of_kill(kill.time);
        for (Beat beat = begin; beat < end; ++beat)
            if (std::ranges::none_of(footage.takes_at(beat), [&](const Take& take) {
                    return take.shown[kill.killer] || take.shown[kill.victim];
                }))
                return false;
        return true;
    };
    return static_cast<std::size_t>(std::ranges::count_if(kills, is_in_reach));
}

std::vector<bool> kills_shown(const Footage& footage, std::span<const Shot> shots,
                              std::span<const Kill> kills) {
    const Judge judge(footage, shots, Grammar{}, 1.0);
    std::vector<bool> shown;
    for (const Kill& kill : kills) {
        const Seen seen = judge.see(kill);
        shown.push_back(seen.counted && seen.one);
    }
    return shown;
}

bool kill_counts(const Footage& footage, double kill_time) {
    const auto [begin, end] = beats_of_kill(kill_time);
    return begin >= 0 && end <= footage.beats();
}

Figures mean_of(std::span<const Figures> figures) {
    Figures mean;
    for (const FigureName& figure : names) {
        for (const Figures& one : figures)
            mean.*figure.member += one.*figure.member;
        mean.*figure.member /= static_cast<double>(figures.size());
    }
    return mean;
}

std::span<const FigureName> figure_names() {
    return names;
}

}  // namespace camdir::direction
