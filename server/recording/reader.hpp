// Reads a recording from its folder.
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "recording/fragment.hpp"
#include "recording/sync.hpp"

namespace camdir::recording {

// Errors name the file, the byte and what was expected. Thread-safe.
class Reader {
  public:
    // Reads `start` and `sync`. A growing recording is read to what `sync` said here, as far as its fragments
    // are there: at least one is.
    [[nodiscard]] static Result<Reader> open(const std::filesystem::path& folder);

    [[nodiscard]] const Start& start() const { return start_; }
    // Of those that are there, damaged or not: ascending. Others between may be missing.
    [[nodiscard]] const std::vector<std::uint32_t>& fragments() const { return fragments_; }
    [[nodiscard]] std::uint32_t first_fragment() const { return fragments_.front(); }
    [[nodiscard]] std::uint32_t last_fragment() const { return fragments_.back(); }

    // The state at the fragment's beginning, and the records in it.
    [[nodiscard]] Result<State> full(std::uint32_t fragment) const;
    [[nodiscard]] Result<std::vector<Record>> delta(std::uint32_t fragment) const;

    [[nodiscard]] Result<std::int64_t> begin_time(std::uint32_t fragment) const;  // ns

    // The last fragment that begins at or before the time, in ns, of those whose `full` can be read; the
    // first one where none does.
    [[nodiscard]] std::uint32_t fragment_at(std::int64_t time) const;

    // Visits the messages of `full` of the fragment at the time, then all records to the end. Returns why
    // fragments were left out, if any; after them, those of the next one's `full` come first.
    [[nodiscard]] std::vector<Error> replay(std::int64_t time,
                                            const std::function<void(const Record&)>& visit) const;

  private:
    Reader(std::filesystem::path folder, Start start, std::vector<std::uint32_t> fragments)
        : folder_(std::move(folder)), start_(std::move(start)), fragments_(std::move(fragments)) {}
    // One fragment; `goes_on`: from the one before.
    [[nodiscard]] Result<void> replay_one(std::uint32_t fragment, bool goes_on,
                                          const std::function<void(const Record&)>& visit) const;
    // Fragments up to before `end`.
    [[nodiscard]] Error missing(std::uint32_t first, std::uint32_t end) const;
    [[nodiscard]] Result<Resource> resource(std::uint32_t fragment, ResourceKind kind) const;
    [[nodiscard]] std::filesystem::path path_of(std::uint32_t fragment, ResourceKind kind) const;
    [[nodiscard]] Result<std::vector<Record>> records(std::uint32_t fragment, ResourceKind kind) const;

    std::filesystem::path folder_;
    Start start_;
    std::vector<std::uint32_t> fragments_;
};

}  // namespace camdir::recording
