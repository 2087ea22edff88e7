// Writes a match's recording into a folder.
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <vector>

#include "recording/fragment.hpp"

namespace camdir::recording {

// Not thread-safe. Whole up to the last complete fragment when the process is killed.
class Writer {
  public:
    // Creates the folder; one that has a `start` is refused. max_bytes bounds what the fragments take of the
    // disk, apart from those given up last; the newest always stays.
    [[nodiscard]] static Result<Writer> create(const std::filesystem::path& folder, const Start& start,
                                               std::uint64_t max_bytes);

    // Blocks for a write and fsync when the record begins the next fragment. A record with a time before the
    // last one's is refused, and is no part of the recording. An error of the disk ends the recording at its
    // last complete fragment: every later call returns the same error.
    [[nodiscard]] Result<void> append(const Record& record);

    // Ends the fragment that is as old as a fragment lasts, where no record has come to do it. Blocks and
    // fails as append().
    [[nodiscard]] Result<void> advance(std::int64_t time);

    // Writes what the last fragment has. Nothing may be appended after it.
    [[nodiscard]] Result<void> finish();

    // Whole fragments, oldest first.
    struct Written {
        std::uint32_t fragment;
        std::int64_t begin_time;
        std::uint64_t bytes;  // of the disk
    };
    [[nodiscard]] const std::vector<Written>& written() const { return written_; }

    [[nodiscard]] std::uint64_t bytes() const { return bytes_; }     // of the disk, of all written
    [[nodiscard]] std::uint64_t folder_bytes() const;                // with all else in the folder
    [[nodiscard]] std::uint32_t fragments() const { return next_; }  // also removed ones

    // Gives the oldest fragment up, as if max_bytes had asked for it. There must be two. Its files stay until
    // the next one is given up, or the recording is finished: a reader may have been told of it just before.
    [[nodiscard]] Result<void> remove_oldest();

  private:
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
    [[nodiscard]] std::uint32_t first_within_bound() const;
    Result<void> tell(std::uint32_t first);
    Result<void> remove_given_up();

    std::filesystem::path folder_;
    std::int64_t duration_;
    std::uint64_t max_bytes_;
    State state_;
    std::int64_t time_ = std::numeric_limits<std::int64_t>::min();
    std::uint32_t next_ = 0;
    std::optional<Pending> pending_;
    std::vector<Written> written_;
    std::vector<std::uint32_t> given_up_;  // whose files are still there
    std::uint64_t bytes_ = 0;
    std::optional<Error> error_;
};

}  // namespace camdir::recording
