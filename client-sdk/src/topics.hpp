// The six topics and their quality of service, as documented in idl/camera_director.idl.
#pragma once

#include <array>
#include <string>

#include "entity.hpp"

namespace camdir::sdk {

enum class Topic { match_info, pose_frame, match_event, camera_frame, observer_request, observer_status };
inline constexpr std::size_t topic_count = 6;

// The topics of one participant, and the endpoints on them.
class Topics {
  public:
    Topics() = default;
    explicit Topics(dds_entity_t participant);

    // `group` is a publisher or subscriber of the participant.
    [[nodiscard]] Entity make_writer(dds_entity_t group, Topic topic) const;
    [[nodiscard]] Entity make_reader(dds_entity_t group, Topic topic) const;

  private:
    std::array<Entity, topic_count> topics_;
};

// A publisher or subscriber in the match's partition.
[[nodiscard]] Entity make_publisher(dds_entity_t participant, const std::string& match_id);
[[nodiscard]] Entity make_subscriber(dds_entity_t participant, const std::string& match_id);

}  // namespace camdir::sdk
