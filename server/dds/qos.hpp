// The QoS of the director's readers and writers: the contract of idl/topics.hpp and what a director adds to
// it.
#pragma once

#include <chrono>
#include <cstdint>
#include <span>
#include <string>

#include "idl/topics.hpp"

namespace camdir::dds {

using wire::match_partition;
using wire::Qos;
using wire::Topic;
using wire::topic_count;
using wire::topic_name;
using wire::topic_type;

// What a director may choose about its writers.
struct Leadership {
    std::int32_t strength = 0;             // ownership: observers receive the strongest director
    std::chrono::milliseconds lease{200};  // of CameraFrame: silence after which the director counts as dead
};

// For a reader. It accepts writers with any lease.
[[nodiscard]] Qos reader_qos(Topic topic);
// For a writer of ShownMatch, CameraFrame or ObserverStatus.
[[nodiscard]] Qos writer_qos(Topic topic, const Leadership& leadership);
// For a publisher or subscriber in these partitions.
[[nodiscard]] Qos partition_qos(std::span<const std::string> partitions);

}  // namespace camdir::dds
