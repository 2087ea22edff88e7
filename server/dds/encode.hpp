// From the director's messages to wire samples.
#pragma once

#include <camera_director.h>

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "dds/status_buckets.hpp"
#include "dds/succession.hpp"
#include "director/messages.hpp"

namespace camdir::dds {

// Makes the CameraFrame samples of one match in its own memory. One thread at a time.
class CameraFrameEncoder {
  public:
    // `match_id` has at most 63 bytes.
    CameraFrameEncoder(const std::string& match_id, std::uint64_t director_id);
    CameraFrameEncoder(const CameraFrameEncoder&) = delete;
    CameraFrameEncoder& operator=(const CameraFrameEncoder&) = delete;

    // The sample points into the encoder and is valid until the next call. `write_time` is CLOCK_REALTIME in
    // ns; `offset` is added to the frame's number. Precondition: at most 256 cameras and as many reasons.
    // Does not allocate.
    [[nodiscard]] const camera_director_CameraFrame& encode(const director::CameraFrame& frame,
                                                            std::int64_t write_time,
                                                            std::uint32_t offset = 0);

  private:
    std::array<std::uint32_t, director::max_cameras> camera_id_{};
    std::array<std::uint32_t, director::max_cameras> target_{};
    std::array<float, 3 * director::max_cameras> position_{};
    std::array<float, 4 * director::max_cameras> orientation_{};
    std::array<float, director::max_cameras> vertical_fov_{};
    std::array<float, director::max_cameras> clearance_{};
    std::array<std::uint32_t, director::max_cameras> flags_{};
    std::array<camera_director_ShotReason, director::max_cameras> reasons_{};
    camera_director_CameraFrame sample_{};
};

// Makes the ShownMatch samples of one match in its own memory. One thread at a time.
class ShownMatchEncoder {
  public:
    ShownMatchEncoder() = default;
    ShownMatchEncoder(const ShownMatchEncoder&) = delete;
    ShownMatchEncoder& operator=(const ShownMatchEncoder&) = delete;

    // The sample points into the encoder and is valid until the next call. Strings are cut as below.
    [[nodiscard]] const camera_director_ShownMatch& encode(const director::MatchInfo& info);

  private:
    std::string map_name_;
    std::vector<std::uint32_t> player_id_;
    std::vector<std::array<char, 64>> player_name_;
    std::vector<std::array<char, 32>> player_class_;
    std::vector<std::uint8_t> player_team_;
    camera_director_ShownMatch sample_{};
};

// Makes the ObserverStatus samples of one match in its own memory. One thread at a time.
class StatusBucketEncoder {
  public:
    // `match_id` has at most 63 bytes.
    explicit StatusBucketEncoder(const std::string& match_id);
    StatusBucketEncoder(const StatusBucketEncoder&) = delete;
    StatusBucketEncoder& operator=(const StatusBucketEncoder&) = delete;

    // The sample points into the encoder and is valid until the next call. Strings are cut as below.
    [[nodiscard]] const camera_director_ObserverStatusBucket& encode(StatusBuckets::Number number,
                                                                     const StatusBuckets::Bucket& bucket);

  private:
    std::vector<camera_director_ObserverStatus> statuses_;
    camera_director_ObserverStatusBucket sample_{};
};

// Strings are cut to the bounds of the wire type, at the end of a UTF-8 character.
[[nodiscard]] camera_director_ObserverStatus encode(const director::ObserverStatus& status);
[[nodiscard]] camera_director_DirectorSign encode(const std::string& match_id, const Sign& sign);

// Samples with only the key set, for unregistering and disposing.
[[nodiscard]] camera_director_ObserverStatusBucket observer_status_key(StatusBuckets::Number number);

}  // namespace camdir::dds
