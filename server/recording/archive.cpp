#include "recording/archive.hpp"

#include <fcntl.h>
#include <spdlog/fmt/chrono.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

#include "recording/percent.hpp"

namespace camdir::recording {
namespace {

namespace fs = std::filesystem;

// The blocks of all files below; what vanishes meanwhile counts nothing.
std::uint64_t disk_bytes(const fs::path& folder) {
    constexpr std::uint64_t block = 4096;
    std::uint64_t bytes = block;
    std::error_code error;
    for (fs::recursive_directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code gone;
        const std::uintmax_t size = it->is_regular_file(gone) ? it->file_size(gone) : block;
        if (!gone) bytes += (size + block - 1) / block * block;
    }
    return bytes;
}

bool is_recording(const fs::directory_entry& entry) {
    std::error_code error;
    return entry.symlink_status(error).type() == fs::file_type::directory &&
           fs::exists(entry.path() / "start", error);
}

}  // namespace

std::string folder_name(const std::string& recording_id, const std::string& match_id) {
    return recording_id + "-" + percent_encoded(match_id);
}

std::string new_recording_id(std::int64_t time) {
    const std::int64_t ms = time / 1'000'000;
    return fmt::format("{:%Y%m%dT%H%M%S}.{:03}Z-{:08x}", fmt::gmtime(static_cast<std::time_t>(ms / 1000)),
                       ms % 1000, std::random_device()());
}

Result<Archive> Archive::open(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return fail(folder.string() + ": cannot create: " + error.message());
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return fail(folder.string() + ": cannot open: " + std::generic_category().message(errno));
    Archive archive(folder, descriptor);
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        return fail(folder.string() + ": cannot lock: " + std::generic_category().message(errno) +
                    ": expected a folder that no other director records into");
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error))
        if (is_recording(*it)) archive.add_ended(it->path().filename().string());
    if (error) return fail(folder.string() + ": cannot list: " + error.message());
    return archive;
}

Result<void> Archive::check(const fs::path& folder) {
    // Of a folder that is still to be made, the nearest one above it that is there.
    fs::path nearest = fs::absolute(folder);
    std::error_code error;
    while (!fs::exists(nearest, error) && nearest.has_relative_path())
        nearest = nearest.parent_path();
    if (!fs::is_directory(nearest, error))
        return fail(folder.string() + ": " + nearest.string() + " is no folder: expected one for recordings");
    if (::access(nearest.c_str(), W_OK | X_OK) != 0)
        return fail(folder.string() + ": " + nearest.string() +
                    " cannot be written: " + std::generic_category().message(errno) +
                    ": expected a folder that this user may write to");
    return {};
}

Archive::Archive(Archive&& other) noexcept
    : folder_(std::move(other.folder_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      ended_(std::move(other.ended_)),
      ended_bytes_(other.ended_bytes_) {}

Archive::~Archive() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

void Archive::add_ended(const std::string& name) {
    const std::uint64_t bytes = disk_bytes(path_of(name));
    if (ended_.emplace(name, bytes).second) ended_bytes_ += bytes;
}

bool Archive::remove_oldest() {
    if (ended_.empty()) return false;
    const auto oldest = ended_.begin();
    const fs::path folder = path_of(oldest->first);
    // Without `sync` it is not read any more.
    std::error_code error;
    fs::remove(folder / "sync", error);
    if (!error) fs::remove_all(folder, error);
    if (error) spdlog::error("{}: cannot remove the recording: {}", folder.string(), error.message());
    ended_bytes_ -= oldest->second;
    ended_.erase(oldest);
    return true;
}

}  // namespace camdir::recording
