// The topics of one participant, and the endpoints on them.
#pragma once

#include <array>
#include <string>

#include "entity.hpp"
#include "idl/topics.hpp"

namespace camdir::sdk {

using wire::Topic;

class Topics {
  public:
    Topics() = default;
    explicit Topics(dds_entity_t participant);

    // `group` is a publisher or subscriber of the participant.
    [[nodiscard]] Entity make_writer(dds_entity_t group, Topic topic) const;
    [[nodiscard]] Entity make_reader(dds_entity_t group, Topic topic) const;

  private:
    std::array<Entity, wire::topic_count> topics_;
};

// A publisher or subscriber in the match's partition.
[[nodiscard]] Entity make_publisher(dds_entity_t participant, const std::string& match_id);
[[nodiscard]] Entity make_subscriber(dds_entity_t participant, const std::string& match_id);

}  // namespace camdir::sdk
