#include "evaluation/group_recording.hpp"

#include <algorithm>
#include <array>
#include <memory>

#include "camera/group/group_shot.hpp"
#include "evaluation/replay.hpp"

namespace camdir::evaluation {

Result<GroupRecording> record_group(const freespace::Freespace& freespace, const camera::Profile& profile,
                                    const Trace& poses, std::span<const MoverRow> movers, const Trace& trace,
                                    std::span<const std::uint32_t> members, double look_ahead,
                                    const std::stop_token& stop) {
    const std::int64_t start = std::min(poses.frames.front().time, trace.frames.front().time);
    std::vector<std::vector<camera::TimedPose>> tracks;
    std::vector<KnownPoses> known;
    for (const std::uint32_t member : members)
        tracks.push_back(timed_poses(poses, member, start));
    for (const auto& track : tracks)
        known.emplace_back(track, look_ahead);

    KnownMovers known_movers(freespace, movers, poses, start, look_ahead);
    GroupRecording recording;
    camera::GroupState state;
    const auto outlook = std::make_unique<camera::Outlook>();
    std::array<camera::Window, camera::max_members> windows;
    for (const TraceFrame& frame : trace.frames) {
        if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
        const double time = seconds(frame.time - start);
        for (std::size_t i = 0; i < known.size(); ++i)
            windows[i] = known[i].at(time);
        const freespace::Space space(freespace, movers.empty() ? nullptr : &known_movers.at(time));
        const double before = cpu_nanoseconds();
        const camera::Camera camera =
            camera::step(space, profile, std::span(windows).first(known.size()), time, state, *outlook);
        recording.step_nanoseconds.push_back(cpu_nanoseconds() - before);
        recording.cameras.push_back(sampled(camera, (camera.flags & camera::cut) != 0));
    }
    return recording;
}

}  // namespace camdir::evaluation
