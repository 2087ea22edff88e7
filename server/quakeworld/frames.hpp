// What a multi-view demo says, frame by frame.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/geometry.hpp"
#include "quakeworld/blocks.hpp"
#include "quakeworld/inventory.hpp"
#include "quakeworld/messages.hpp"

namespace camdir::quakeworld {

using Slot = std::uint8_t;  // of a client at the server, below max_slots

struct Pose {
    Slot slot = 0;
    Vec3d origin = Vec3d::Zero();
    Vec3d angles = Vec3d::Zero();  // pitch, yaw, roll; degrees
    bool alive = true;             // and has a body: players who wait for the next round have none
    bool gibbed = false;
};

struct Occurrence {
    enum class Kind { obituary, damage, item, match_begin, match_end };

    std::int64_t time = 0;  // ms since the demo's begin
    Kind kind = Kind::obituary;
    std::optional<Slot> actor = {};    // of an obituary: the killer; who did the damage or took the item
    std::optional<Slot> subject = {};  // the victim
    std::string detail = {};           // Obituary::cause, hit points, the item's name
};

// One instant of the game: all blocks of one time. A server's frame has a few flashes and occurrences; those
// beyond the first 1024 are left out.
struct Frame {
    std::int64_t time = 0;                // ms since the demo's begin
    std::vector<Pose> poses;              // of those who play, ascending by slot
    std::vector<Vec3d> flashes;           // where players teleported from and to
    std::vector<Occurrence> occurrences;  // in the demo's order
};

// A client, as the server describes it now. Texts have at most 255 bytes.
struct Client {
    std::string name;  // plain(); empty: nobody
    std::string team;  // as it is written
    bool spectator = false;
};

// Puts blocks together to frames. A level that begins, as after a map change, discards what was known and
// the frame that was being read. Memory: bounded, however long the demo is.
class FrameReader {
  public:
    // `block` follows the one before. Returns the frame before it when it begins another time and that frame
    // has a pose or an occurrence.
    [[nodiscard]] std::optional<Frame> read(const Block& block);
    // When no block follows: the last frame, likewise.
    [[nodiscard]] std::optional<Frame> finish();

    // As of the last block.
    [[nodiscard]] std::uint32_t levels() const { return levels_; }  // that have begun
    [[nodiscard]] const std::string& map() const { return map_; }   // of the level, "dm3"; empty: unknown
    [[nodiscard]] const std::array<Client, max_slots>& clients() const { return level_.clients; }
    [[nodiscard]] bool teamplay() const { return level_.teamplay; }
    [[nodiscard]] bool match_is_over() const { return level_.match_is_over; }

    [[nodiscard]] std::size_t blocks() const { return blocks_; }
    // Of which some messages, from one on, could not be read; where and why the first time.
    [[nodiscard]] std::size_t unread_blocks() const { return unread_blocks_; }
    [[nodiscard]] const std::string& first_unread() const { return first_unread_; }
    // An error when of the last ones more than one in a hundred could not be read, or the begin of a level:
    // what follows is of another one than what is known.
    [[nodiscard]] Result<void> expect_readable() const;

  private:
    // Which models are a living player's body; those without a name are taken for one.
    class Bodies {
      public:
        void add(const Models& models);
        [[nodiscard]] bool has(std::optional<std::uint8_t> model) const {
            return !model || (*model != 0 && !without_[*model]);
        }

      private:
        std::array<bool, 256> without_{};
    };

    // Puts prints together to lines: old servers print an obituary in pieces.
    class Lines {
      public:
        // Nothing while the line goes on.
        [[nodiscard]] std::optional<std::string> add(std::string_view text);

      private:
        std::string line_;
    };

    // What moves of a client.
    struct Body {
        Pose pose;
        std::optional<std::uint8_t> model;
        bool dead = false;
        bool fresh = false;  // in the frame that is being read
        Inventory inventory;
        Inventory inventory_before;  // at the end of the last frame
    };

    struct Level {
        std::array<Client, max_slots> clients;
        std::array<Body, max_slots> players;
        Bodies bodies;
        Lines obituaries;
        bool teamplay = false;
        bool hands_out_items = false;             // at the begin of every round
        std::optional<std::int64_t> match_begin;  // of the match that goes on
        bool match_is_over = false;
    };

    void read_messages(const Block& block);
    void read_hidden(const Block& block);
    void count_block();
    void note_unread(const Block& block, const MessageReader& messages, const Error& error);

    void take(const Block& /*unused*/, const Other& /*unused*/) {}
    void take(const Block& block, const BeginLevel& begin);
    void take(const Block& block, const PlayerInfo& info);
    void take(const Block& block, const Stat& stat);
    void take(const Block& block, const Print& print);
    void take(const Block& block, const ClientCommand& command);
    void take(const Block& block, const UserInfo& info);
    void take(const Block& block, const UserKey& user);
    void take(const Block& block, const ServerKey& server);
    void take(const Block& block, const Models& models);
    void take(const Block& block, const TeleportFlash& flash);
    void take(const Block& block, const Intermission& intermission);

    void take_obituary(const std::string& line);
    void note(Occurrence::Kind kind, std::optional<Slot> actor = {}, std::optional<Slot> subject = {},
              std::string detail = {});
    void begin_match();
    void end_match();
    void note_taken_items();

    Protocol protocol_;
    Level level_;
    std::string map_;
    std::uint32_t levels_ = 0;
    Frame frame_;  // that is being read
    std::size_t blocks_ = 0;
    std::size_t unread_blocks_ = 0;
    std::string first_unread_;
    struct {
        std::size_t all = 0;
        std::size_t unread = 0;
    } recent_;  // the last blocks
    std::optional<std::string> lost_level_;
};

}  // namespace camdir::quakeworld
