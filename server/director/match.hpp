// One match: what its strand does with what came in.
#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "director/attention.hpp"
#include "director/inbox.hpp"
#include "director/map_library.hpp"
#include "director/ports.hpp"
#include "director/requests.hpp"
#include "director/roster.hpp"
#include "director/worker_pool.hpp"

namespace camdir::director {

// The public members are for any thread.
class Match final : public Strand {
  public:
    Match(std::string match_id, std::shared_ptr<const config::Config> config, const MapLibrary& maps,
          Wire& wire);

    [[nodiscard]] Inbox& inbox() { return inbox_; }
    [[nodiscard]] Counters& counters() { return counters_; }
    [[nodiscard]] const Counters& counters() const { return counters_; }

    // Adds this match's part to the numbers of matches, observers and shots, as of the last turn.
    void add_gauges(Statistics& sum) const;

    // No pose for so long that the match is silent, and it does not know yet.
    [[nodiscard]] bool poses_missing(std::int64_t now_ns) const;
    // The game server's liveliness is lost, and no pose came for so long.
    [[nodiscard]] bool server_gone_for(std::int64_t ns, std::int64_t now_ns) const;
    // Neither game server nor observers, as of the last turn.
    [[nodiscard]] bool deserted() const { return deserted_.load(std::memory_order_acquire); }

  private:
    // Poses come; they stopped; the game server's liveliness is lost; there is no game server.
    enum class Liveness { running, silent, lost, none };

    void turn() noexcept override;  // NOLINT(bugprone-exception-escape)

    void handle(MatchInfo& info);
    void handle(const ServerLost& lost);
    void handle(const PosesMissing& missing);
    void handle(const MatchEnded& ended);
    void handle(const MatchRefused& refused);
    void handle(const MatchEvent& event);
    void handle(const ObserverRequest& request);
    void handle(const RequestGone& gone);
    void handle(const MapsChanged& changed);
    void handle(const Reconfigured& changed);
    void handle(const ViewWanted& wanted);

    void begin_epoch();
    void fall_silent(Liveness liveness);
    void adopt_map();
    void check_map_hash(const MapEntry& entry);
    void leave_map(std::string reason);
    void judge();
    [[nodiscard]] std::string state() const;

    void answer(const PoseFrame& frame, std::int64_t received_ns);
    [[nodiscard]] bool accept(const PoseFrame& frame);
    void take_in(const PoseFrame& frame);
    void move_cameras(const PoseFrame& frame, double dt);
    [[nodiscard]] ShotCamera move_camera(Shot& shot, const PoseFrame& frame, double dt);

    const std::string match_id_;
    const MapLibrary& maps_;
    Wire& wire_;
    Counters counters_;
    Inbox inbox_;

    // Written by the strand, read by all.
    std::atomic<Liveness> liveness_{Liveness::none};
    std::atomic<bool> deserted_{false};
    std::atomic<std::int64_t> silence_ns_{0};  // without poses, that makes the match silent
    std::atomic<std::uint64_t> observer_count_{0};
    std::atomic<std::uint64_t> shot_count_{0};
    std::atomic<std::int64_t> last_pose_ns_{0};  // of those that were accepted

    // Of the strand alone.
    std::shared_ptr<const config::Config> config_;
    Inbox::Content content_;
    std::optional<MatchInfo> info_;
    std::string refusal_;                                    // Situation::refusal
    std::string no_map_;                                     // Situation::no_map
    std::pair<std::uint64_t, std::uint64_t> told_mismatch_;  // hashes: the game server's, the baked map's
    std::uint64_t map_generation_ = 0;
    std::optional<freespace::Freespace> freespace_;
    std::unique_ptr<camera::Scratch> scratch_;
    Roster roster_;
    Attention attention_;
    Requests requests_;
    bool judge_needed_ = false;

    std::uint64_t last_epoch_ = 0;  // also of a match that is over
    bool any_frame_ = false;        // the frame before is of the same epoch, and no silence was between
    bool gap_ = false;              // there was a silence: players may be anywhere by now
    std::uint32_t last_number_ = 0;
    std::int64_t last_time_ = 0;
    std::uint32_t next_camera_frame_ = 0;
    CameraFrame cameras_;
};

}  // namespace camdir::director
