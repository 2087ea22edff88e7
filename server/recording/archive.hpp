// The folder that holds recordings, one folder each.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "base/error.hpp"

namespace camdir::recording {

// The folder of a recording: its id, "-", and the match's id, percent-encoded: it leads nowhere else,
// whatever a game server calls its match.
[[nodiscard]] std::string folder_name(const std::string& recording_id, const std::string& match_id);

// Unlike any other: the time in UTC, ns since 1970, and a random number: "20261124T231500.123Z-8b1f09c2".
// Those of later times sort later.
[[nodiscard]] std::string new_recording_id(std::int64_t time);

// One process at a time has it. Not thread-safe.
class Archive {
  public:
    // Creates the folder. Fails when another process has it. Recordings that it holds already have ended.
    [[nodiscard]] static Result<Archive> open(const std::filesystem::path& folder);
    // Whether open() could use the folder, apart from other processes: it can be written, or made. Leaves
    // nothing behind.
    [[nodiscard]] static Result<void> check(const std::filesystem::path& folder);
    Archive(Archive&& other) noexcept;
    Archive& operator=(Archive&&) = delete;
    ~Archive();

    [[nodiscard]] std::filesystem::path path_of(const std::string& name) const { return folder_ / name; }

    // A recording in the folder grows no more.
    void add_ended(const std::string& name);
    [[nodiscard]] std::uint64_t ended_bytes() const { return ended_bytes_; }  // of the disk
    // Removes the ended recording that began first; false when there is none. One that cannot be removed
    // is logged and left.
    bool remove_oldest();

  private:
    Archive(std::filesystem::path folder, int descriptor)
        : folder_(std::move(folder)), descriptor_(descriptor) {}

    std::filesystem::path folder_;
    int descriptor_;                              // of the folder, locked; -1: moved from
    std::map<std::string, std::uint64_t> ended_;  // bytes by name
    std::uint64_t ended_bytes_ = 0;
};

}  // namespace camdir::recording
