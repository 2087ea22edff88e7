#include "camera_track.hpp"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

namespace camdir::sdk {

namespace {

cdir_view view_of(std::int64_t time, std::uint32_t segment, const cdir_camera& camera) {
    cdir_view view = cdir_view_default();
    view.segment = segment;
    view.frame_time = time;
    view.camera = camera;
    return view;
}

// Clearance decreases at most by the distance travelled from either end. In double, because a float's square
// can overflow.
float clearance_between(const cdir_camera& a, const cdir_camera& b, float share) {
    using Vector = Eigen::Map<const Eigen::Vector3f>;
    const double distance = (Vector(b.position).cast<double>() - Vector(a.position).cast<double>()).norm();
    const double clearance = std::max(a.clearance - share * distance, b.clearance - (1.0 - share) * distance);
    return static_cast<float>(std::max<double>(clearance, std::numeric_limits<float>::lowest()));
}

// `share` of the way from a to b, 0 .. 1.
cdir_camera interpolated(const cdir_camera& a, const cdir_camera& b, float share) {
    using Vector = Eigen::Map<const Eigen::Vector3f>;
    using Quaternion = Eigen::Map<const Eigen::Quaternionf>;
    cdir_camera camera = a;
    Eigen::Map<Eigen::Vector3f>(camera.position) =
        (1.0F - share) * Vector(a.position) + share * Vector(b.position);
    Eigen::Map<Eigen::Quaternionf>(camera.orientation) =
        Quaternion(a.orientation).slerp(share, Quaternion(b.orientation)).normalized();
    camera.vertical_fov = a.vertical_fov + share * (b.vertical_fov - a.vertical_fov);
    camera.clearance = clearance_between(a, b, share);
    return camera;
}

}  // namespace

const CameraTrack::Frame& CameraTrack::frame(std::size_t age_rank) const {
    return frames_[(begin_ + age_rank) % capacity];
}

void CameraTrack::add(std::int64_t frame_time, const cdir_camera& camera, bool connected) {
    if (size_ > 0 && frame_time <= frame(size_ - 1).time) {
        interrupted_ = true;  // the motion to the next frame passes the skipped one
        return;
    }
    if (!connected || interrupted_) ++segment_;
    interrupted_ = false;
    frames_[(begin_ + size_) % capacity] = {frame_time, segment_, camera};
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

std::optional<cdir_view> CameraTrack::newest() const {
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

std::optional<cdir_view> CameraTrack::at(std::int64_t frame_time) const {
    if (size_ == 0) return std::nullopt;
    const std::size_t rank = first_after(frame_time);
    const Frame& before = frame(rank == 0 ? 0 : rank - 1);
    if (rank == 0) return view_of(before.time, before.segment, before.camera);
    if (rank == size_) {
        cdir_view view = view_of(before.time, before.segment, before.camera);
        view.late = frame_time - before.time;
        return view;
    }
    const Frame& after = frame(rank);
    if (after.segment != before.segment || frame_time == before.time) {
        return view_of(frame_time, before.segment, before.camera);
    }
    const double share =
        static_cast<double>(frame_time - before.time) / static_cast<double>(after.time - before.time);
    return view_of(frame_time, before.segment,
                   interpolated(before.camera, after.camera, static_cast<float>(share)));
}

}  // namespace camdir::sdk
