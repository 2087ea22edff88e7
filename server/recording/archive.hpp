// The folder that holds recordings, one folder each.
#pragma once

#include <compare>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"

namespace camdir::recording {

// The folder of a recording: its id, "-", and the match's id, percent-encoded: it leads nowhere else,
// whatever a game server calls its match.
[[nodiscard]] std::string folder_name(const std::string& recording_id, const std::string& match_id);

// Unlike any other: the time in UTC, ns since 1970, and a random number: "20261124T231500.123Z-8b1f09c2".
// Those of later times sort later.
[[nodiscard]] std::string new_recording_id(std::int64_t time);

// One process at a time has it. What takes long, measuring what is there and removing, a thread of its own
// does. Its calls are for one thread at a time.
class Archive {
  public:
    // Creates the folder. Fails when another process has it. Recordings that it holds already have ended;
    // what else is there is left alone.
    [[nodiscard]] static Result<std::unique_ptr<Archive>> open(const std::filesystem::path& folder);
    // Whether open() could use the folder, apart from other processes: it can be written, or made. Leaves
    // nothing behind.
    [[nodiscard]] static Result<void> check(const std::filesystem::path& folder);
    Archive(const Archive&) = delete;
    Archive& operator=(const Archive&) = delete;
    // What is still to be removed, the next open() removes.
    ~Archive();

    // False: the folder was removed, and one that may have come in its place is not locked.
    [[nodiscard]] bool is_in_place() const;

    // A recording in the folder, with so many bytes of the disk, grows no more.
    void add_ended(const std::string& name, std::uint64_t bytes);
    // Of the disk: of those that have ended, as far as they are measured.
    [[nodiscard]] std::uint64_t ended_bytes() const;
    // Removes the recording that ended first, of those that are measured, and returns its name, or the names
    // of those that somebody else has removed; none: there is none. From now on nobody reads it; its files
    // follow. One that cannot be removed is logged and left.
    std::vector<std::string> remove_oldest();

  private:
    // A recording; the one that ended first sorts first.
    struct Ended {
        std::filesystem::file_time_type time;
        std::string name;
        std::uint64_t bytes = 0;

        auto operator<=>(const Ended&) const = default;
    };

    Archive(std::filesystem::path folder, int descriptor)
        : folder_(std::move(folder)), descriptor_(descriptor) {}
    [[nodiscard]] std::filesystem::path path_of(const std::string& name) const { return folder_ / name; }
    [[nodiscard]] Result<void> list();
    // On the thread.
    void run(const std::stop_token& stop);
    [[nodiscard]] std::optional<std::filesystem::path> next_removed(const std::stop_token& stop);
    // With the mutex held.
    [[nodiscard]] std::vector<std::string> forget_gone();
    void remove(const std::string& name);

    const std::filesystem::path folder_;
    const int descriptor_;                 // of the folder, locked
    std::vector<std::string> unmeasured_;  // names, the oldest first; the thread's

    mutable std::mutex mutex_;  // guards the next four
    std::condition_variable_any wake_;
    std::set<Ended> ended_;
    std::uint64_t ended_bytes_ = 0;
    std::deque<std::filesystem::path> removed_;  // whose files are still there

    std::jthread thread_;
};

}  // namespace camdir::recording
