#include "evaluation/resample.hpp"

#include <cassert>
#include <cmath>
#include <map>

namespace camdir::evaluation {
namespace {

constexpr double max_poses = 50e6;

TracePose interpolate(const TracePose& a, const TracePose& b, double fraction) {
    TracePose pose = a;
    pose.eye = a.eye + fraction * (b.eye - a.eye);
    pose.orientation = a.orientation.slerp(fraction, b.orientation);
    pose.velocity = a.velocity + fraction * (b.velocity - a.velocity);
    pose.view_height = a.view_height + static_cast<float>(fraction) * (b.view_height - a.view_height);
    return pose;
}

const TracePose* find(std::span<const TracePose> poses, std::uint32_t player) {
    for (const TracePose& pose : poses)
        if (pose.player == player) return &pose;
    return nullptr;
}

// Advances through the source's frames as the output's times do.
class Resampler {
  public:
    explicit Resampler(const Trace& source) : source_(source) {
        result_.players = source.players;
        note_discontinuities();
    }

    void emit(std::int64_t time) {
        while (frame_ + 1 < source_.frames.size() && source_.frames[frame_ + 1].time <= time) {
            ++frame_;
            note_discontinuities();
        }
        const TraceFrame& now = source_.frames[frame_];
        const TraceFrame& next = source_.frames[std::min(frame_ + 1, source_.frames.size() - 1)];
        const double fraction = next.time == now.time ? 0.0
                                                      : static_cast<double>(time - now.time) /
                                                            static_cast<double>(next.time - now.time);
        result_.frames.push_back({time, static_cast<std::uint32_t>(result_.poses.size()), now.pose_count});
        for (const TracePose& a : source_.poses_of(now)) {
            const TracePose* b = find(source_.poses_of(next), a.player);
            const bool continuous = b != nullptr && !b->discontinuity && a.alive && b->alive;
            TracePose pose = continuous && fraction > 0.0 ? interpolate(a, *b, fraction) : a;
            pose.discontinuity = std::exchange(discontinuity_[a.player], false);
            result_.poses.push_back(pose);
        }
    }

    Trace finish() { return std::move(result_); }

  private:
    void note_discontinuities() {
        for (const TracePose& pose : source_.poses_of(source_.frames[frame_]))
            if (pose.discontinuity) discontinuity_[pose.player] = true;
    }

    const Trace& source_;
    std::size_t frame_ = 0;
    std::map<std::uint32_t, bool> discontinuity_;  // not yet in the output
    Trace result_;
};

}  // namespace

Result<Trace> resample(const Trace& trace, double rate_hz) {
    assert(rate_hz > 0.0 && !trace.frames.empty());
    const std::int64_t start = trace.frames.front().time;
    const std::int64_t end = trace.frames.back().time;
    const double frames = std::floor(static_cast<double>(end - start) * 1e-9 * rate_hz) + 1.0;
    if (frames * static_cast<double>(trace.players.size()) > max_poses)
        return fail("at " + std::to_string(rate_hz) +
                    " Hz the trace would have more than 50 million poses, which is the limit");
    Resampler resampler(trace);
    for (std::int64_t i = 0;; ++i) {
        const std::int64_t time = start + std::llround(static_cast<double>(i) * 1e9 / rate_hz);
        if (time > end) return resampler.finish();
        resampler.emit(time);
    }
}

}  // namespace camdir::evaluation
