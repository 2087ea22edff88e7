// The topics of one participant, and the endpoints on them.
#pragma once

#include <array>
#include <mutex>
#include <string>

#include "entity.hpp"
#include "idl/topics.hpp"

namespace camdir::sdk {

using wire::Topic;

// Each is created when it is first used: an identity may be allowed only those of its role. Thread-safe.
class Topics {
  public:
    explicit Topics(dds_entity_t participant) : participant_(participant) {}

    // `group` is a publisher or subscriber of the participant.
    [[nodiscard]] Entity make_writer(dds_entity_t group, Topic topic) const;
    [[nodiscard]] Entity make_reader(dds_entity_t group, Topic topic) const;

  private:
    [[nodiscard]] dds_entity_t handle(Topic topic) const;

    dds_entity_t participant_;
    mutable std::mutex mutex_;
    mutable std::array<Entity, wire::topic_count> topics_;
};

// A publisher or subscriber in the match's partition.
[[nodiscard]] Entity make_publisher(dds_entity_t participant, const std::string& match_id);
[[nodiscard]] Entity make_subscriber(dds_entity_t participant, const std::string& match_id);

}  // namespace camdir::sdk
