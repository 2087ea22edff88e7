#include <cassert>
#include <cstdint>
#include <span>

#include "evaluation/trace.hpp"

// Whatever the bytes: an error with a message, or a trace whose frames cover its poses in order.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace camdir::evaluation;
    const auto trace = parse_trace(std::as_bytes(std::span(data, size)), "input");
    if (!trace) {
        assert(!trace.error().message.empty());
        return 0;
    }
    std::uint32_t next = 0;
    std::int64_t time = -1;
    for (const TraceFrame& frame : trace->frames) {
        assert(frame.first_pose == next && frame.pose_count > 0 && frame.time > time);
        next += frame.pose_count;
        time = frame.time;
    }
    assert(next == trace->poses.size());
    for (const TracePose& pose : trace->poses)
        assert(pose.eye.allFinite() && pose.velocity.allFinite());
    return 0;
}
