// What cameras that are run over a trace are given, frame by frame, and what they give.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "camera/crowd.hpp"
#include "camera/window.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/mover_tracks.hpp"
#include "evaluation/trace.hpp"
#include "freespace/freespace.hpp"
#include "freespace/movers.hpp"

namespace camdir::evaluation {

[[nodiscard]] inline double seconds(std::int64_t nanoseconds) {
    return static_cast<double>(nanoseconds) * 1e-9;
}

// All poses of a player; times from `start`, ns.
[[nodiscard]] std::vector<camera::TimedPose> timed_poses(const Trace& trace, std::uint32_t player,
                                                         std::int64_t start);

// The part of a player's poses that is known at a time which ascends from call to call.
class KnownPoses {
  public:
    // `all` must live as long. `look_ahead` in seconds.
    KnownPoses(camera::Window all, double look_ahead) : all_(all), look_ahead_(look_ahead) {}

    [[nodiscard]] camera::Window at(double time);

  private:
    camera::Window all_;
    double look_ahead_;
    std::size_t first_ = 0;
    std::size_t end_ = 0;
};

// The same of all players of a trace. One thread at a time.
class KnownCrowd {
  public:
    // `tracks`: of each player of `trace`, by timed_poses(); both must live as long.
    KnownCrowd(const Trace& trace, std::span<const std::vector<camera::TimedPose>> tracks, double look_ahead);

    // For the shot of `own`. Valid until the next call.
    [[nodiscard]] camera::Crowd at(double time, std::uint32_t own);

  private:
    std::vector<KnownPoses> known_;
    std::vector<camera::Crowd::Player> players_;
};

[[nodiscard]] std::vector<std::vector<camera::TimedPose>> timed_poses_of_all(const Trace& trace,
                                                                             std::int64_t start);

// The match's movers as far as they are known at a time which ascends from call to call. One thread at a
// time.
class KnownMovers {
  public:
    // `rows` were recorded beside `poses`, and both must live as long; rows of models that the freespace has
    // no shape of are left out. Times from `start`, ns; `look_ahead` in seconds.
    KnownMovers(const freespace::Freespace& freespace, std::span<const MoverRow> rows, const Trace& poses,
                std::int64_t start, double look_ahead);

    // Valid until the next call.
    [[nodiscard]] const freespace::Movers& at(double time);

  private:
    void skip_to(double time);
    [[nodiscard]] std::optional<std::int64_t> next_frame() const;
    void read_frame(std::int64_t time);

    freespace::Movers movers_;
    std::map<std::uint32_t, std::uint32_t> places_;  // of models among the shapes
    std::span<const MoverRow> rows_;                 // that are not known yet
    std::span<const TraceFrame> frames_;             // likewise
    std::vector<freespace::MoverPose> poses_;        // of one frame
    std::int64_t start_;
    double look_ahead_;
    std::optional<double> asked_;  // the time of the last call
};

[[nodiscard]] CameraSample sampled(const camera::Camera& camera, bool cut);

// CPU time of this thread alone: unlike wall time, the same on a busy machine.
[[nodiscard]] double cpu_nanoseconds();

}  // namespace camdir::evaluation
