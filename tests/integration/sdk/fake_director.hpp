// A director on the DDS API itself: reads what the SDK writes and writes what the SDK should receive.
#pragma once

#include <camera_director.h>
#include <dds/dds.h>

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "support/camera_frames.hpp"
#include "support/eventually.hpp"

namespace camdir::test {

struct ReceivedPoses {
    std::string match_id;
    std::uint64_t epoch;
    std::uint32_t frame_number;
    std::int64_t frame_time;
    std::int64_t source_time;
    std::vector<std::uint32_t> player_id;
    std::vector<float> eye;
    std::vector<float> orientation;
    std::vector<float> velocity;
    std::vector<std::uint32_t> flags;
    std::vector<std::uint32_t> discontinuities;
};

struct ReceivedInfo {
    std::uint64_t epoch;
    std::string map_name;
    std::uint64_t map_hash;
    float metres_per_unit;
    float rate_hz;
    float spectator_delay_s;
    std::vector<std::uint32_t> player_id;
    std::vector<std::string> player_name;
    std::vector<std::string> player_class;
    std::vector<std::uint8_t> player_team;
};

struct ReceivedMovers {
    std::uint64_t epoch;
    std::vector<std::uint32_t> mover_id;
    std::vector<std::string> model, kind;
    std::vector<std::uint32_t> hulls, half_spaces, balls;
    std::vector<float> planes, spheres;
};

struct ReceivedMoverFrame {
    std::uint64_t epoch;
    std::int64_t frame_time;
    std::int64_t source_time;
    std::vector<std::uint32_t> mover_id;
    std::vector<float> position, orientation;
};

struct ReceivedRequest {
    std::string observer_id;
    std::uint32_t target;
    std::vector<std::uint32_t> group;
    std::string profile;
    std::string overrides;
    std::uint8_t team;
};

class FakeDirector {
  public:
    // In a domain that a context of this process has open. Must be destroyed before the context.
    FakeDirector(std::uint32_t domain, const std::string& match_id, std::int32_t strength = 0);
    ~FakeDirector();
    FakeDirector(const FakeDirector&) = delete;
    FakeDirector& operator=(const FakeDirector&) = delete;

    [[nodiscard]] std::optional<ReceivedPoses> take_poses();
    [[nodiscard]] std::optional<ReceivedInfo> take_info();
    [[nodiscard]] std::optional<camera_director_MatchEvent> take_event();
    [[nodiscard]] std::optional<ReceivedMovers> take_movers();
    [[nodiscard]] std::optional<ReceivedMoverFrame> take_mover_frame();
    [[nodiscard]] std::optional<ReceivedRequest> take_request();
    // True when the instance has no live writer.
    [[nodiscard]] bool info_has_ended() { return has_ended(info_reader_); }
    [[nodiscard]] bool request_has_ended() { return has_ended(request_reader_); }

    // Passes the game server's next description on to the observers. Returns false when there is none.
    [[nodiscard]] bool show_match();
    void end_shown_match();
    void write(CameraFrameArrays& frame);
    void write_status(const std::string& observer_id, std::uint64_t epoch, std::uint32_t state,
                      std::uint32_t camera_id, const std::string& reason = {});
    void withdraw_status(const std::string& observer_id);
    // Observers whose camera readers are matched.
    [[nodiscard]] std::uint32_t observer_count() const;

    // Calls look() with the QoS that the matched writer of the topic offers.
    void with_offered_qos(const char* topic, const std::function<void(const dds_qos_t*)>& look) const;

  private:
    [[nodiscard]] dds_entity_t topic(const dds_topic_descriptor_t& type, const char* name);
    [[nodiscard]] bool has_ended(dds_entity_t reader);
    void write_statuses();

    std::string match_id_;
    std::map<std::string, camera_director_ObserverStatus> statuses_;  // of all observers, in one bucket
    dds_entity_t participant_;
    dds_entity_t info_reader_;
    dds_entity_t pose_reader_;
    dds_entity_t event_reader_;
    dds_entity_t request_reader_;
    dds_entity_t mover_info_reader_;
    dds_entity_t mover_frame_reader_;
    dds_entity_t camera_writer_;
    dds_entity_t status_writer_;
    dds_entity_t shown_writer_;
};

}  // namespace camdir::test
