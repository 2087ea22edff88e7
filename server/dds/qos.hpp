// The topics' names, types and QoS: the contract, written once.
#pragma once

#include <dds/dds.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace camdir::dds {

enum class Topic : std::size_t {
    match_info,
    pose_frame,
    match_event,
    camera_frame,
    observer_request,
    observer_status,
};
inline constexpr std::size_t topic_count = 6;

[[nodiscard]] const char* topic_name(Topic topic);
[[nodiscard]] const dds_topic_descriptor_t& topic_type(Topic topic);

struct QosDeleter {
    void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using Qos = std::unique_ptr<dds_qos_t, QosDeleter>;

// What a director may choose about its writers.
struct Leadership {
    std::int32_t strength = 0;             // ownership: the strongest director's cameras are seen
    std::chrono::milliseconds lease{200};  // of CameraFrame: silence after which it counts as dead
};

// Of a reader of the topic. Accepts any lease, so that a writer may choose another than the contract's.
[[nodiscard]] Qos reader_qos(Topic topic);
// Of a writer of the topic.
[[nodiscard]] Qos writer_qos(Topic topic, const Leadership& leadership);
// Of a publisher or subscriber in these partitions.
[[nodiscard]] Qos partition_qos(std::span<const std::string> partitions);

// The partition of a match: match/<match_id>.
[[nodiscard]] std::string match_partition(const std::string& match_id);

}  // namespace camdir::dds
