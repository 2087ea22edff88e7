// The ten topics' names, types and QoS as camera_director.idl documents them, for the server and the client
// library.
#pragma once

#include <dds/dds.h>

#include <cstddef>
#include <memory>
#include <string>

namespace camdir::wire {

enum class Topic : std::size_t {
    match_info,
    pose_frame,
    match_event,
    camera_frame,
    observer_request,
    observer_status,
    shown_match,
    director_sign,
    mover_info,
    mover_frame,
};
inline constexpr std::size_t topic_count = 10;

[[nodiscard]] const char* topic_name(Topic topic);
[[nodiscard]] const dds_topic_descriptor_t& topic_type(Topic topic);

struct QosDeleter {
    void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

// The topic's QoS for readers and writers, without what only the director's writers set: strength, lease and
// lifespan. A reliable writer with a full queue waits for up to `max_blocking_time`. Throws std::bad_alloc.
[[nodiscard]] Qos topic_qos(Topic topic, dds_duration_t max_blocking_time);

// The partition of a match: match/<match_id>.
[[nodiscard]] std::string match_partition(const std::string& match_id);

}  // namespace camdir::wire
