#include "evaluation/replay.hpp"

#include <algorithm>
#include <cassert>
#include <ctime>

namespace camdir::evaluation {
namespace {

constexpr double history = 0.5;     // s of poses before a camera that it is given
constexpr double same_time = 1e-9;  // s
// s. Beyond the horizon of every solver. Movers keeps it of up to 220 frames a second: of more it forgets
// where a mover is now.
constexpr double movers_ahead = 4.0;

camera::Pose tracked(const TracePose& pose) {
    camera::Pose seen;
    seen.eye = pose.eye.cast<float>();
    seen.orientation = pose.orientation.cast<float>().normalized();
    seen.velocity = pose.velocity.cast<float>();
    seen.alive = pose.alive;
    seen.discontinuity = pose.discontinuity;
    return seen;
}

}  // namespace

std::vector<camera::TimedPose> timed_poses(const Trace& trace, std::uint32_t player, std::int64_t start) {
    std::vector<camera::TimedPose> poses;
    poses.reserve(trace.frames.size());
    const auto track = track_of(trace, player);
    for (std::size_t frame = 0; frame < track.size(); ++frame) {
        const bool present = track[frame] != absent;
        poses.push_back({seconds(trace.frames[frame].time - start),
                         present ? tracked(trace.poses[track[frame]]) : camera::Pose{}, present});
    }
    return poses;
}

camera::Window KnownPoses::at(double time) {
    while (end_ < all_.size() && all_[end_].time <= time + look_ahead_ + same_time)
        ++end_;
    while (first_ + 1 < end_ && all_[first_ + 1].time <= time - history)
        ++first_;
    return all_.subspan(first_, end_ - first_);
}

KnownCrowd::KnownCrowd(const Trace& trace, std::span<const std::vector<camera::TimedPose>> tracks,
                       double look_ahead) {
    assert(tracks.size() == trace.players.size());
    for (std::size_t i = 0; i < tracks.size(); ++i) {
        known_.emplace_back(tracks[i], look_ahead);
        players_.push_back({trace.players[i], {}});
    }
}

camera::Crowd KnownCrowd::at(double time, std::uint32_t own) {
    for (std::size_t i = 0; i < known_.size(); ++i)
        players_[i].window = known_[i].at(time);
    return {players_, own};
}

std::vector<std::vector<camera::TimedPose>> timed_poses_of_all(const Trace& trace, std::int64_t start) {
    std::vector<std::vector<camera::TimedPose>> tracks;
    for (const std::uint32_t player : trace.players)
        tracks.push_back(timed_poses(trace, player, start));
    return tracks;
}

KnownMovers::KnownMovers(const freespace::Freespace& freespace, std::span<const MoverRow> rows,
                         const Trace& poses, std::int64_t start, double look_ahead)
    : rows_(rows), frames_(poses.frames), start_(start), look_ahead_(std::min(look_ahead, movers_ahead)) {
    const auto shapes = freespace.movers();
    auto movers = freespace::Movers::of(shapes);
    assert(movers);  // opening the freespace has checked them
    movers_ = std::move(*movers);
    places_ = places_by_model(shapes);
}

const freespace::Movers& KnownMovers::at(double time) {
    if (!asked_) skip_to(time - history);
    for (auto next = next_frame(); next && seconds(*next - start_) <= time + look_ahead_ + same_time;
         next = next_frame()) {
        read_frame(*next);
        movers_.add(seconds(*next - start_), poses_);
    }
    // The step that ends now began at the last call.
    movers_.forget_before(std::min(asked_.value_or(time), time - history));
    asked_ = time;
    return movers_;
}

// Of what was before only the last counts, as if it were of one frame.
void KnownMovers::skip_to(double time) {
    std::map<std::uint32_t, freespace::MoverPose> newest;
    std::int64_t last = start_;
    for (auto next = next_frame(); next && seconds(*next - start_) < time; next = next_frame()) {
        read_frame(last = *next);
        for (const freespace::MoverPose& pose : poses_)
            newest.insert_or_assign(pose.mover, pose);
    }
    poses_.clear();
    for (const auto& [mover, pose] : newest)
        poses_.push_back(pose);
    if (!poses_.empty()) movers_.add(seconds(last - start_), poses_);
}

// Frames without a row count too: in them nothing has moved.
std::optional<std::int64_t> KnownMovers::next_frame() const {
    if (rows_.empty() && frames_.empty()) return std::nullopt;
    if (rows_.empty()) return frames_.front().time;
    if (frames_.empty()) return rows_.front().time;
    return std::min(rows_.front().time, frames_.front().time);
}

// Into poses_.
void KnownMovers::read_frame(std::int64_t time) {
    poses_.clear();
    for (; !rows_.empty() && rows_.front().time == time; rows_ = rows_.subspan(1)) {
        const auto place = places_.find(rows_.front().model);
        if (place == places_.end()) continue;
        const oracle::Placement& placement = rows_.front().placement;
        poses_.push_back({place->second, placement.position.cast<float>(),
                          placement.orientation.cast<float>().normalized()});
    }
    while (!frames_.empty() && frames_.front().time == time)
        frames_ = frames_.subspan(1);
}

CameraSample sampled(const camera::Camera& camera, bool cut) {
    return {camera.position.cast<double>(), camera.orientation.cast<double>().normalized(), cut,
            (camera.flags & camera::target_visible) != 0};
}

double cpu_nanoseconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) * 1e9 + static_cast<double>(now.tv_nsec);
}

}  // namespace camdir::evaluation
