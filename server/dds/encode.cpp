#include "dds/encode.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>

#include "base/utf8.hpp"

namespace camdir::dds {
namespace {

// Bounded strings of the wire types are zero-terminated arrays.
template <std::size_t Size>
void copy_string(char (&to)[Size], const std::string& from) {
    const std::size_t length = utf8_prefix(from, Size - 1);
    std::memcpy(to, from.data(), length);
    std::memset(to + length, 0, Size - length);
}

// Lets `sequence` use `storage`, which DDS then neither grows nor frees.
template <class Sequence, class Value, std::size_t Size>
void borrow(Sequence& sequence, std::array<Value, Size>& storage) {
    sequence._buffer = storage.data();
    sequence._maximum = Size;
    sequence._release = false;
}

}  // namespace

CameraFrameEncoder::CameraFrameEncoder(const std::string& match_id, std::uint64_t director_id) {
    assert(match_id.size() < sizeof sample_.match_id);
    sample_ = camera_frame_key(match_id);
    sample_.director_id = director_id;
    borrow(sample_.camera_id, camera_id_);
    borrow(sample_.target, target_);
    borrow(sample_.position, position_);
    borrow(sample_.orientation, orientation_);
    borrow(sample_.vertical_fov, vertical_fov_);
    borrow(sample_.clearance, clearance_);
    borrow(sample_.flags, flags_);
}

const camera_director_CameraFrame& CameraFrameEncoder::encode(const director::CameraFrame& frame,
                                                              std::int64_t write_time) {
    assert(frame.cameras.size() <= director::max_cameras);
    sample_.epoch = frame.epoch;
    sample_.frame_number = frame.frame_number;
    sample_.pose_number = frame.pose_number;
    sample_.frame_time = frame.frame_time;
    sample_.source_time = frame.source_time;
    sample_.write_time = write_time;
    for (std::size_t i = 0; i < frame.cameras.size(); ++i) {
        const director::ShotCamera& camera = frame.cameras[i];
        camera_id_[i] = camera.camera_id;
        target_[i] = camera.target;
        Vec3f::Map(&position_[3 * i]) = camera.position;
        Eigen::Vector4f::Map(&orientation_[4 * i]) = camera.orientation.coeffs();
        vertical_fov_[i] = camera.vertical_fov;
        clearance_[i] = camera.clearance;
        flags_[i] = camera.flags;
    }
    const auto count = static_cast<std::uint32_t>(frame.cameras.size());
    sample_.camera_id._length = sample_.target._length = count;
    sample_.position._length = 3 * count;
    sample_.orientation._length = 4 * count;
    sample_.vertical_fov._length = sample_.clearance._length = sample_.flags._length = count;
    return sample_;
}

camera_director_ObserverStatus encode(const director::ObserverStatus& status) {
    camera_director_ObserverStatus sample = observer_status_key(status.match_id, status.observer_id);
    sample.epoch = status.epoch;
    sample.state = static_cast<std::uint32_t>(status.state);
    sample.camera_id = status.camera_id;
    copy_string(sample.reason, status.reason);
    return sample;
}

camera_director_CameraFrame camera_frame_key(const std::string& match_id) {
    camera_director_CameraFrame sample{};
    copy_string(sample.match_id, match_id);
    return sample;
}

camera_director_ObserverStatus observer_status_key(const std::string& match_id,
                                                   const std::string& observer_id) {
    camera_director_ObserverStatus sample{};
    copy_string(sample.match_id, match_id);
    copy_string(sample.observer_id, observer_id);
    return sample;
}

}  // namespace camdir::dds
