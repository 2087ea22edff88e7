#include "bench/cameras/camera.hpp"

#include "bench/queries/samples.hpp"

namespace camdir::bench {

evaluation::Recording follow_all(const evaluation::Trace& trace, const Camera& camera) {
    evaluation::Recording recording;
    recording.cameras.resize(trace.poses.size());
    Samples samples;
    for (const std::uint32_t player : trace.players) {
        const Follow follow = camera.make();
        const auto track = evaluation::track_of(trace, player);
        for (std::size_t i = 0; i < track.size(); ++i) {
            if (track[i] == evaluation::absent) continue;
            const std::int64_t step = i == 0 ? 0 : trace.frames[i].time - trace.frames[i - 1].time;
            const evaluation::TracePose& pose = trace.poses[track[i]];
            recording.cameras[track[i]] =
                samples.time([&] { return follow(pose, static_cast<double>(step) * 1e-9); });
        }
    }
    recording.step_nanoseconds = samples.nanoseconds();
    return recording;
}

}  // namespace camdir::bench
