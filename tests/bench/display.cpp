// bench-display: the cameras that a display shows through the client library, between those of a recorded
// match, for `camera-director evaluate --judge`.
#include <Eigen/Geometry>
#include <cmath>
#include <iostream>
#include <map>
#include <stdexcept>

#include "base/file.hpp"
#include "bench/program.hpp"
#include "camera_track.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/resample.hpp"
#include "freespace/distance.hpp"
#include "freespace/freespace.hpp"

namespace camdir::bench {
namespace {

using evaluation::CameraSample;

struct Options {
    std::string vfs, trace, cameras, output;
    double camera_hz = 60.0, display_hz = 144.0, delay_ms = 50.0;
    bool straight = false;
};

// A player's shot as its observer sees it. The cameras arrive in time.
class Shot {
  public:
    Shot(const freespace::Freespace& freespace, bool straight) : freespace_(freespace), straight_(straight) {}

    void receive(std::int64_t time, const CameraSample& sample) {
        cdir_camera camera{};
        const Vec3f position = sample.position.cast<float>();
        Eigen::Map<Vec3f>(camera.position) = position;
        Eigen::Map<Quatf>(camera.orientation) = sample.orientation.cast<float>();
        camera.clearance = std::max(freespace::distance(freespace_, position).value, 0.0F);
        track_.add(time, camera, !sample.cut);
        cameras_[time] = sample;
    }

    CameraSample show(std::int64_t time) {
        const sdk::View view = track_.at(time).value();
        CameraSample shown{Eigen::Map<const Vec3f>(view.camera.position).cast<double>(),
                           Eigen::Map<const Quatf>(view.camera.orientation).cast<double>(),
                           view.segment != segment_};
        segment_ = view.segment;
        if (straight_) straighten(time, shown);
        return shown;
    }

  private:
    void straighten(std::int64_t time, CameraSample& shown) const {
        const auto after = cameras_.upper_bound(time);
        if (after == cameras_.end() || after == cameras_.begin() || after->second.cut) return;
        const auto before = std::prev(after);
        const double share =
            static_cast<double>(time - before->first) / static_cast<double>(after->first - before->first);
        shown.position = (1.0 - share) * before->second.position + share * after->second.position;
        shown.orientation = before->second.orientation.slerp(share, after->second.orientation);
    }

    const freespace::Freespace& freespace_;
    const bool straight_;
    sdk::CameraTrack track_;
    std::map<std::int64_t, CameraSample> cameras_;
    std::uint32_t segment_ = 0;
};

int run(const Options& options) {
    const auto freespace = value_of(freespace::Freespace::open(options.vfs));
    const auto recorded = value_of(evaluation::read_trace(options.trace));
    const auto frames = value_of(evaluation::resample(recorded, options.camera_hz));
    const auto pictures = value_of(evaluation::resample(recorded, options.display_hz));
    const auto cameras = value_of(evaluation::read_cameras(options.cameras, frames));
    const auto delay = std::llround(options.delay_ms * 1e6);

    std::map<std::uint32_t, Shot> shots;
    for (const std::uint32_t player : recorded.players)
        shots.try_emplace(player, freespace, options.straight);
    evaluation::CameraPath shown;
    auto arriving = frames.frames.begin();
    for (const evaluation::TraceFrame& picture : pictures.frames) {
        for (; arriving != frames.frames.end() && arriving->time <= picture.time + delay; ++arriving)
            for (std::uint32_t i = arriving->first_pose; i < arriving->first_pose + arriving->pose_count; ++i)
                shots.at(frames.poses[i].player).receive(arriving->time, cameras[i]);
        for (const evaluation::TracePose& pose : pictures.poses_of(picture))
            shown.push_back(shots.at(pose.player).show(picture.time));
    }
    const auto written = write_file(options.output, evaluation::format_cameras(pictures, shown));
    if (!written) throw std::runtime_error(written.error().message);
    return 0;
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app("Writes the cameras that a display shows between those of a recorded match.",
                 "bench-display");
    app.add_option("VFS", options.vfs, "The baked map, for the cameras' clearances")->required();
    app.add_option("--trace", options.trace, "The recorded match")->required();
    app.add_option("--cameras", options.cameras, "What `evaluate --cameras` wrote")->required();
    app.add_option("--camera-hz", options.camera_hz, "Their rate")->capture_default_str();
    app.add_option("--display-hz", options.display_hz)->capture_default_str();
    app.add_option("--delay", options.delay_ms, "Of the display, ms")->capture_default_str();
    app.add_flag("--straight", options.straight, "Straight lines from frame to frame, for comparison");
    app.add_option("-o,--output", options.output, "CSV")->required();
    return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    return camdir::bench::run(argc, argv);
}
