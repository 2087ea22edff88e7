// Counts, since the start, of the samples that came from DDS and went to it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "dds/decode.hpp"
#include "dds/qos.hpp"
#include "director/counters.hpp"

namespace camdir::dds {

using WireCounter = std::atomic<std::uint64_t>;

// Written by the gateway's threads, read by anyone at any time.
struct WireCounters {
    struct PerTopic {
        WireCounter accepted{0};                                           // valid
        std::array<WireCounter, validation_error_names.size()> dropped{};  // by ValidationError
    };
    std::array<PerTopic, topic_count> received{};
    // Of accepted pose frames, from their source_time where they have one: as true as the clocks of both
    // hosts agree.
    director::DurationCounter reception;

    WireCounter shown_matches_written{0};  // and disposed; not those written again
    WireCounter camera_frames_written{0};
    WireCounter statuses_written{0};                // buckets of them
    WireCounter write_failures{0};                  // because DDS refused a sample or timed out
    WireCounter endpoint_failures{0};               // matches whose endpoints could not be created
    WireCounter liveliness_withheld{0};             // assertions omitted: the director did not respond
    std::atomic<std::uint32_t> matches{0};          // with endpoints now
    std::atomic<std::uint32_t> matches_led{0};      // of these by this director
    std::atomic<std::uint32_t> matches_leaving{0};  // of these, those of other shards

    [[nodiscard]] PerTopic& of(Topic topic) { return received[static_cast<std::size_t>(topic)]; }
    [[nodiscard]] const PerTopic& of(Topic topic) const { return received[static_cast<std::size_t>(topic)]; }
};

}  // namespace camdir::dds
