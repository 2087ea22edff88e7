// The readers and writers in one match's partition, and this director's part among those that serve the
// match.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "dds/counters.hpp"
#include "dds/encode.hpp"
#include "dds/entity.hpp"
#include "dds/participant.hpp"
#include "dds/status_buckets.hpp"
#include "dds/succession.hpp"

namespace camdir::dds {

// DDS's return code; nothing where a standby keeps what it would write, to write it when it takes over.
using Written = std::optional<dds_return_t>;

class MatchEndpoints {
  public:
    // `match_id` is valid (decode.hpp). The participant and the counters must outlive the endpoints.
    [[nodiscard]] static Result<std::unique_ptr<MatchEndpoints>> open(const Participant& participant,
                                                                      const std::string& match_id,
                                                                      const Leadership& leadership,
                                                                      std::uint64_t director_id,
                                                                      WireCounters& counters);

    [[nodiscard]] const std::string& match_id() const { return match_id_; }
    [[nodiscard]] dds_entity_t pose_reader() const { return pose_reader_; }
    [[nodiscard]] dds_entity_t event_reader() const { return event_reader_; }
    [[nodiscard]] dds_entity_t request_reader() const { return request_reader_; }
    // 0 where this director's identity may not read them: the match is served without movers.
    [[nodiscard]] dds_entity_t mover_info_reader() const { return mover_info_reader_; }
    [[nodiscard]] dds_entity_t mover_frame_reader() const { return mover_frame_reader_; }
    // Of other directors.
    [[nodiscard]] dds_entity_t camera_reader() const { return camera_reader_; }
    [[nodiscard]] dds_entity_t sign_reader() const { return sign_reader_; }

    // One writing thread at a time, which may differ from the reading one.
    [[nodiscard]] Written write(const director::MatchInfo& shown);
    // Disposes it.
    [[nodiscard]] Written end_shown();
    [[nodiscard]] Written write(const director::CameraFrame& frame);
    [[nodiscard]] Written write(const director::ObserverStatus& status);
    // The observer has no status any more.
    [[nodiscard]] Written withdraw(const std::string& observer_id);

    // The game server has sent a pose frame. Returns whether decide() is due. One thread at a time, as for
    // all that follows up to decide().
    [[nodiscard]] bool hear();
    // What other directors do.
    void see(const Sign& sign);
    void leave(std::uint64_t director_id);
    // Returns whether this director stands by: what comes later of a former leader counts for nothing.
    [[nodiscard]] bool see(const director::CameraFrame& shown);
    // This director lives and responds: asserts the writers' liveliness, the camera writer's unless a frame
    // was written since the last call. Writes again which match is shown.
    void assert_liveliness();
    // Takes over or stands by as time demands. To be called when all signs that have come are seen, and again
    // by the time that it returns.
    Succession::Time decide();
    // Leaves the match to the next director at once, if there is one, until assert_liveliness() is called.
    void resign();
    // The following are thread-safe. As resign(), to a director that can serve the match as well; false where
    // there is none.
    [[nodiscard]] bool hand_over();
    [[nodiscard]] bool is_leading();
    // A director of the match's shard leads it, another one.
    [[nodiscard]] bool is_following();
    // See Succession.
    void set_shards(std::uint64_t own, std::uint64_t home);
    // Releases the ownership of the match: observers receive the next director, if there is one.
    void release_ownership();

  private:
    using Clock = Succession::Clock;

    MatchEndpoints(std::string match_id, const Leadership& leadership, std::uint64_t director_id,
                   WireCounters& counters);
    [[nodiscard]] Result<void> open_readers(const Participant& participant);
    [[nodiscard]] Result<void> open_reader(const Participant& participant, Topic topic, dds_entity_t& reader);
    [[nodiscard]] Result<void> open_writers(const Participant& participant, const Leadership& leadership);

    // Calls change(succession, now) and puts into effect what follows from it.
    template <class Change>
    void change(Change change);
    void write_sign();
    // The following with writing_ held. Whether this director still leads.
    [[nodiscard]] bool leads();
    bool put_into_effect();
    void set_strength(const Sign& part);
    void take_over();
    void stand_by();
    void unregister_cameras() const;
    void count(dds_return_t written, WireCounter& counter);
    void forget_shown();
    dds_return_t dispose_shown();
    struct PoseId {
        std::uint64_t epoch;
        std::uint32_t pose_number;
    };
    void keep(const director::CameraFrame& frame);
    void drop_kept();
    [[nodiscard]] bool misses_frames() const;
    [[nodiscard]] bool is_shown(const PoseId& frame) const;
    dds_return_t write_now(StatusBuckets::Number number);
    dds_return_t write_now(const director::CameraFrame& frame);
    void number_on(const director::CameraFrame& first);

    std::string match_id_;
    WireCounters& counters_;
    const Clock::duration lease_;
    Entity subscriber_;  // owns the readers
    Entity publisher_;   // owns the writers
    dds_entity_t pose_reader_ = 0;
    dds_entity_t event_reader_ = 0;
    dds_entity_t request_reader_ = 0;
    dds_entity_t mover_info_reader_ = 0;
    dds_entity_t mover_frame_reader_ = 0;
    dds_entity_t camera_reader_ = 0;
    dds_entity_t sign_reader_ = 0;
    dds_entity_t camera_writer_ = 0;
    dds_entity_t status_writer_ = 0;
    dds_entity_t shown_writer_ = 0;
    dds_entity_t sign_writer_ = 0;
    std::atomic<bool> wrote_frame_{false};  // since the last assert_liveliness()
    Clock::time_point next_slow_assertion_{};

    // Held for no longer than a decision or a sign. Guards the next two; in_effect_ is written with both
    // locks.
    std::mutex deciding_;
    Succession succession_;
    Sign in_effect_;

    std::mutex writing_;  // guards the rest; locked before deciding_
    CameraFrameEncoder encoder_;
    ShownMatchEncoder shown_encoder_;
    StatusBucketEncoder status_encoder_;
    // What is published now, whoever writes it.
    std::optional<director::MatchInfo> shown_;
    bool ended_unwritten_ = false;  // a match before it, perhaps unknown to the leader
    StatusBuckets statuses_;
    // Of a standby: the newest frames after the leader's last one.
    struct Kept {
        director::CameraFrame frame;
        Clock::time_point computed;
    };
    std::deque<Kept> kept_;
    std::optional<PoseId> dropped_;  // the newest that was dropped from there
    struct Shown {
        std::uint64_t epoch = 0;
        std::uint32_t frame_number = 0, pose_number = 0;
        Clock::time_point seen;
    };
    std::optional<Shown> last_shown_;  // by another director
    // What it writes is numbered on from there, within the epoch.
    std::uint64_t numbered_epoch_ = 0;
    std::uint32_t number_offset_ = 0;
};

}  // namespace camdir::dds
