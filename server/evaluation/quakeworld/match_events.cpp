#include "evaluation/quakeworld/match_events.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <set>
#include <utility>

#include "evaluation/quakeworld/tracks.hpp"

namespace camdir::evaluation::quakeworld {
namespace {

using Player = std::optional<std::uint32_t>;
using Death = std::pair<std::uint32_t, std::int64_t>;  // who and when, ns

constexpr std::int64_t longest_to_death =
    150'000'000;  // ns between an obituary and the death that it tells of

class EventBuilder {
  public:
    EventBuilder(const Demo& demo, const Trace& trace) : demo_(demo), trace_(trace) {
        const std::vector<Slot> slots = slots_of(demo);
        for (std::size_t player = 0; player < slots.size(); ++player)
            player_of_[slots[player]] = static_cast<std::uint32_t>(player);
        find_deaths();
    }

    std::vector<TraceEvent> build() {
        for (const Occurrence& occurrence : demo_.occurrences)
            if (occurrence.kind == Occurrence::Kind::obituary)
                explain(player(occurrence.subject), time(occurrence));
        for (const Occurrence& occurrence : demo_.occurrences)
            add(occurrence);
        return std::move(events_);
    }

  private:
    void find_deaths() {
        std::vector<bool> alive(trace_.players.size());
        for (const TraceFrame& frame : trace_.frames)
            for (const TracePose& pose : trace_.poses_of(frame)) {
                if (alive[pose.player] && !pose.alive) deaths_.emplace_back(pose.player, frame.time);
                alive[pose.player] = pose.alive;
            }
    }

    void add(const Occurrence& occurrence) {
        TraceEvent event{
            time(occurrence), {}, player(occurrence.actor), player(occurrence.subject), occurrence.detail};
        switch (occurrence.kind) {
            case Occurrence::Kind::obituary:
                if (!occurrence.subject && event.actor)
                    event.subject = killed_team_mate(*event.actor, event.time);
                if (!event.actor && event.subject && event.detail == "team")
                    event.actor = team_mate_at(*event.subject, event.time);
                event.kind = event.actor ? "kill" : "death";
                break;
            case Occurrence::Kind::damage:
                if (!event.subject) return;
                event.kind = "damage";
                break;
            case Occurrence::Kind::item:
                event.kind = "item";
                break;
            default:
                return;
        }
        if (event.actor || event.subject) events_.push_back(std::move(event));
    }

    // The death that an obituary tells of has no other.
    void explain(const Player& victim, std::int64_t time) {
        if (!victim) return;
        if (const auto death = death_near(*victim, time)) explained_.insert(*death);
    }

    Player killed_team_mate(std::uint32_t killer, std::int64_t time) {
        std::optional<Death> nearest;
        for (const std::uint32_t mate : team_mates(killer)) {
            const auto death = death_near(mate, time);
            if (!death || explained_.contains(*death)) continue;
            if (!nearest || distance(*death, time) < distance(*nearest, time)) nearest = death;
        }
        if (!nearest) return std::nullopt;
        explained_.insert(*nearest);
        return nearest->first;
    }

    // Who now stands where the victim stood, as after a teleport upon them.
    [[nodiscard]] Player team_mate_at(std::uint32_t victim, std::int64_t time) const {
        const TracePose* place = last_pose(victim, time);
        Player nearest;
        double least = std::numeric_limits<double>::infinity();
        for (const std::uint32_t mate : team_mates(victim)) {
            const TracePose* pose = last_pose(mate, time);
            if (place == nullptr || pose == nullptr) continue;
            const double apart = (pose->origin() - place->origin()).norm();
            if (apart < least) nearest = mate;
            least = std::min(least, apart);
        }
        return nearest;
    }

    [[nodiscard]] std::optional<Death> death_near(std::uint32_t player, std::int64_t time) const {
        std::optional<Death> nearest;
        const auto first = std::ranges::lower_bound(deaths_, time - longest_to_death, {}, &Death::second);
        for (auto death = first; death != deaths_.end() && death->second <= time + longest_to_death; ++death)
            if (death->first == player && (!nearest || distance(*death, time) < distance(*nearest, time)))
                nearest = *death;
        return nearest;
    }

    [[nodiscard]] static std::int64_t distance(const Death& death, std::int64_t time) {
        return std::abs(death.second - time);
    }

    [[nodiscard]] std::vector<std::uint32_t> team_mates(std::uint32_t player) const {
        std::vector<std::uint32_t> mates;
        const std::vector<Slot> slots = slots_of(demo_);
        for (const std::uint32_t other : trace_.players)
            if (other != player && demo_.teams[slots[other]] == demo_.teams[slots[player]])
                mates.push_back(other);
        return mates;
    }

    [[nodiscard]] const TracePose* last_pose(std::uint32_t player, std::int64_t time) const {
        auto frame = std::ranges::upper_bound(trace_.frames, time, {}, &TraceFrame::time);
        while (frame != trace_.frames.begin())
            if (const std::uint32_t pose = pose_of(trace_, *--frame, player); pose != absent)
                return &trace_.poses[pose];
        return nullptr;
    }

    [[nodiscard]] Player player(const std::optional<Slot>& slot) const {
        return slot ? player_of_[*slot] : std::nullopt;
    }
    [[nodiscard]] static std::int64_t time(const Occurrence& occurrence) {
        return occurrence.time * 1'000'000;
    }

    const Demo& demo_;
    const Trace& trace_;
    std::array<Player, max_slots> player_of_;
    std::vector<Death> deaths_;  // ascending by time
    std::set<Death> explained_;
    std::vector<TraceEvent> events_;
};

}  // namespace

std::vector<TraceEvent> events_of(const Demo& demo, const Trace& trace) {
    return EventBuilder(demo, trace).build();
}

}  // namespace camdir::evaluation::quakeworld
