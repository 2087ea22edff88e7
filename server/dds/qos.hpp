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

// What the configuration says of a director among others.
struct Leadership {
    std::uint32_t rank = 0;                // at most 65535: the greatest leads where nobody does
    std::chrono::milliseconds lease{200};  // silence after which the director counts as dead
};

// Samples of one match or observer that a reader keeps until they are taken: several participants may write,
// and one must not replace what another has written while the reception is busy or held up.
inline constexpr std::int32_t kept_until_taken = 16;

// For a reader. It accepts writers with any lease.
[[nodiscard]] Qos reader_qos(Topic topic);
// For a writer of ShownMatch, CameraFrame or ObserverStatus, without its strength.
[[nodiscard]] Qos writer_qos(Topic topic, std::chrono::milliseconds lease);
// For a writer of DirectorSign.
[[nodiscard]] Qos sign_qos();
// For a publisher or subscriber in these partitions.
[[nodiscard]] Qos partition_qos(std::span<const std::string> partitions);

}  // namespace camdir::dds
