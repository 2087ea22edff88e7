// CameraFrame samples, valid as a director writes them or malformed by tests.
#pragma once

#include <camera_director.h>

#include <cstdint>
#include <string>
#include <vector>

namespace camdir::test {

inline constexpr std::int64_t ms = 1'000'000;  // in ns

// Owns the arrays of a sample. By default a valid frame without cameras.
struct CameraFrameArrays {
    std::string match_id;
    std::uint64_t epoch = 1;
    std::uint32_t frame_number = 0;
    std::uint32_t pose_number = 0;
    std::int64_t frame_time = 0;
    std::int64_t source_time = 0;
    std::int64_t write_time = 0;
    std::uint64_t director_id = 1;
    std::vector<std::uint32_t> camera_id = {};
    std::vector<std::uint32_t> target = {};
    std::vector<float> position = {};
    std::vector<float> orientation = {};
    std::vector<float> vertical_fov = {};
    std::vector<float> clearance = {};
    std::vector<std::uint32_t> flags = {};
    std::vector<camera_director_ShotReason> reasons = {};

    // Adds a camera that looks along the x axis.
    void add_camera(std::uint32_t id, float x, std::uint32_t camera_flags = 0) {
        camera_id.push_back(id);
        target.push_back(100 + id);
        position.insert(position.end(), {x, 2.0F, 3.0F});
        orientation.insert(orientation.end(), {0.0F, 0.0F, 0.0F, 1.0F});
        vertical_fov.push_back(1.0F);
        clearance.push_back(8.0F);
        flags.push_back(camera_flags);
    }

    void add_reason(std::uint32_t id, std::uint32_t actor, std::uint32_t subject, const std::string& why) {
        camera_director_ShotReason& reason = reasons.emplace_back();
        reason = {.camera_id = id, .actor = actor, .subject = subject, .why = {}};
        why.copy(reason.why, sizeof reason.why - 1);
    }

    // Points to the arrays: valid until this object changes.
    [[nodiscard]] camera_director_CameraFrame sample() {
        camera_director_CameraFrame sample{};
        match_id.copy(sample.match_id, sizeof sample.match_id - 1);
        sample.epoch = epoch;
        sample.frame_number = frame_number;
        sample.pose_number = pose_number;
        sample.frame_time = frame_time;
        sample.source_time = source_time;
        sample.write_time = write_time;
        sample.director_id = director_id;
        borrow(sample.camera_id, camera_id);
        borrow(sample.target, target);
        borrow(sample.position, position);
        borrow(sample.orientation, orientation);
        borrow(sample.vertical_fov, vertical_fov);
        borrow(sample.clearance, clearance);
        borrow(sample.flags, flags);
        borrow(sample.reasons, reasons);
        return sample;
    }

  private:
    template <class Sequence, class Element>
    static void borrow(Sequence& sequence, std::vector<Element>& elements) {
        sequence._buffer = elements.data();
        sequence._length = sequence._maximum = static_cast<std::uint32_t>(elements.size());
        sequence._release = false;
    }
};

}  // namespace camdir::test
