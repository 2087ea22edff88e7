#include "replay.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "base/utf8.hpp"
#include "director/messages.hpp"

namespace camdir::soak {
namespace {

// A damage that is no number counts as none.
float hit_points(const std::string& detail) {
    const float value = std::strtof(detail.c_str(), nullptr);
    return std::isfinite(value) ? value : 0.0F;
}

camera_director::MatchEvent as_sent(const evaluation::TraceEvent& event, director::MatchEventKind kind) {
    camera_director::MatchEvent sent;
    sent.kind = static_cast<std::uint32_t>(kind);
    sent.actor = event.actor.value_or(CDIR_NO_PLAYER);
    sent.subject = event.subject.value_or(CDIR_NO_PLAYER);
    if (kind == director::MatchEventKind::damage) {
        sent.value = hit_points(event.detail);
    } else {
        sent.detail = printable(event.detail);
        sent.detail.resize(utf8_prefix(sent.detail, sizeof(cdir_match_event::detail) - 1));
    }
    return sent;
}

// By frame of the trace.
using EventsByFrame = std::vector<std::vector<camera_director::MatchEvent>>;

EventsByFrame by_frame(const evaluation::RecordedMatch& match) {
    const std::vector<evaluation::TraceFrame>& frames = match.trace.frames;
    EventsByFrame events(frames.size());
    for (const evaluation::TraceEvent& event : match.events.value_or(std::vector<evaluation::TraceEvent>())) {
        const auto kind = director::event_kind_named(event.kind);
        const auto frame = std::ranges::lower_bound(frames, event.time, {}, &evaluation::TraceFrame::time);
        if (!kind || event.time < frames.front().time || frame == frames.end()) continue;
        events[static_cast<std::size_t>(frame - frames.begin())].push_back(as_sent(event, *kind));
    }
    return events;
}

}  // namespace

bool is_sent(std::string_view kind) {
    return director::event_kind_named(kind).has_value();
}

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
