// The stream of a QTV server as it arrives: the answer to the request, then a multi-view demo without end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "handshake.hpp"
#include "quakeworld/blocks.hpp"
#include "quakeworld/frames.hpp"
#include "quakeworld/tracker.hpp"

namespace camdir::qtv {

struct Player {
    quakeworld::Slot slot = 0;
    std::uint8_t team = 0;  // from 1; 0: everyone's enemy
    std::string name = {};  // ASCII, 1 .. 63 bytes

    friend bool operator==(const Player&, const Player&) = default;
};

// The match as it is now.
struct Match {
    std::uint32_t level = 0;  // counts map changes and restarts, from 1
    std::string map;
    std::vector<Player> players;  // without spectators, ascending by slot
    float rate_hz = 0.0F;         // frames per second of the game's time

    friend bool operator==(const Match&, const Match&) = default;
};

// An answer, the match where something of it has changed, or a frame of the match as it was said last.
using Update = std::variant<Answer, Match, quakeworld::TrackedFrame>;

// Reads the stream: whatever the pieces that it arrives in, the updates are the same. Memory: a few MiB at
// most, provided that next() is called until it has nothing before more is appended.
class Stream {
  public:
    // The server's next bytes, which may end anywhere.
    void append(std::span<const std::byte> bytes);

    // Nothing until more has arrived. Errors name the byte of the answer, or of what follows it; not to be
    // called again after one, nor after an answer that is no begin.
    [[nodiscard]] Result<std::optional<Update>> next();

    // Where and why messages could not be read, the first time; empty: all were.
    [[nodiscard]] const std::string& first_unread() const { return frames_.first_unread(); }

  private:
    // Frames per second, of the last seconds.
    class Rate {
      public:
        void count(std::int64_t time);
        [[nodiscard]] float hz() const { return hz_; }

      private:
        float hz_ = 30.0F;  // mvdsv's default
        std::optional<std::int64_t> since_;
        std::int64_t last_ = 0;
        std::uint32_t frames_ = 0;
    };

    [[nodiscard]] Result<void> begin();
    [[nodiscard]] Result<void> take(const quakeworld::Block& block);
    void take_frames();
    void begin_level();
    void describe();
    [[nodiscard]] std::vector<Player> players();
    [[nodiscard]] std::uint8_t team_of(const std::string& name);

    Bytes answer_;  // until it is complete
    bool begun_ = false;
    quakeworld::BlockReader blocks_;
    quakeworld::FrameReader frames_;
    quakeworld::Tracker tracker_;
    Rate rate_;
    std::map<std::string, std::uint8_t> teams_;  // of the level
    std::uint32_t level_ = 0;                    // of the frames that the tracker has
    Match match_;                                // as it was said last
    std::deque<Update> updates_;
};

}  // namespace camdir::qtv
