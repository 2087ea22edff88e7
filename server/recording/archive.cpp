#include "recording/archive.hpp"

#include <fcntl.h>
#include <spdlog/fmt/chrono.h>
#include <spdlog/spdlog.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <random>
#include <regex>
#include <string_view>
#include <system_error>
#include <utility>

#include "base/file.hpp"
#include "recording/percent.hpp"
#include "recording/resource.hpp"

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

constexpr std::string_view removed_mark = ".removed-";

// As folder_name() and new_recording_id() make it.
bool is_folder_name(std::string_view name) {
    static const std::regex pattern(R"([0-9]{8}T[0-9]{6}\.[0-9]{3}Z-[0-9a-f]{8}-[A-Za-z0-9_%]*)");
    return std::regex_match(name.begin(), name.end(), pattern);
}

bool is_folder(const fs::directory_entry& entry) {
    std::error_code error;
    return entry.symlink_status(error).type() == fs::file_type::directory;
}

bool may_be_recording(const fs::directory_entry& entry) {
    return is_folder(entry) && is_folder_name(entry.path().filename().native());
}

// What is removed must be certain to be one.
bool is_recording(const fs::path& folder) {
    const auto start = read_file(folder / "start", max_resource);
    return start && has_header(*start, ResourceKind::start, 0);
}

// When the last fragment was complete, or there was none yet. Names tell when a recording began, by a clock
// that was perhaps not set yet.
fs::file_time_type end_of(const fs::path& folder) {
    std::error_code error;
    for (const char* file : {"sync", "start"})
        if (const auto time = fs::last_write_time(folder / file, error); !error) return time;
    return fs::file_time_type::min();
}

// Its `start` may be gone.
bool is_being_removed(const fs::directory_entry& entry) {
    const std::string name = entry.path().filename().string();
    return name.starts_with(removed_mark) &&
           is_folder_name(std::string_view(name).substr(removed_mark.size())) && is_folder(entry);
}

// One folder of a fragment after the other, so that a stop need not wait for all.
void remove_files(const fs::path& folder, const std::stop_token& stop) {
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end && !stop.stop_requested();
         it.increment(error)) {
        std::error_code ignored;
        fs::remove_all(it->path(), ignored);
    }
    if (!stop.stop_requested()) fs::remove_all(folder, error);
    if (error) spdlog::error("{}: cannot remove: {}", folder.string(), error.message());
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

Result<std::unique_ptr<Archive>> Archive::open(const fs::path& folder) {
    std::error_code error;
    fs::create_directories(folder, error);
    if (error) return fail(folder.string() + ": cannot create: " + error.message());
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (descriptor < 0)
        return fail(folder.string() + ": cannot open: " + std::generic_category().message(errno));
    std::unique_ptr<Archive> archive(new Archive(folder, descriptor));
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0)
        return fail(folder.string() + ": cannot lock: " + std::generic_category().message(errno) +
                    ": expected a folder that no other director records into");
    if (auto listed = archive->list(); !listed) return tl::unexpected(listed.error());
    try {
        archive->thread_ =
            std::jthread([raw = archive.get()](const std::stop_token& stop) { raw->run(stop); });
    } catch (const std::system_error& failed) {
        return fail(folder.string() + ": cannot start the thread that removes recordings: " + failed.what());
    }
    return archive;
}

Result<void> Archive::list() {
    std::error_code error;
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        if (is_being_removed(*it))
            removed_.push_back(it->path());
        else if (may_be_recording(*it))
            unmeasured_.push_back(name);
    }
    if (error) return fail(folder_.string() + ": cannot list: " + error.message());
    std::ranges::sort(unmeasured_);
    return {};
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

Archive::~Archive() {
    thread_ = {};
    ::close(descriptor_);
}

bool Archive::is_in_place() const {
    struct stat locked {};
    struct stat named {};
    if (::fstat(descriptor_, &locked) != 0) return false;
    if (::stat(folder_.c_str(), &named) != 0) return errno != ENOENT && errno != ENOTDIR;
    return locked.st_dev == named.st_dev && locked.st_ino == named.st_ino;
}

void Archive::add_ended(const std::string& name, std::uint64_t bytes) {
    const Ended ended{end_of(path_of(name)), name, bytes};
    const std::lock_guard lock(mutex_);
    if (std::ranges::find(ended_, name, &Ended::name) != ended_.end()) return;
    ended_.insert(ended);
    ended_bytes_ += bytes;
}

std::uint64_t Archive::ended_bytes() const {
    const std::lock_guard lock(mutex_);
    return ended_bytes_;
}

std::vector<std::string> Archive::remove_oldest() {
    const std::lock_guard lock(mutex_);
    std::vector<std::string> removed = forget_gone();
    if (removed.empty() && !ended_.empty()) {
        const Ended oldest = std::move(ended_.extract(ended_.begin()).value());
        ended_bytes_ -= oldest.bytes;
        remove(oldest.name);
        removed.push_back(oldest.name);
    }
    return removed;
}

// What somebody else has removed or moved away.
std::vector<std::string> Archive::forget_gone() {
    std::set<std::string> there;
    std::error_code error;
    for (fs::directory_iterator it(folder_, error), end; !error && it != end; it.increment(error))
        there.insert(it->path().filename().string());
    std::vector<std::string> gone;
    if (error) return gone;
    std::erase_if(ended_, [&](const Ended& ended) {
        if (there.contains(ended.name)) return false;
        ended_bytes_ -= ended.bytes;
        gone.push_back(ended.name);
        return true;
    });
    return gone;
}

void Archive::remove(const std::string& name) {
    const fs::path removed = path_of(std::string(removed_mark) + name);
    std::error_code error;
    // Of somebody else it would only be hidden.
    if (::access(path_of(name).c_str(), W_OK | X_OK) != 0)
        error.assign(errno, std::generic_category());
    else
        fs::rename(path_of(name), removed, error);
    if (error) {
        spdlog::error("{}: cannot remove the recording: {}", path_of(name).string(), error.message());
    } else {
        spdlog::info("{}: removed: recordings take more than the bound", path_of(name).string());
        removed_.push_back(removed);
        wake_.notify_one();
    }
}

// What is removed goes first: the disk may be full.
void Archive::run(const std::stop_token& stop) {
    std::ranges::reverse(unmeasured_);
    while (!stop.stop_requested()) {
        if (const auto folder = next_removed(stop)) {
            remove_files(*folder, stop);
        } else if (!unmeasured_.empty()) {
            const fs::path folder = path_of(unmeasured_.back());
            if (is_recording(folder)) add_ended(unmeasured_.back(), disk_bytes(folder));
            unmeasured_.pop_back();
        }
    }
}

// Waits for one where nothing else is to be done.
std::optional<fs::path> Archive::next_removed(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    if (unmeasured_.empty()) wake_.wait(lock, stop, [this] { return !removed_.empty(); });
    if (removed_.empty()) return std::nullopt;
    fs::path folder = std::move(removed_.front());
    removed_.pop_front();
    return folder;
}

}  // namespace camdir::recording
