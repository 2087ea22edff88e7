#include "replay.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace camdir::soak {
namespace {

// By its name in a table of events.
std::optional<std::uint32_t> kind_of(std::string_view name) {
    static const std::map<std::string_view, std::uint32_t> kinds = {
        {"kill", CDIR_EVENT_KILL},
        {"flag_taken", CDIR_EVENT_FLAG_TAKEN},
        {"flag_captured", CDIR_EVENT_FLAG_CAPTURED},
        {"objective", CDIR_EVENT_OBJECTIVE},
        {"damage", CDIR_EVENT_DAMAGE},
        {"award", CDIR_EVENT_AWARD},
        {"item", CDIR_EVENT_ITEM},
        {"round", CDIR_EVENT_ROUND},
        {"spawn", CDIR_EVENT_SPAWN},
        {"respawn", CDIR_EVENT_SPAWN},
        {"weapon", CDIR_EVENT_WEAPON},
    };
    const auto found = kinds.find(name);
    return found != kinds.end() ? std::optional(found->second) : std::nullopt;
}

camera_director::MatchEvent as_sent(const evaluation::TraceEvent& event, std::uint32_t kind) {
    camera_director::MatchEvent sent;
    sent.kind = kind;
    sent.actor = event.actor.value_or(CDIR_NO_PLAYER);
    sent.subject = event.subject.value_or(CDIR_NO_PLAYER);
    if (kind == CDIR_EVENT_DAMAGE)
        sent.value = std::strtof(event.detail.c_str(), nullptr);
    else
        sent.detail = event.detail.substr(0, sizeof(cdir_match_event::detail) - 1);
    return sent;
}

// By frame of the trace.
using EventsByFrame = std::vector<std::vector<camera_director::MatchEvent>>;

EventsByFrame by_frame(const evaluation::RecordedMatch& match) {
    const std::vector<evaluation::TraceFrame>& frames = match.trace.frames;
    EventsByFrame events(frames.size());
    for (const evaluation::TraceEvent& event : match.events.value_or(std::vector<evaluation::TraceEvent>())) {
        const auto kind = kind_of(event.kind);
        if (!kind) continue;
        const auto frame = std::ranges::lower_bound(frames, event.time, {}, &evaluation::TraceFrame::time);
        events[static_cast<std::size_t>(frame - frames.begin()) % frames.size()].push_back(
            as_sent(event, *kind));
    }
    return events;
}

}  // namespace

MatchFrames replay(std::shared_ptr<const evaluation::RecordedMatch> match, std::size_t first) {
    return [events = by_frame(*match), match = std::move(match), first](std::uint64_t number,
                                                                        MatchFrame& frame) {
        const evaluation::Trace& trace = match->trace;
        const std::size_t at = (first + number) % trace.frames.size();
        for (const evaluation::TracePose& pose : trace.poses_of(trace.frames[at])) {
            std::uint32_t flags = 0;
            if (pose.alive) flags |= CDIR_POSE_ALIVE;
            if (pose.discontinuity || at == 0) flags |= CDIR_POSE_DISCONTINUITY;
            frame.poses.add(pose.player, pose.eye.cast<float>(), pose.orientation.cast<float>(),
                            pose.velocity.cast<float>(), flags);
        }
        frame.events = events[at];
    };
}

}  // namespace camdir::soak
