#include "camera_track.hpp"

namespace camdir::sdk {

namespace {

View view_of(std::int64_t time, std::uint32_t segment, const cdir_camera& camera) {
    return {segment, time, 0, camera};
}

// Frame times differ by no more than 2^62 ns.
double seconds_between(std::int64_t from, std::int64_t to) {
    return 1e-9 * static_cast<double>(to - from);
}

}  // namespace

const CameraTrack::Frame& CameraTrack::frame(std::size_t age_rank) const {
    return frames_[(begin_ + age_rank) % capacity];
}

CameraTrack::Frame& CameraTrack::frame(std::size_t age_rank) {
    return frames_[(begin_ + age_rank) % capacity];
}

void CameraTrack::add(std::int64_t frame_time, const cdir_camera& camera, bool connected) {
    if (size_ > 0 && frame_time <= frame(size_ - 1).time) {
        interrupted_ = true;  // the motion to the next frame passes the skipped one
        return;
    }
    if (!connected || interrupted_) ++segment_;
    interrupted_ = false;
    frames_[(begin_ + size_) % capacity] = {frame_time, segment_, camera, {}};
    if (size_ < capacity) {
        ++size_;
    } else {
        begin_ = (begin_ + 1) % capacity;
    }
}

void CameraTrack::clear() {
    size_ = 0;
    interrupted_ = true;
}

std::optional<View> CameraTrack::newest() const {
    if (size_ == 0) return std::nullopt;
    const Frame& newest = frame(size_ - 1);
    return view_of(newest.time, newest.segment, newest.camera);
}

std::size_t CameraTrack::first_after(std::int64_t frame_time) const {
    std::size_t rank = size_;
    while (rank > 0 && frame(rank - 1).time > frame_time) {
        --rank;
    }
    return rank;
}

bool CameraTrack::connected(std::size_t age_rank) const {
    return age_rank > 0 && age_rank < size_ && frame(age_rank - 1).segment == frame(age_rank).segment;
}

CameraStep CameraTrack::step_to(std::size_t age_rank) const {
    const Frame& before = frame(age_rank - 1);
    const Frame& after = frame(age_rank);
    return step_between(before.camera, after.camera, seconds_between(before.time, after.time));
}

CameraVelocity CameraTrack::velocity_at(std::size_t age_rank) const {
    if (!connected(age_rank)) return step_to(age_rank + 1).velocity;
    if (connected(age_rank + 1)) return velocity_between(step_to(age_rank), step_to(age_rank + 1));
    if (connected(age_rank - 1)) return velocity_after(step_to(age_rank - 1), step_to(age_rank));
    return step_to(age_rank).velocity;
}

CameraState CameraTrack::settled(std::size_t age_rank) {
    Frame& known = frame(age_rank);
    if (!known.velocity) known.velocity = velocity_at(age_rank);
    return {known.camera, *known.velocity};
}

std::optional<View> CameraTrack::at(std::int64_t frame_time) {
    if (size_ == 0) return std::nullopt;
    const std::size_t rank = first_after(frame_time);
    const Frame& before = frame(rank == 0 ? 0 : rank - 1);
    if (rank == 0) return view_of(before.time, before.segment, before.camera);
    if (rank == size_) {
        View view = view_of(before.time, before.segment, before.camera);
        view.late = frame_time - before.time;
        return view;
    }
    if (!connected(rank) || frame_time == before.time) {
        return view_of(frame_time, before.segment, before.camera);
    }
    const double seconds = seconds_between(before.time, frame(rank).time);
    const double share = seconds_between(before.time, frame_time) / seconds;
    return view_of(frame_time, before.segment,
                   camera_between(settled(rank - 1), settled(rank), seconds, share));
}

}  // namespace camdir::sdk
