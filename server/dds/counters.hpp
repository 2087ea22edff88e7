// What crossed the border between the wire and the director, counted since the start.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

#include "dds/decode.hpp"
#include "dds/qos.hpp"

namespace camdir::dds {

using Counter = std::atomic<std::uint64_t>;

// Written by the gateway's threads, read by anyone at any time.
struct Counters {
    struct PerTopic {
        Counter accepted{0};                                 // handed to the director
        std::array<Counter, defect_names.size()> dropped{};  // by Defect
    };
    std::array<PerTopic, topic_count> received{};

    Counter camera_frames_written{0};
    Counter statuses_written{0};
    Counter statuses_withdrawn{0};
    Counter write_failures{0};              // DDS refused or timed out: the sample is lost
    Counter endpoint_failures{0};           // a match whose endpoints could not be created
    Counter liveliness_withheld{0};         // ticks at which the director hung and was left to fail over
    std::atomic<std::uint32_t> matches{0};  // present now

    [[nodiscard]] PerTopic& of(Topic topic) { return received[static_cast<std::size_t>(topic)]; }
    [[nodiscard]] const PerTopic& of(Topic topic) const { return received[static_cast<std::size_t>(topic)]; }
};

}  // namespace camdir::dds
