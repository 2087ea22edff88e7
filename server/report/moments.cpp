#include "report/moments.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "report/faults.hpp"
#include "report/markup.hpp"
#include "report/subject.hpp"

namespace camdir::report {
namespace {

using evaluation::Judgement;
using evaluation::Trace;

constexpr double apart = 1.0;  // seconds between two moments of a player

struct Candidates {
    Moment::Kind kind;
    std::size_t limit;
    bool run;  // a run of such frames counts by its length, else each frame by its value
    std::function<double(const Judgement&)> value;  // above 0: such a frame
};

const std::vector<Candidates>& kinds() {
    using Kind = Moment::Kind;
    static const std::vector<Candidates> all = {
        {Kind::through, 2, false, [](const Judgement& j) { return j.fly_through ? j.speed : 0.0; }},
        {Kind::in_solid, 2, true, [](const Judgement& j) { return j.in_solid ? 1.0 : 0.0; }},
        {Kind::jump, 2, false, [](const Judgement& j) { return j.pop ? j.speed : 0.0; }},
        {Kind::hidden, 2, true,
         [](const Judgement& j) { return (j.faults & evaluation::hidden) != 0 ? 1.0 : 0.0; }},
        {Kind::bad, 3, true, [](const Judgement& j) { return j.faults != 0 ? 1.0 : 0.0; }},
        {Kind::acceleration, 2, false, [](const Judgement& j) { return j.motion.acceleration; }},
        {Kind::turn, 2, false, [](const Judgement& j) { return j.motion.angular_speed; }},
    };
    return all;
}

class Search {
  public:
    Search(const Trace& trace, std::span<const Judgement> judgements)
        : trace_(trace), judgements_(judgements) {}

    [[nodiscard]] std::vector<Moment> candidates(const Candidates& kind) const {
        std::vector<Moment> found;
        for (std::size_t player = 0; player < trace_.players.size(); ++player) {
            const auto track = evaluation::track_of(trace_, trace_.players[player]);
            const auto value = [&](std::size_t frame) {
                return track[frame] == evaluation::absent ? 0.0 : kind.value(judgements_[track[frame]]);
            };
            if (kind.run)
                add_runs(kind.kind, player, value, found);
            else
                add_peaks(kind.kind, player, value, found);
        }
        std::ranges::stable_sort(found, std::greater<>(), &Moment::value);
        return found;
    }

    [[nodiscard]] bool is_apart(const Moment& a, const Moment& b) const {
        return a.player != b.player || begin(a) > end(b) + apart || begin(b) > end(a) + apart;
    }

  private:
    template <class Value>
    void add_runs(Moment::Kind kind, std::size_t player, const Value& value,
                  std::vector<Moment>& found) const {
        for (const Run& run :
             runs_where(trace_.frames.size(), [&](std::size_t frame) { return value(frame) > 0.0; })) {
            const std::size_t next = std::min(run.last, trace_.frames.size() - 1);
            found.push_back({kind, player, run, seconds_at(trace_, next) - seconds_at(trace_, run.first)});
        }
    }

    // The largest of every second.
    template <class Value>
    void add_peaks(Moment::Kind kind, std::size_t player, const Value& value,
                   std::vector<Moment>& found) const {
        double second = -1.0;
        for (std::size_t frame = 0; frame < trace_.frames.size(); ++frame) {
            const Moment moment{kind, player, {frame, frame + 1}, value(frame)};
            if (!(moment.value > 0.0)) continue;
            const double now = std::floor(seconds_at(trace_, frame));
            if (now != second)
                found.push_back(moment);
            else if (moment.value > found.back().value)
                found.back() = moment;
            second = now;
        }
    }

    [[nodiscard]] double begin(const Moment& moment) const { return seconds_at(trace_, moment.frames.first); }
    [[nodiscard]] double end(const Moment& moment) const {
        return seconds_at(trace_, moment.frames.last - 1);
    }

    const Trace& trace_;
    std::span<const Judgement> judgements_;
};

// "eye hidden in 12 of 20 frames, ..."
std::string faults_of(const Moment& moment, const Trace& trace, std::span<const Judgement> judgements) {
    const auto track = evaluation::track_of(trace, trace.players[moment.player]);
    std::string text;
    for (const FaultName& name : fault_names) {
        std::size_t count = 0;
        for (std::size_t frame = moment.frames.first; frame < moment.frames.last; ++frame)
            count +=
                track[frame] != evaluation::absent && (judgements[track[frame]].faults & name.fault) != 0;
        if (count == 0) continue;
        text += (text.empty() ? "" : ", ") + std::string(name.text) + " in " + std::to_string(count) +
                " of " + std::to_string(moment.frames.size()) + " frames";
    }
    return text;
}

}  // namespace

std::vector<Moment> worst_moments(const Trace& trace, std::span<const Judgement> judgements,
                                  std::size_t max) {
    const Search search(trace, judgements);
    std::vector<Moment> chosen;
    for (const Candidates& kind : kinds()) {
        std::size_t left = kind.limit;
        for (const Moment& moment : search.candidates(kind)) {
            if (left == 0 || chosen.size() == max) break;
            if (!std::ranges::all_of(chosen,
                                     [&](const Moment& other) { return search.is_apart(moment, other); }))
                continue;
            chosen.push_back(moment);
            --left;
        }
    }
    return chosen;
}

std::string describe(const Moment& moment, const Trace& trace, std::span<const Judgement> judgements) {
    const std::string seconds = decimal(moment.value, 2) + " s";
    switch (moment.kind) {
        case Moment::Kind::through:
            return "Passes through an obstacle without a cut, at " + decimal(moment.value, 0) + " units/s";
        case Moment::Kind::in_solid:
            return "In an obstacle or outside the map for " + seconds;
        case Moment::Kind::jump:
            return "Jumps without declaring a cut, at " + decimal(moment.value, 0) + " units/s";
        case Moment::Kind::hidden:
            return "The player's eye is hidden for " + seconds;
        case Moment::Kind::bad:
            return "Not good for " + seconds + ": " + faults_of(moment, trace, judgements);
        case Moment::Kind::acceleration:
            return "Accelerates by " + decimal(moment.value, 0) + " units/s\u00b2";
        case Moment::Kind::turn:
            return "Turns at " + decimal(moment.value, 0) + " degrees/s";
    }
    return {};
}

}  // namespace camdir::report
