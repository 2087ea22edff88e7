// What a viewer who joins late is told of the minutes before: how each shot went, and what happened.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <vector>

#include "director/messages.hpp"
#include "live/viewer.hpp"

namespace camdir::live {

// From `frame_time` on, a camera has this target and these flags.
struct ShotState {
    std::int64_t frame_time = 0;
    std::uint32_t camera_id = 0;
    std::uint32_t target = director::no_player;
    std::uint32_t flags = 0;  // without `cut`
    bool present = true;      // false: the shot has ended
};

enum class CutReason {
    begin,     // of the shot
    target,    // another player is followed
    moved,     // the player respawned, was teleported, or its poses were missing
    hidden,    // the player was out of sight
    viewpoint  // none of these: the planner found a better one
};

struct Cut {
    std::int64_t frame_time = 0;
    std::uint32_t camera_id = 0;
    std::uint32_t target = director::no_player;
    CutReason reason = CutReason::viewpoint;
    std::optional<director::Reason> moment = {};  // why an automatic shot begins
};

// Of one epoch of a match. One thread at a time.
class History {
  public:
    static constexpr std::size_t max_states = 2048;
    static constexpr std::size_t max_cuts = 1024;
    static constexpr std::size_t max_events = 256;

    // The cuts of the frame's cameras.
    std::vector<Cut> add(const director::PoseFrame& poses, const director::CameraFrame& cameras);
    // The note of a cut, to be kept.
    void keep_cut(SharedMessage note);
    // Of an event likewise, where viewers are told of what happened before: not of wounds and things taken,
    // which are many.
    void keep(const director::MatchEvent& event, SharedMessage note);

    // The newest, by time.
    [[nodiscard]] const std::deque<ShotState>& states() const { return states_; }
    [[nodiscard]] const std::deque<SharedMessage>& cuts() const { return cuts_; }
    [[nodiscard]] const std::deque<SharedMessage>& events() const { return events_; }

  private:
    void add_state(const ShotState& state);

    std::map<std::uint32_t, ShotState> shots_;  // by camera, as of the last frame
    std::deque<ShotState> states_;
    std::deque<SharedMessage> cuts_;
    std::deque<SharedMessage> events_;
};

}  // namespace camdir::live
