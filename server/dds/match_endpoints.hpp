// What the director reads and writes in one match's partition.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

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
    // Reads other directors' statuses, so that their end is noticed.
    [[nodiscard]] dds_entity_t rival_reader() const { return rival_reader_; }

    // Written by one thread at a time, which may be another than the readers'. They return DDS's error.
    [[nodiscard]] dds_return_t write(const director::CameraFrame& frame);
    [[nodiscard]] dds_return_t write(const director::ObserverStatus& status);
    // The observer's status ends for everybody.
    [[nodiscard]] dds_return_t withdraw(const std::string& observer_id);

    // Another director of the match has gone since the call before. One thread at a time.
    [[nodiscard]] bool lost_rival();
    // Writes the newest status of every observer again: readers have dropped what a standby wrote while its
    // leader lived. Thread-safe.
    void repeat_statuses();

    // "I am alive" when no camera was written since the call before. Thread-safe.
    void assert_liveliness();
    // Gives the match up: observers hear the next director, if there is one. Thread-safe.
    void resign();

  private:
    MatchEndpoints(std::string match_id, std::uint64_t director_id)
        : match_id_(std::move(match_id)), encoder_(match_id_, director_id) {}
    [[nodiscard]] Result<void> open_readers(const Participant& participant);
    [[nodiscard]] Result<void> open_writers(const Participant& participant, const Leadership& leadership);

    std::string match_id_;
    CameraFrameEncoder encoder_;
    std::atomic<bool> wrote_{false};  // a camera frame, since the last assertion of liveliness
    Entity subscriber_;               // owns the readers
    Entity publisher_;                // owns the writers
    dds_entity_t pose_reader_ = 0;
    dds_entity_t event_reader_ = 0;
    dds_entity_t request_reader_ = 0;
    dds_entity_t rival_reader_ = 0;
    dds_entity_t camera_writer_ = 0;
    dds_entity_t status_writer_ = 0;
    std::mutex statuses_mutex_;
    std::unordered_map<std::string, camera_director_ObserverStatus> statuses_;  // newest, by observer
};

}  // namespace camdir::dds
