// A match, on the game server's side.
#pragma once

#include <camera_director/camera_director.h>

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>

#include "context.hpp"
#include "memory.hpp"
#include "mover_places.hpp"
#include "pose_arrays.hpp"

namespace camdir::sdk {

// Thread-safe: calls are serialised. All may throw a Failure.
class GameMatch {
  public:
    GameMatch(std::shared_ptr<const Context> context, const cdir_match_info& info,
              std::span<const cdir_player> players);
    GameMatch(const GameMatch&) = delete;
    GameMatch& operator=(const GameMatch&) = delete;
    ~GameMatch();  // ends the match

    [[nodiscard]] const Context& context() const { return *context_; }

    void update(const cdir_match_info& info, std::span<const cdir_player> players);
    void restart(const cdir_match_info& info, std::span<const cdir_player> players);
    [[nodiscard]] std::uint64_t epoch() const;
    void publish(const cdir_pose_frame& frame);
    void publish(const cdir_match_event& event);
    void set_movers(std::span<const cdir_mover> movers);
    void publish(const cdir_mover_frame& frame);
    [[nodiscard]] std::uint32_t director_count() const;

  private:
    // With a writer that is made when it is first used.
    void write(Entity& writer, Topic topic, const void* sample);
    void announce(cdir_match_info& info, std::span<const cdir_player> players);
    // The player's, up to and with a pose with these flags.
    [[nodiscard]] std::uint32_t count_discontinuities(std::uint32_t player, std::uint32_t flags);

    std::shared_ptr<const Context> context_;
    mutable std::mutex mutex_;
    std::string match_id_;
    cdir_match_info info_;  // as last announced, with its epoch
    PoseArrays poses_;      // of the last frame
    std::uint32_t next_frame_number_ = 0;
    std::optional<std::int64_t> last_frame_time_;  // in this epoch
    MoverPlaces movers_;                           // in this epoch
    std::optional<std::int64_t> last_mover_time_;  // likewise
    // By player, in this epoch.
    std::unordered_map<std::uint32_t, std::uint32_t, std::hash<std::uint32_t>, std::equal_to<>,
                       Allocator<std::pair<const std::uint32_t, std::uint32_t>>>
        discontinuities_;
    Entity publisher_;
    Entity info_writer_;
    Entity pose_writer_;
    Entity event_writer_;
    // Made when they are first used: an identity may be older than movers, and most matches have none.
    Entity mover_info_writer_;
    Entity mover_frame_writer_;
};

}  // namespace camdir::sdk
