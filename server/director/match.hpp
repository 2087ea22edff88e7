// One match: processes its messages and pose frames on its strand.
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "director/arrivals.hpp"
#include "director/continuity.hpp"
#include "director/delay_buffer.hpp"
#include "director/edit.hpp"
#include "director/follower.hpp"
#include "director/inbox.hpp"
#include "director/long_turns.hpp"
#include "director/map_binding.hpp"
#include "director/match_obstacles.hpp"
#include "director/ports.hpp"
#include "director/requests.hpp"
#include "director/roster.hpp"
#include "director/timeline.hpp"
#include "director/worker_pool.hpp"
#include "freespace/space.hpp"

namespace camdir::director {

// The time without poses after which a match is silent: matches.silence_frames at its rate, at most a day. At
// limits.pose_rate_hz, where it says that it sends more.
[[nodiscard]] std::int64_t silence_limit_ns(const MatchInfo& info, const config::Config& config);

// Public members may be called from any thread.
class Match final : public Strand {
  public:
    Match(std::string match_id, std::shared_ptr<const config::Config> config, const MapLibrary& maps,
          const Pace& pace, Publisher& publisher, const Audiences& audiences);

    // Judges what the game server sends.
    [[nodiscard]] Arrivals& arrivals() { return arrivals_; }
    [[nodiscard]] Inbox& inbox() { return inbox_; }
    // Of what the game server sends; it leaves to the inbox.
    [[nodiscard]] DelayBuffer& delay() { return delay_; }
    [[nodiscard]] MatchCounters& counters() { return counters_; }
    [[nodiscard]] const MatchCounters& counters() const { return counters_; }

    // Adds this match's share of matches, observers and shots, as of the last turn.
    void add_gauges(Statistics& sum) const;

    // No pose for matches.silence_frames, and the match has not noticed yet.
    [[nodiscard]] bool poses_missing(std::int64_t now_ns) const;
    // The game server's liveliness is lost, and there has been no pose for `ns`.
    [[nodiscard]] bool server_lost_for(std::int64_t ns, std::int64_t now_ns) const;
    // Observers are to be answered again.
    [[nodiscard]] bool answers_due(std::int64_t now_ns) const { return now_ns >= next_answers_ns_; }
    // Neither game server nor observers, as of the last turn, and nothing waits to be shown.
    [[nodiscard]] bool abandoned() const {
        return abandoned_.load(std::memory_order_acquire) && !delay_.waits();
    }

  private:
    // Poses arrive; they have stopped; the game server's liveliness is lost; there is no game server.
    enum class Liveness { running, silent, lost, none };

    void turn(Turn& turn) noexcept override;  // NOLINT(bugprone-exception-escape)

    void handle_all(std::span<Message> messages);
    void handle(MatchInfo& info);
    void handle(const ServerLost& lost);
    void handle(const PosesMissing& missing);
    void handle(const MatchEnded& ended);
    void handle(const MatchRefused& refused);
    void handle(const MatchEvent& event);
    void handle(const ObserverRequest& request);
    void handle(const RequestEnded& ended);
    void handle(const MapsChanged& changed);
    void handle(const DelayChanged& changed);
    void handle(const Reconfigured& changed);
    void handle(const ViewRequest& wanted);

    [[nodiscard]] float camera_rate_hz() const;
    void limit_silence();
    void rest();
    [[nodiscard]] std::uint32_t wanted_frames_per_camera() const;
    [[nodiscard]] float metres_per_unit() const;
    void publish_info();
    void begin_epoch();
    void fall_silent(Liveness liveness);
    void bind_map();
    // Another one, or none.
    void change_map();
    void reconcile();
    [[nodiscard]] std::string state() const;
    [[nodiscard]] std::uint64_t epoch() const;
    [[nodiscard]] std::string waiting_for_delay(const DelayBuffer::State& delay) const;

    void follow_leader();

