#include "app/recorded_match.hpp"

#include <algorithm>
#include <cmath>
#include <iostream>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "recording/reader.hpp"

namespace camdir::app {
namespace {

constexpr std::size_t max_players = 256;  // of a trace
constexpr float view_height = 26.0F;      // units of 0.0254 m; of a standing player of Quake's

// Takes the records in their order.
class Assembly {
  public:
    void add(const director::MatchInfo& info) {
        teams_.clear();
        for (const director::Player& player : info.players)
            teams_[player.id] = player.team;
        const bool has_scale = info.metres_per_unit > 0.0F;
        view_height_ = view_height *
                       (has_scale ? static_cast<float>(metres_of_nominal_unit) / info.metres_per_unit : 1.0F);
    }

    // Nothing of an epoch remains when the next one begins.
    void add(const director::PoseFrame& frame) {
        if (frame.epoch != epoch_) {
            trace_ = {};
            last_seen_.clear();
            epoch_ = frame.epoch;
            std::erase_if(events_, [&](const Event& event) { return event.epoch != frame.epoch; });
        }
        if (!trace_.frames.empty() && frame.frame_time <= trace_.frames.back().time) return;
        std::map<std::uint32_t, const director::PlayerPose*> poses;  // by player
        for (const director::PlayerPose& pose : frame.poses)
            if ((pose.flags & director::pose_spectator) == 0) poses.emplace(pose.player_id, &pose);
        if (poses.empty() || poses.size() > max_players) return;
        trace_.frames.push_back({frame.frame_time, static_cast<std::uint32_t>(trace_.poses.size()),
                                 static_cast<std::uint32_t>(poses.size())});
        for (const auto& [player, pose] : poses)
            add(*pose);
    }

    // One of an epoch may come before its first poses.
    void add(const director::MatchEvent& event) {
        if (events_.size() == evaluation::max_events)
            events_.erase(events_.begin(), events_.begin() + evaluation::max_events / 8);
        const auto player = [](std::uint32_t id) {
            return id == director::no_player ? std::nullopt : std::optional(id);
        };
        std::string detail = event.detail;
        if (detail.empty() && std::isfinite(event.value) && event.value != 0.0F)
            detail = std::to_string(std::lround(event.value));
        events_.push_back({event.epoch,
                           {event.frame_time, director::table_name_of(event), player(event.actor),
                            player(event.subject), std::move(detail)}});
    }

    // Of players whom the trace knows.
    std::vector<evaluation::TraceEvent> events_of(const evaluation::Trace& trace) {
        const auto known = [&](const std::optional<std::uint32_t>& player) {
            return !player || std::ranges::binary_search(trace.players, *player);
        };
        std::vector<evaluation::TraceEvent> events;
        for (Event& event : events_)
            if (event.epoch == epoch_ && known(event.row.actor) && known(event.row.subject))
                events.push_back(std::move(event.row));
        std::ranges::stable_sort(events, {}, &evaluation::TraceEvent::time);
        return events;
    }

    Result<evaluation::Trace> finish(const std::string& name) {
        if (trace_.frames.empty()) return fail(name + ": has no poses, expected at least one frame");
        if (last_seen_.size() > max_players)
            return fail(name + ": has " + std::to_string(last_seen_.size()) + " players, expected at most " +
                        std::to_string(max_players));
        for (const auto& [player, seen] : last_seen_)
            trace_.players.push_back(player);
        return std::move(trace_);
    }

  private:
    struct LastSeen {
        std::size_t frame;  // counted from 1
        bool alive;
    };

    void add(const director::PlayerPose& pose) {
        evaluation::TracePose& added = trace_.poses.emplace_back();
        added.player = pose.player_id;
        added.eye = pose.eye.cast<double>();
        added.orientation = pose.orientation.cast<double>().normalized();
        added.velocity = pose.velocity.cast<double>();
        added.view_height = view_height_;
        const auto team = teams_.find(pose.player_id);
        added.team = team == teams_.end() ? std::uint8_t{0} : team->second;
        added.alive = (pose.flags & director::pose_alive) != 0;
        const LastSeen now{trace_.frames.size(), added.alive};
        const auto [seen, is_first] = last_seen_.try_emplace(pose.player_id, now);
        added.discontinuity = is_first || (pose.flags & director::pose_discontinuity) != 0 ||
                              seen->second.frame + 1 != now.frame || (now.alive && !seen->second.alive);
        seen->second = now;
    }

    struct Event {
        std::uint64_t epoch;
        evaluation::TraceEvent row;
    };

    evaluation::Trace trace_;
    std::vector<Event> events_;
    std::optional<std::uint64_t> epoch_;
    float view_height_ = view_height;
    std::map<std::uint32_t, std::uint8_t> teams_;
    std::map<std::uint32_t, LastSeen> last_seen_;
};

}  // namespace

Result<evaluation::RecordedMatch> match_of_recording(const std::filesystem::path& folder) {
    const auto reader = recording::Reader::open(folder);
    if (!reader) return tl::unexpected(reader.error());
    Assembly assembly;
    assembly.add(reader->start().match);
    constexpr auto from_begin = std::numeric_limits<std::int64_t>::min();
    const auto left_out = reader->replay(from_begin, [&](const recording::Record& record) {
        if (const auto* info = std::get_if<director::MatchInfo>(&record.message)) assembly.add(*info);
        if (const auto* frame = std::get_if<director::PoseFrame>(&record.message)) assembly.add(*frame);
        if (const auto* event = std::get_if<director::MatchEvent>(&record.message)) assembly.add(*event);
    });
    auto trace = assembly.finish(folder.string());
    if (!trace) return tl::unexpected(left_out.empty() ? trace.error() : left_out.front());
    evaluation::RecordedMatch match{std::move(*trace), {}, {}};
    if (!left_out.empty())
        match.warning =
            std::to_string(left_out.size()) + " fragments are left out; " + left_out.front().message;
    if (auto events = assembly.events_of(match.trace); !events.empty()) match.events = std::move(events);
    return match;
}

Result<evaluation::RecordedMatch> read_match(const std::filesystem::path& path, ProgressLine& line) {
    line.show("reading " + path.string(), 0, 0);
    auto match =
        std::filesystem::is_directory(path) ? match_of_recording(path) : evaluation::read_match(path);
    if (!match || match->warning.empty()) return match;
    line.clear();
    std::cerr << "camera-director: warning: " << match->warning << '\n';
    return match;
}

}  // namespace camdir::app
