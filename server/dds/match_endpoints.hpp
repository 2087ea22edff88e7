// The readers and writers in one match's partition, and this director's part among those that serve the
// match.
#pragma once

#include <atomic>
#include <chrono>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>

#include "base/log_limit.hpp"
#include "dds/counters.hpp"
#include "dds/encode.hpp"
#include "dds/entity.hpp"
#include "dds/participant.hpp"
#include "dds/status_buckets.hpp"
#include "dds/succession.hpp"

namespace camdir::dds {

// DDS's return code; nothing where nothing has changed, or a standby keeps what it would write, to write it
// when it takes over.
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
    // Of the buckets that have changed since, some are written after each frame, and one by each catch_up().
    // Returns false where there is no room for the status; else it is kept to be written.
    [[nodiscard]] bool write(const director::ObserverStatus& status);
    // The observer has no status any more.
    void withdraw(const std::string& observer_id);

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
    // Writes the next part of what it owes the readers. Of a leader: what is shown, and some of the cameras
    // that it has kept, unless another thread has written a frame and these before it; then one bucket of
    // answers after the other. Of one that stands by: that what it wrote is no longer its own. Returns
    // whether there is more to be written now: what DDS has refused is for later.
    bool catch_up();
    // Whether there is anything. Thread-safe.
    [[nodiscard]] bool owes() const { return owes_; }
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
    // The same. Then the cameras that it owes have been written.
    [[nodiscard]] bool may_write();
    bool put_into_effect();
    void set_strength();
    void take_over();
    [[nodiscard]] bool owes_cameras() const { return owes_shown_ || !kept_.empty(); }
    void begin_to_show();
    void show_kept(std::size_t most);
    void write_owed_statuses(std::size_t most);
    void write_next_status();
    void stand_by();
    [[nodiscard]] bool is_registered() const { return is_shown_registered_ || !written_statuses_.empty(); }
    void unregister_next();
    void unregister_cameras() const;
    void note_what_is_owed();
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
    void owe_status(const std::string& observer_id);
    dds_return_t write_now(const director::CameraFrame& frame);
    void number_on(const director::CameraFrame& first);

    std::string match_id_;
    WireCounters& counters_;
    LogLimit failure_log_;
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
    std::atomic<bool> owes_{false};
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
    // Of a leader: not written yet.
    bool owes_shown_ = false;
    std::set<StatusBuckets::Number> owed_statuses_;
    StatusBuckets::Number last_status_ = 0;  // that was written
    bool status_failed_ = false;             // since the last catch_up()
    // What readers have of this director's writers, of a standby: still.
    bool is_shown_registered_ = false;  // with its cameras
    std::set<StatusBuckets::Number> written_statuses_;
    std::int32_t strength_;
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
