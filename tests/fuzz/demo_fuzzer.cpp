#include <cassert>
#include <cstdint>
#include <span>

#include "evaluation/match.hpp"
#include "evaluation/quakeworld/mvd.hpp"

// Whatever the bytes: an error with a message, or a match whose frames cover its poses in order and whose
// events are of its players.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace camdir::evaluation;
    const auto match = quakeworld::parse_demo(std::as_bytes(std::span(data, size)), "input");
    if (!match) {
        assert(!match.error().message.empty());
        return 0;
    }
    const Trace& trace = match->trace;
    std::uint32_t next = 0;
    std::int64_t time = -1;
    for (const TraceFrame& frame : trace.frames) {
        assert(frame.first_pose == next && frame.pose_count > 0 && frame.time > time);
        next += frame.pose_count;
        time = frame.time;
    }
    assert(next == trace.poses.size());
    for (const TracePose& pose : trace.poses)
        assert(pose.player < trace.players.size() && pose.eye.allFinite() && pose.velocity.allFinite());
    time = 0;
    for (const TraceEvent& event : *match->events) {
        assert(event.time >= time && (event.actor || event.subject));
        assert(event.actor.value_or(0) < trace.players.size());
        assert(event.subject.value_or(0) < trace.players.size());
        time = event.time;
    }
    return 0;
}
