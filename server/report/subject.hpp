// What a page is about: a match, a camera, and cameras to compare it with.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "evaluation/judgement.hpp"
#include "evaluation/metrics.hpp"
#include "scene/scene.hpp"

namespace camdir::report {

// cameras[i] and judgements[i] are of trace.poses[i].
struct JudgedCamera {
    std::string name;
    evaluation::CameraPath cameras;
    std::vector<evaluation::Judgement> judgements;
    evaluation::Metrics metrics;
};

struct Fact {
    std::string name;
    std::string value;
};

// The scene and the trace must outlive it.
struct Subject {
    const scene::Scene& scene;
    const evaluation::Trace& trace;     // at least one frame
    double point_radius = 0.0;          // of the obstacles in a cloud
    std::string freespace_file;         // empty: none
    std::string trace_file;             // as the user named it
    std::string cameras_file;           // of the camera, as `evaluate --cameras` wrote it; empty: not written
    std::vector<Fact> facts;            // of the run, in the order to show
    std::vector<JudgedCamera> cameras;  // the first is the page's, the others are beside it; at least one
};

// Seconds since the trace's first frame.
[[nodiscard]] inline double seconds_at(const evaluation::Trace& trace, std::size_t frame) {
    return static_cast<double>(trace.frames[frame].time - trace.frames.front().time) * 1e-9;
}

// Of the whole trace; above 0.
[[nodiscard]] inline double duration(const evaluation::Trace& trace) {
    return std::max(seconds_at(trace, trace.frames.size() - 1), 1e-3);
}

}  // namespace camdir::report
