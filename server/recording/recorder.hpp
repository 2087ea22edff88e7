// Records every match that a director shows.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <unordered_map>
#include <vector>

#include "director/ports.hpp"
#include "recording/archive.hpp"
#include "recording/broadcast.hpp"
#include "recording/writer.hpp"

namespace camdir::recording {

struct RecorderOptions {
    std::filesystem::path folder;
    std::uint64_t max_bytes = 0;        // of the disk, for all recordings; at most two fragments a match more
    std::uint64_t max_match_bytes = 0;  // for each
    std::int64_t fragment_duration = 3'000'000'000;  // ns
    std::int64_t folder_retry = 10'000'000'000;      // ns: a folder that cannot be used is tried again
    std::string director_version;
};

struct RecorderStatistics {
    std::uint64_t running = 0;    // recordings
    std::uint64_t bytes = 0;      // of the disk, for all recordings
    std::uint64_t fragments = 0;  // completed since the start
    std::uint64_t dropped = 0;    // messages and ends for which the disk was too slow
    std::uint64_t failures = 0;   // matches whose recording could not begin or go on
};

// A match is recorded from its first MatchInfo to its end, across epochs, in a folder of its own. The
// audience's calls copy what they are shown; one thread encodes and writes. What waits for it is bounded for
// each match, where frames, events and requests are dropped first, then descriptions and withdrawals, and for
// all matches, also in bytes, where ends are dropped last: a recording whose end was dropped goes on with the
// next match of its id, or ends with the recorder. All that is dropped is counted.
//
// An error of the disk ends the recording of its match: it is logged and counted, and the match's next epoch
// begins a new one. When all recordings take more than max_bytes, the oldest that have ended are removed,
// then the oldest fragments of the others. statistics() and wait_until_written() are thread-safe.
class Recorder final : public director::Audience {
  public:
    // Does not fail: a folder that cannot be used fails each match's recording until it can.
    explicit Recorder(RecorderOptions options);
    Recorder(const Recorder&) = delete;
    Recorder& operator=(const Recorder&) = delete;
    ~Recorder() override;  // ends all recordings; nothing may be shown any more

    void show(const director::MatchInfo& shown) override;
    void show(const std::string& match_id, const director::PoseFrame& poses,
              const director::CameraFrame& cameras) override;
    void show(const std::string& match_id, const director::MatchEvent& event) override;
    void request(const director::ObserverRequest& request) override;
    void request_ended(const std::string& match_id, const std::string& observer_id) override;
    void end(const std::string& match_id) override;

    [[nodiscard]] RecorderStatistics statistics() const;
    // What there is of the matches that are recorded.
    [[nodiscard]] const Broadcast& broadcast() const { return broadcast_; }
    // Until everything shown before has been encoded, and written as far as its fragments are complete.
    void wait_until_written();

  private:
    struct Shown {
        std::int64_t time;  // ns of the steady clock
        std::string match_id;
        std::vector<Message> messages;
        bool ends = false;  // the match, after the messages
    };
    struct Recording {
        std::string id;
        std::string name;  // of its folder
        Writer writer;
        // Of its records' times, ns since 1970, from the steady clock: they never descend, whatever happens
        // to the system's clock, which may not be set yet when the process begins.
        std::int64_t clock_offset = 0;
        // What viewers were told of.
        std::uint32_t first = 0;
        std::uint32_t end = 0;  // one after the last
        Channel::Clock::time_point complete_at{};
    };
    struct Match {
        std::map<std::string, director::ObserverRequest> requests;  // by observer; they may precede it
        director::MatchInfo info;                                   // the last one
        std::optional<Recording> recording;
        director::MatchMovers movers;  // the last ones of the recording
        bool failed = false;           // in this epoch
        bool needs_archive = false;    // and therefore failed
    };

    struct Waiting {  // of a match
        std::size_t count = 0;
        bool ends = false;  // the last is its end
    };

    // Dropped where `max` of the match wait.
    void put(const std::string& match_id, std::vector<Message> messages, std::size_t max);
    // With mutex_ held.
    void push(Shown shown);

    // On the thread.
    void run(const std::stop_token& stop);
    [[nodiscard]] std::vector<Shown> take(const std::stop_token& stop);
    void write(Shown shown);
    void write(const std::string& match_id, Match& match, Record record);
    // Of these poses, which follow, where they are others than before.
    [[nodiscard]] static Result<void> append_movers(Match& match, const director::PoseFrame& poses,
                                                    std::int64_t time);
    [[nodiscard]] Result<void> open_archive();
    // Also appends the requests that preceded the match.
    [[nodiscard]] Result<void> begin(const std::string& match_id, Match& match, std::int64_t time);
    void finish(const std::string& match_id, Match& match);
    void end_recording(const std::string& match_id, Match& match);
    void tell_viewers(const std::string& match_id, Match& match);
    void fail(const std::string& match_id, Match& match, const Error& error);
    // What to do when the disk is nearly full.
    [[nodiscard]] std::string advice() const;
    void end_due_fragments();
    void keep_within_bound();
    // False when there is none that may be removed.
    bool remove_oldest_recording();
    bool remove_oldest_fragment();
    [[nodiscard]] std::uint64_t disk_bytes() const;
    void update_statistics();

    const RecorderOptions options_;

    mutable std::mutex mutex_;  // guards the next six
    std::condition_variable_any written_;
    std::vector<Shown> waiting_;
    std::unordered_map<std::string, Waiting> waiting_of_;  // by match
    std::size_t waiting_bytes_ = 0;
    bool is_writing_ = false;
    RecorderStatistics statistics_;

    Broadcast broadcast_;

    // Used by the thread only.
    std::unique_ptr<Archive> archive_;  // null: it cannot be opened
    std::int64_t archive_due_ = 0;      // ns of the steady clock: when it is tried again
    std::map<std::string, Match> matches_;
    std::uint64_t ended_fragments_ = 0;
    std::uint64_t failures_ = 0;

    std::jthread thread_;
};

}  // namespace camdir::recording
