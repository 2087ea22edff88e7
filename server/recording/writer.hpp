// Writes a match's recording into a folder.
#pragma once

#include <filesystem>
#include <optional>

#include "recording/fragment.hpp"

namespace camdir::recording {

// Not thread-safe. Whole up to the last complete fragment when the process is killed.
class Writer {
  public:
    // Creates the folder; one that has a `start` is refused. max_bytes bounds the fragments on disk, of
    // which the newest always stays.
    [[nodiscard]] static Result<Writer> create(const std::filesystem::path& folder, const Start& start,
                                               std::uint64_t max_bytes);

    // Blocks for a write and fsync when the record begins the next fragment. A record with a time before the
    // last one's is refused, and is no part of the recording. An error of the disk ends the recording at its
    // last complete fragment: every later call returns the same error.
    [[nodiscard]] Result<void> append(const Record& record);

    // Writes what the last fragment has. Nothing may be appended after it.
    [[nodiscard]] Result<void> finish();

  private:
    struct Written {
        std::uint32_t fragment;
        std::uint64_t bytes;
    };
    struct Pending {
        std::int64_t begin_time;
        State state;  // at the beginning
        RecordEncoder records;
    };

    Writer(std::filesystem::path folder, std::int64_t duration, std::uint64_t max_bytes)
        : folder_(std::move(folder)), duration_(duration), max_bytes_(max_bytes) {}
    [[nodiscard]] bool is_full(const Pending& pending, std::int64_t time) const;
    Result<void> complete_fragment();
    Result<void> write_fragment();
    void remove_before(std::uint32_t first);

    std::filesystem::path folder_;
    std::int64_t duration_;
    std::uint64_t max_bytes_;
    State state_;
    std::int64_t time_ = 0;
    std::uint32_t next_ = 0;
    std::optional<Pending> pending_;
    std::uint32_t first_ = 0;       // that `sync` names
    std::vector<Written> written_;  // ascending; those before first_ could not be removed yet
    std::optional<Error> error_;
};

}  // namespace camdir::recording
