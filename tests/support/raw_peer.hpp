// A game server or observer on the DDS API itself: it can write samples that the SDK refuses to write.
#pragma once

#include <camera_director.h>
#include <dds/dds.h>

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace camdir::test {

// One participant with endpoints in one match's partition. Its QoS are written independently of the server's
// and the SDK's, to check both. Throws when DDS refuses.
class RawPeer {
  public:
    // Uses the process's domain if it has joined it, otherwise joins it on loopback. By default it is in
    // match/<match_id> alone.
    RawPeer(std::uint32_t domain, const std::string& match_id, std::vector<std::string> partitions = {});
    ~RawPeer();
    RawPeer(const RawPeer&) = delete;
    RawPeer& operator=(const RawPeer&) = delete;

    void write(const camera_director_MatchInfo& sample);
    void write(const camera_director_PoseFrame& sample);
    void write(const camera_director_MatchEvent& sample);
    void write(const camera_director_MoverInfo& sample);
    void write(const camera_director_MoverFrame& sample);
    void write(const camera_director_ObserverRequest& sample);
    void write(const camera_director_DirectorSign& sample);
    // As a director of the third term.
    void write(const camera_director_CameraFrame& sample);
    void dispose(const camera_director_MatchInfo& key);
    void dispose(const camera_director_ObserverRequest& key);

    struct Camera {
        std::uint32_t id, target, flags;
        float position[3], orientation[4];
        float vertical_fov, clearance;
    };
    struct CameraFrame {
        std::string match_id;
        std::uint64_t epoch, director_id;
        std::uint32_t frame_number, pose_number;
        std::int64_t frame_time, source_time, write_time;
        std::vector<Camera> cameras;
    };
    // Frames since the last call, in order.
    [[nodiscard]] std::vector<CameraFrame> take_cameras();

    // The newest status of every observer that has one.
    [[nodiscard]] const std::map<std::string, camera_director_ObserverStatus>& statuses();

    // Takes the descriptions since the last call; their epochs, and nothing for the end of a shown match.
    [[nodiscard]] std::vector<std::optional<std::uint64_t>> take_shown_epochs();

    // Directors whose camera writers are matched.
    [[nodiscard]] std::uint32_t directors();
    // Of its partitions, in how many there is one.
    [[nodiscard]] std::size_t served_matches();
    // The ownership strength of the strongest of them.
    [[nodiscard]] std::int32_t camera_strength();
    // A director has received all signs that this peer has written.
    [[nodiscard]] bool signs_are_known();

  private:
    dds_entity_t add_writer(const dds_topic_descriptor_t& type, const char* topic, dds_qos_t* qos);
    dds_entity_t add_reader(const dds_topic_descriptor_t& type, const char* topic, dds_qos_t* qos);

    dds_entity_t participant_ = 0;
    std::vector<std::string> partitions_;
    dds_entity_t match_info_ = 0, pose_frame_ = 0, match_event_ = 0, observer_request_ = 0;
    dds_entity_t mover_info_ = 0, mover_frame_ = 0;
    dds_entity_t sign_ = 0, shown_camera_ = 0;
    dds_entity_t camera_frame_ = 0, observer_status_ = 0, shown_match_ = 0;
    std::map<std::string, camera_director_ObserverStatus> statuses_;
    std::map<std::string, std::uint8_t> buckets_;  // of those observers
};

// Valid samples without players or group.
[[nodiscard]] camera_director_MatchInfo raw_match_info(const std::string& match_id, std::uint64_t epoch);
[[nodiscard]] camera_director_ObserverRequest raw_request(const std::string& match_id,
                                                          const std::string& observer_id,
                                                          std::uint32_t target);

// A valid pose frame of `count` living players at the origin, with its arrays.
class RawPoseFrame {
  public:
    RawPoseFrame(const std::string& match_id, std::uint64_t epoch, std::uint32_t frame_number,
                 std::uint32_t count);

    // The vectors may be changed; sample() points to them until the next change. At first there are no
    // discontinuities: the sender does not count them.
    std::vector<std::uint32_t> player_id, flags, discontinuities;
    std::vector<float> eye, orientation, velocity;
    [[nodiscard]] const camera_director_PoseFrame& sample();

  private:
    camera_director_PoseFrame sample_{};
};

// A valid description of movers, without any at first.
class RawMoverInfo {
  public:
    RawMoverInfo(const std::string& match_id, std::uint64_t epoch);

    // The next mover; what is added after it is its.
    void add_mover(std::uint32_t id, const std::string& model = {});
    // Six half spaces.
    void add_box(const float (&minimum)[3], const float (&maximum)[3]);
    void add_ball(const float (&centre)[3], float radius);

    // As RawPoseFrame's.
    std::vector<std::uint32_t> mover_id, hulls, half_spaces, balls;
    std::vector<std::array<char, 64>> model;
    std::vector<float> planes, spheres;
    [[nodiscard]] const camera_director_MoverInfo& sample();

  private:
    camera_director_MoverInfo sample_{};
};

// A valid frame without movers at first.
class RawMoverFrame {
  public:
    RawMoverFrame(const std::string& match_id, std::uint64_t epoch, std::int64_t frame_time);

    // Unrotated.
    void add(std::uint32_t id, const float (&at)[3]);

    // As RawPoseFrame's.
    std::vector<std::uint32_t> mover_id;
    std::vector<float> position, orientation;
    [[nodiscard]] const camera_director_MoverFrame& sample();

  private:
    camera_director_MoverFrame sample_{};
};

}  // namespace camdir::test
