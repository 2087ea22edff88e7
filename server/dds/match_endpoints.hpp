// The readers and writers in one match's partition.
#pragma once

#include <atomic>
#include <chrono>
#include <memory>
#include <mutex>
#include <string>

#include "dds/encode.hpp"
#include "dds/entity.hpp"
#include "dds/participant.hpp"

namespace camdir::dds {

class MatchEndpoints {
  public:
    // `match_id` is valid (decode.hpp). The participant must outlive the endpoints.
    [[nodiscard]] static Result<std::unique_ptr<MatchEndpoints>> open(const Participant& participant,
                                                                      const std::string& match_id,
                                                                      const Leadership& leadership,
                                                                      std::uint64_t director_id);

    [[nodiscard]] const std::string& match_id() const { return match_id_; }
    [[nodiscard]] dds_entity_t pose_reader() const { return pose_reader_; }
    [[nodiscard]] dds_entity_t event_reader() const { return event_reader_; }
    [[nodiscard]] dds_entity_t request_reader() const { return request_reader_; }

    // One writing thread at a time, which may differ from the reading one. They return DDS's return code.
    [[nodiscard]] dds_return_t write(const director::MatchInfo& shown);
    // Disposes it.
    [[nodiscard]] dds_return_t end_shown();
    [[nodiscard]] dds_return_t write(const director::CameraFrame& frame);
    // Until the first request is accepted, answers are written below those of all directors that have
    // accepted one.
    [[nodiscard]] dds_return_t write(const director::ObserverStatus& status);
    // Disposes the observer's status.
    [[nodiscard]] dds_return_t withdraw(const std::string& observer_id);

    // Asserts the writers' liveliness, the camera writer's unless a frame was written since the last call.
    // Writes again which match is shown. One thread at a time.
    void assert_liveliness();
    // Releases the ownership of the match: observers receive the next director, if there is one. Thread-safe.
    void release_ownership();

  private:
    MatchEndpoints(std::string match_id, std::uint64_t director_id)
        : match_id_(std::move(match_id)), encoder_(match_id_, director_id) {}
    [[nodiscard]] Result<void> open_readers(const Participant& participant);
    [[nodiscard]] Result<void> open_writers(const Participant& participant, const Leadership& leadership);

    std::string match_id_;
    CameraFrameEncoder encoder_;
    std::mutex shown_mutex_;
    ShownMatchEncoder shown_encoder_;
    bool is_shown_ = false;
    std::atomic<bool> wrote_frame_{false};  // since the last assert_liveliness()
    Entity subscriber_;                     // owns the readers
    Entity publisher_;                      // owns the writers
    dds_entity_t pose_reader_ = 0;
    dds_entity_t event_reader_ = 0;
    dds_entity_t request_reader_ = 0;
    dds_entity_t camera_writer_ = 0;
    bool has_cameras_ = false;
    dds_entity_t status_writer_ = 0;
    dds_entity_t early_status_writer_ = 0;  // while there are no cameras
    dds_entity_t shown_writer_ = 0;
    std::chrono::steady_clock::time_point next_slow_assertion_{};
};

}  // namespace camdir::dds
