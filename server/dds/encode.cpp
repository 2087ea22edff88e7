#include "dds/encode.hpp"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <span>

#include "base/utf8.hpp"

namespace camdir::dds {
namespace {

// Bounded strings of the wire types are zero-terminated arrays.
void copy_string(std::span<char> to, const std::string& from) {
    const std::size_t length = utf8_prefix(from, to.size() - 1);
    std::memcpy(to.data(), from.data(), length);
    std::memset(to.data() + length, 0, to.size() - length);
}

// Lets `sequence` use `storage`, which DDS then neither grows nor frees.
template <class Sequence, class Storage>
void borrow(Sequence& sequence, Storage& storage) {
    // The buffer of bounded strings is one of C arrays, for which the storage has std::array.
    static_assert(sizeof *sequence._buffer == sizeof storage[0]);
    sequence._buffer = reinterpret_cast<decltype(sequence._buffer)>(storage.data());
    sequence._maximum = static_cast<std::uint32_t>(storage.size());
    sequence._release = false;
}

}  // namespace

CameraFrameEncoder::CameraFrameEncoder(const std::string& match_id, std::uint64_t director_id) {
    assert(match_id.size() < sizeof sample_.match_id);
    copy_string(sample_.match_id, match_id);
    sample_.director_id = director_id;
    borrow(sample_.camera_id, camera_id_);
    borrow(sample_.target, target_);
    borrow(sample_.position, position_);
    borrow(sample_.orientation, orientation_);
    borrow(sample_.vertical_fov, vertical_fov_);
    borrow(sample_.clearance, clearance_);
    borrow(sample_.flags, flags_);
    borrow(sample_.reasons, reasons_);
}

const camera_director_CameraFrame& CameraFrameEncoder::encode(const director::CameraFrame& frame,
                                                              std::int64_t write_time, std::uint32_t offset) {
    assert(frame.cameras.size() <= director::max_cameras && frame.reasons.size() <= director::max_cameras);
    sample_.epoch = frame.epoch;
    sample_.frame_number = frame.frame_number + offset;
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
    for (std::size_t i = 0; i < frame.reasons.size(); ++i) {
        const auto& [camera_id, reason] = frame.reasons[i];
        reasons_[i].camera_id = camera_id;
        reasons_[i].actor = reason.actor;
        reasons_[i].subject = reason.subject;
        copy_string(reasons_[i].why, reason.why);
    }
    const auto count = static_cast<std::uint32_t>(frame.cameras.size());
    sample_.camera_id._length = sample_.target._length = count;
    sample_.position._length = 3 * count;
    sample_.orientation._length = 4 * count;
    sample_.vertical_fov._length = sample_.clearance._length = sample_.flags._length = count;
    sample_.reasons._length = static_cast<std::uint32_t>(frame.reasons.size());
    return sample_;
}

const camera_director_ShownMatch& ShownMatchEncoder::encode(const director::MatchInfo& info) {
    const std::size_t count = info.players.size();
    map_name_ = info.map_name;
    player_id_.resize(count);
    player_name_.resize(count);
    player_class_.resize(count);
    player_team_.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
        const director::Player& player = info.players[i];
        player_id_[i] = player.id;
        copy_string(player_name_[i], player.name);
        copy_string(player_class_[i], player.player_class);
        player_team_[i] = player.team;
    }
    copy_string(sample_.match_id, info.match_id);
    sample_.epoch = info.epoch;
    sample_.map_name = map_name_.data();
    sample_.map_hash = info.map_hash;
    sample_.metres_per_unit = info.metres_per_unit;
    sample_.rate_hz = info.rate_hz;
    sample_.spectator_delay_s = info.spectator_delay_s;
    borrow(sample_.player_id, player_id_);
    borrow(sample_.player_name, player_name_);
    borrow(sample_.player_class, player_class_);
    borrow(sample_.player_team, player_team_);
    sample_.player_id._length = sample_.player_name._length = sample_.player_class._length =
        sample_.player_team._length = static_cast<std::uint32_t>(count);
    return sample_;
}

StatusBucketEncoder::StatusBucketEncoder(const std::string& match_id) {
    copy_string(sample_.match_id, match_id);
}

const camera_director_ObserverStatusBucket& StatusBucketEncoder::encode(StatusBuckets::Number number,
                                                                        const StatusBuckets::Bucket& bucket) {
    statuses_.clear();
    for (const auto& [observer_id, status] : bucket)
        statuses_.push_back(dds::encode(status));
    sample_.bucket = number;
    borrow(sample_.statuses, statuses_);
    sample_.statuses._length = static_cast<std::uint32_t>(statuses_.size());
    return sample_;
}

camera_director_ObserverStatus encode(const director::ObserverStatus& status) {
    camera_director_ObserverStatus sample{};
    copy_string(sample.observer_id, status.observer_id);
    sample.epoch = status.epoch;
    sample.state = static_cast<std::uint32_t>(status.state);
    sample.camera_id = status.camera_id;
    copy_string(sample.reason, status.reason);
    return sample;
}

camera_director_DirectorSign encode(const std::string& match_id, const Sign& sign) {
    camera_director_DirectorSign sample{};
    copy_string(sample.match_id, match_id);
    sample.director_id = sign.director_id;
    sample.term = sign.term;
    sample.rank = sign.rank;
    sample.lease_ms = static_cast<std::uint32_t>(sign.lease.count());
    sample.leads = sign.leads;
    sample.has_cameras = sign.has_cameras;
    sample.shard = sign.shard;
    return sample;
}

camera_director_ObserverStatusBucket observer_status_key(StatusBuckets::Number number) {
    camera_director_ObserverStatusBucket sample{};
    sample.bucket = number;
    return sample;
}

}  // namespace camdir::dds
