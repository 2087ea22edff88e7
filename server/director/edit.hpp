// The automatic shots of a match: whom they follow or from where they look, and why, as the direction's
// editor decides.
#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "config/config.hpp"
#include "direction/cutter.hpp"
#include "direction/material.hpp"
#include "director/continuity.hpp"
#include "director/delay_buffer.hpp"
#include "director/match_obstacles.hpp"
#include "director/messages.hpp"
#include "director/roster.hpp"
#include "director/scout.hpp"
#include "freespace/space.hpp"

namespace camdir::director {

// As what an event is directed by; none: by nothing. `detail`: the event's.
[[nodiscard]] std::optional<direction::EventKind> directed_kind(MatchEventKind kind, std::string_view detail);

// An automatic shot's programme so far.
struct AutomaticShot {
    std::uint32_t player = no_player;       // who is followed
    std::uint32_t fixed = freespace::none;  // the fixed shot of the map that is shown instead
    std::int64_t since = 0;                 // frame_time
    Reason reason;
    direction::Cutter cutter;
    std::uint64_t edit = 0;  // that `cutter` belongs to

    [[nodiscard]] bool is_on_air() const { return player != no_player || fixed != freespace::none; }
    // Goes on with what another director shows.
    void follow(std::uint32_t target, std::uint32_t fixed_shot, std::int64_t frame_time, const Reason* why);
};

// Material, moments and decisions of one match (see direction/README.md). Beats are those of the game's
// clock, so that directors of the same match decide at the same frames. What the delay lets be known is used,
// at most 10 s of it: frames and events that have surely arrived when a frame is shown, so that the same
// match gives the same cuts. Sight lines are looked along after the frame's cameras are published, a share of
// a beat with every frame. One thread at a time.
class Edit {
  public:
    // How far ahead of what is shown a match is known, at most.
    [[nodiscard]] static double foresight_s(double delay_s);

    // Begins anew: another epoch or map, or no automatic shot any more.
    void clear();

    // As they are shown; ignored where they were foreseen.
    void set_players(std::span<const Player> players);
    // The rules have changed: what was found by the old ones is of no use.
    void forget_moments() { moments_.clear(); }
    // As it is shown; ignored where it was foreseen.
    void record(const MatchEvent& event);

    struct Setting {
        freespace::Space space;  // at the time of the frame that is shown
        const direction::Rules& rules;
        std::size_t max_players;
        double delay_s;
        double rate_hz;
    };
    // What is known when this frame is shown. Every frame, before choose(). All calls until clear() need the
    // setting's map.
    void show(const PoseFrame& frame, const DelayBuffer& delay, const Setting& setting);

    // Whom an automatic shot may show.
    struct Among {
        std::span<const std::uint32_t> group;  // ascending; empty: all players
        std::uint8_t team = 0;                 // 0: any

        [[nodiscard]] bool all() const { return group.empty() && team == 0; }
    };
    // Who is followed, or which fixed shot is shown, from the frame on that is shown. Candidates are the
    // players of `among` who have a pose; where that is everybody, also the fixed shots that no mover comes
    // near or hides the player of, as soon as it is known what they show. Returns whether a shot begins.
    bool choose(AutomaticShot& shot, const Among& among, const Roster& roster, const Setting& setting) const;
    // Reasons are to be told again, for those who have come since they were: once a second.
    [[nodiscard]] bool repeats_reasons() const { return due_ && decided_ % reasons_every == 0; }

    // Whom the fixed shot is of as it is decided about; no_player for nobody, or before that is known.
    [[nodiscard]] std::uint32_t subject_of(std::uint32_t fixed) const;

    // Looks along sight lines for later frames; once a frame.
    void look(const Setting& setting);

    [[nodiscard]] const direction::Material& material() const { return material_; }
    [[nodiscard]] direction::Beat decided() const { return decided_; }

  private:
    static constexpr direction::Beat reasons_every = 10;

    struct PendingBeat {
        PendingBeat(direction::Beat beat, double seconds, std::shared_ptr<const MatchMovers> obstacles,
                    std::size_t fixed)
            : number(beat), time(seconds), movers(std::move(obstacles)), scout(fixed) {}

        direction::Beat number;
        double time;                                // of its first frame
        std::shared_ptr<const MatchMovers> movers;  // likewise
        bool ended = false;                         // a later frame is known
        Scout scout;
    };

    void begin(const PoseFrame& frame, const Setting& setting);
    bool take(const PoseFrame& frame, const Setting& setting);
    void begin_beat(direction::Beat number, const PoseFrame& frame, std::span<const PlayerPose> poses);
    [[nodiscard]] direction::PlayerState state_of(const PlayerPose& pose, direction::Index place) const;
    [[nodiscard]] float speed_over_beat(const Vec3f& eye, direction::Index place) const;
    void look_at_next(PendingBeat& beat, const Setting& setting);
    void append_finished();
    void finish(const Setting& setting);
    void add(const MatchEvent& event);
    void add(const MatchInfo& info);
    void take_teams(std::span<const Player> players);
    // What is on the air may go on: it is still there, and nothing comes near it.
    [[nodiscard]] bool may_stay(std::size_t rush, const Among& among, const Roster& roster,
                                const Setting& setting) const;
    [[nodiscard]] std::vector<std::size_t> choice_of(std::size_t on_air, const Among& among,
                                                     const Roster& roster, const Setting& setting) const;
    [[nodiscard]] bool is_to_be_had(std::size_t rush, const Among& among, const Roster& roster) const;
    [[nodiscard]] bool has_fixed(const Among& among) const;
    [[nodiscard]] bool may_begin(std::size_t fixed, const Roster& roster, const Setting& setting) const;
    [[nodiscard]] static bool is_threatened(const freespace::Space& space, std::size_t fixed);
    // Where nobody else is to be had, those who are dead stay.
    void keep_living(std::vector<std::size_t>& choice, const Roster& roster) const;
    // Of what is on the air; rushes() for nothing that there is.
    [[nodiscard]] std::size_t rush_of(const AutomaticShot& shot) const;
    [[nodiscard]] direction::Index place_of(std::uint32_t player) const;
    [[nodiscard]] double seconds(std::int64_t frame_time) const;
    [[nodiscard]] Reason reason_of(const direction::Reason& reason, const direction::Rules& rules) const;

    direction::Material material_{0, {}};
    std::uint64_t generation_ = 1;  // of the material
    bool begun_ = false;
    std::int64_t start_ = 0;  // frame_time of beat 0
    double newest_ = 0.0;     // of the frames taken, seconds
    double shown_ = 0.0;
    direction::Beat end_ = 0;  // beats before this may be known
    direction::Beat shown_beat_ = 0;
    std::int64_t frame_time_ = 0;             // that is shown
    direction::Beat decided_ = -1;            // the last beat that may have a cut
    bool due_ = false;                        // decided_ is new with this frame
    std::vector<direction::Moment> moments_;  // at decided_
    std::uint64_t position_ = 0;              // in the delay buffer, of what is not taken yet
    bool foresees_ = false;                   // frames and events come from there
    std::deque<PendingBeat> beats_;           // that are not appended yet
    MatchObstacles obstacles_;                // of the beats that are looked at
    Continuity continuity_;
    std::map<std::uint32_t, direction::Index> places_;  // of players in the material
    std::vector<std::uint32_t> players_;                // by place
    std::size_t fixed_ = 0;                             // rushes before those that follow the players
    bool is_full_ = false;                              // there is no place for another
    std::map<std::uint32_t, std::uint8_t> teams_;
};

}  // namespace camdir::director
