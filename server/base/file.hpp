// Whole files in and out.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"

namespace camdir {

using Bytes = std::vector<std::byte>;

// Reads a regular file of at most `max_bytes`. Errors name the path and the system's reason.
[[nodiscard]] Result<Bytes> read_file(const std::filesystem::path& path,
                                      std::size_t max_bytes = std::numeric_limits<std::size_t>::max());

// Writes to a temporary file beside `path`, syncs it and renames it over `path`: a reader sees the old
// content or all of the new one, and a failed write leaves nothing behind (a killed one at most
// `path`.XXXXXX). A symbolic link keeps its place. Devices and pipes are written into; "-" is standard
// output.
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> content);
[[nodiscard]] Result<void> write_file(const std::filesystem::path& path, const std::string& content);

// A file that takes long to make, and that several processes or threads may want to make at once. While it is
// made, `path`.part exists and is locked, and others can wait for the file. A process that is killed leaves
// at most an unlocked `path`.part, which the next one takes over. Movable.
class PendingFile {
  public:
    // Nothing: another process or thread is making the file. A symbolic link keeps its place.
    [[nodiscard]] static Result<std::optional<PendingFile>> begin(const std::filesystem::path& path);
    PendingFile(PendingFile&& other) noexcept;
    PendingFile& operator=(PendingFile&&) = delete;
    // Removes `path`.part; `path` is as it was before unless finish succeeded.
    ~PendingFile();

    // Writes, syncs and renames over `path`, once: a reader sees the old content or all of the new one.
    [[nodiscard]] Result<void> finish(std::span<const std::byte> content) &&;

  private:
    PendingFile(std::filesystem::path path, int descriptor)
        : path_(std::move(path)), descriptor_(descriptor) {}
    void release();

    std::filesystem::path path_;
    int descriptor_ = -1;  // of the locked path_.part; -1: moved from
};

}  // namespace camdir
