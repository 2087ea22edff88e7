// Publishes the match of a stream as a game server does.
#pragma once

#include <bitset>
#include <camera_director/camera_director.hpp>
#include <cstdint>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "stream.hpp"

namespace camdir::qtv {

// On one thread. The match is closed with the object, or with its context.
class Publisher {
  public:
    // `context` must outlive the publisher.
    Publisher(const camera_director::Context& context, std::string match_id)
        : context_(context), match_id_(std::move(match_id)) {}

    // What follows is of another stream: its first match begins a new epoch.
    void begin_stream() { level_ = 0; }
    // Opens the match; begins a new epoch where the level is another one, else updates the description.
    [[nodiscard]] Result<void> announce(const Match& match);
    // Precondition: the match is announced.
    [[nodiscard]] Result<void> publish(const quakeworld::TrackedFrame& frame);

    [[nodiscard]] std::uint32_t directors() const;
    // Events that were not sent, since a director was too far behind.
    [[nodiscard]] std::uint64_t lost_events() const { return lost_events_; }

  private:
    [[nodiscard]] Result<void> publish_poses(const quakeworld::TrackedFrame& frame);
    void publish_spawns(const quakeworld::TrackedFrame& frame);
    void publish_event(const camera_director::MatchEvent& event);

    const camera_director::Context& context_;
    std::string match_id_;
    std::optional<camera_director::Match> match_;
    std::uint32_t level_ = 0;  // of the stream; 0: none yet
    std::uint32_t round_ = 0;
    std::bitset<quakeworld::max_slots> alive_;  // in the frame before
    std::uint64_t lost_events_ = 0;
};

}  // namespace camdir::qtv