    void process(PoseFrame& frame, std::int64_t received_ns, Turn& turn);
    void show(const PoseFrame& frame, const CameraFrame& cameras);
    [[nodiscard]] bool accept(const PoseFrame& frame);
    void mark_discontinuities(PoseFrame& frame);
    void record(const PoseFrame& frame);
    bool extend_timeline(std::uint64_t epoch, std::int64_t frame_time);
    void place_obstacles(const PoseFrame& frame);
    // Of the map and the obstacles. There is a map.
    [[nodiscard]] freespace::Space space() const { return {*map_.freespace(), &obstacles_.movers()}; }
    // At the time of the frame that is shown.
    [[nodiscard]] freespace::Space space_shown() const {
        return space().at(by_timeline_ ? timeline_.shown() : causal_time_);
    }
    [[nodiscard]] bool foresee(const PoseFrame& frame);
    // Makes the steps of the next frame, whose poses wait, so that its cameras leave when it is due. False:
    // nothing is to be done now.
    bool prepare(Turn& turn);
    void prepare_step(Shot& shot, double time, camera::Scratch& scratch);
    // Of this frame, or by the timeline at a time and until the timeline changes.
    void gather_crowd(const PoseFrame& frame);
    void gather_crowd(double time);
    void move_cameras(const PoseFrame& frame, double dt, CameraFrame& cameras, Turn& turn);
    // Calls move(i, scratch) for every i below `count`, also on workers that are idle; on more of them where
    // a group shot begins.
    void share_shots(Turn& turn, std::size_t count, bool begins_group_shot,
                     const std::function<void(std::size_t, camera::Scratch&)>& move);
    ShotCamera show_fixed(Shot& shot);
    [[nodiscard]] Edit::Setting edit_setting() const;
    void choose_targets(const PoseFrame& frame, CameraFrame& cameras);
    // Returns whether a shot begins.
    bool choose_automatic_target(Shot& shot, CameraFrame& cameras);
    [[nodiscard]] std::optional<camera::LineOfAction> line_to_keep(const Shot& shot,
                                                                   std::uint32_t next) const;
    // Shots move at the same time: it changes nothing of the match but the shot, the scratch and the
    // counters.
    [[nodiscard]] ShotCamera move_camera(Shot& shot, double dt, camera::Scratch& scratch);
    // `seen`: the player's pose in this frame, null when there is none.
    [[nodiscard]] camera::Camera step_by_pose(Shot& shot, const PlayerPose* seen, double dt,
                                              camera::Scratch& scratch);
    [[nodiscard]] camera::Camera step_by_timeline(Shot& shot, const PlayerPose* seen,
                                                  camera::Scratch& scratch);
    [[nodiscard]] camera::Camera step_group_by_poses(Shot& shot, double dt);
    [[nodiscard]] camera::Camera step_group_to(double time, const Shot& shot, camera::GroupState& state);
    [[nodiscard]] camera::Camera step_to(double time, const Shot& shot, camera::ShotState& state,
                                         camera::Scratch& scratch);

    const std::string match_id_;
    const Pace& pace_;
    Publisher& publisher_;
    const Audiences& audiences_;
    MatchCounters counters_;
    Arrivals arrivals_;
    Inbox inbox_;
    DelayBuffer delay_;

    // Written by the strand, read by any thread.
    std::atomic<Liveness> liveness_{Liveness::none};
    std::atomic<bool> abandoned_{false};
    std::atomic<std::int64_t> silence_limit_ns_{0};  // time without poses after which the match is silent
    std::atomic<std::uint64_t> observer_count_{0};
    std::atomic<std::uint64_t> shot_count_{0};
    std::atomic<std::int64_t> last_pose_ns_{0};                   // receipt of the last accepted frame
    std::atomic<std::int64_t> next_answers_ns_{Requests::never};  // see answers_due()

    // Used by the strand only.
    std::shared_ptr<const config::Config> config_;
    Inbox::Content content_;
    std::optional<MatchInfo> info_;
    std::uint32_t frames_per_camera_ = 1;  // that observers were told of
    LongTurns long_turns_;
    LogLimit long_turns_logged_;
    std::string refusal_;  // RequestContext::refusal
    MapBinding map_;
    std::vector<std::unique_ptr<camera::Scratch>> scratch_;  // by lane; null where no shot has moved yet
    Roster roster_;
    Continuity continuity_;
    Edit edit_;
    LogBudget cuts_logged_{50};
    std::optional<MatchEvent> last_event_;  // of this epoch
    Requests requests_;
    bool reconcile_needed_ = false;
    bool waits_for_delay_ = false;  // what observers are told

    bool has_last_frame_ = false;  // the frame before is of the same epoch, and no silence was between
    bool after_silence_ = false;   // there was a silence: players may be anywhere by now
    std::uint32_t last_number_ = 0;
    std::int64_t last_time_ = 0;
    Timeline timeline_;
    std::shared_ptr<const MatchMovers> shown_movers_;  // of the last frame
    // How long the frames took until now, as trackers count it that do not move over the timeline.
    double causal_time_ = 0.0;
    MatchObstacles obstacles_;    // over the timeline, or that time
    std::uint64_t foreseen_ = 0;  // position in the delay buffer of what follows in the timeline
    bool by_timeline_ = false;    // the cameras move over the timeline
    std::vector<camera::Crowd::Player> crowd_;
    std::vector<camera::TimedPose> crowd_poses_;  // one of each, without a timeline
    std::uint32_t next_camera_frame_ = 0;
    std::vector<Shot*> unprepared_;  // during prepare()
    Follower follower_;
};

}  // namespace camdir::director
