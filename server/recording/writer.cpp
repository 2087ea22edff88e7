#include "recording/writer.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

#include "recording/sync.hpp"

namespace camdir::recording {
namespace {

constexpr std::size_t max_delta = max_content / 2;  // a record fits into the other half

// Disks give whole blocks, a folder one.
constexpr std::uint64_t block = 4096;

std::uint64_t on_disk(const Bytes& bytes) {
    return (bytes.size() + block - 1) / block * block;
}

// The names must be on the disk before `sync` tells them.
Result<void> sync_folder(const std::filesystem::path& folder) {
    const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    const bool synced = descriptor >= 0 && ::fsync(descriptor) == 0;
    const int error = errno;
    if (descriptor >= 0) ::close(descriptor);
    if (!synced) return fail(folder.string() + ": cannot sync: " + std::generic_category().message(error));
    return {};
}

Result<void> created(const std::filesystem::path& folder, const std::error_code& error) {
    if (error) return fail(folder.string() + ": cannot create: " + error.message());
    return {};
}

}  // namespace

Result<Writer> Writer::create(const std::filesystem::path& folder, const Start& start,
                              std::uint64_t max_bytes) {
    std::error_code ignored;
    if (std::filesystem::exists(folder / "start", ignored))
        return fail(folder.string() + ": has a recording already, expected a new folder");
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    Result<void> done = created(folder, error);
    if (done) done = write_file(folder / "start", encode_start(start));
    if (done) done = sync_folder(folder.has_parent_path() ? folder.parent_path() : ".");
    if (!done) std::filesystem::remove(folder, ignored);  // when it is empty
    if (!done) return tl::unexpected(done.error());
    return Writer(folder, start.fragment_duration, max_bytes);
}

Result<void> Writer::append(const Record& record) {
    if (error_) return tl::unexpected(*error_);
    if (record.time < time_)
        return fail(folder_.string() + ": a record at " + std::to_string(record.time) +
                    " ns, expected not before " + std::to_string(time_));
    if (auto done = advance(record.time); !done) return done;
    if (!pending_) pending_.emplace(Pending{record.time, state_, RecordEncoder(record.time)});
    time_ = record.time;
    pending_->records.add(record.time, record.message);
    state_.apply(record.message);
    return {};
}

Result<void> Writer::advance(std::int64_t time) {
    if (error_) return tl::unexpected(*error_);
    return pending_ && is_full(*pending_, time) ? complete_fragment() : Result<void>{};
}

// The time is not before the fragment's: a difference beyond 64 bits is one of more than any duration.
bool Writer::is_full(const Pending& pending, std::int64_t time) const {
    std::int64_t elapsed = 0;
    return __builtin_sub_overflow(time, pending.begin_time, &elapsed) || elapsed >= duration_ ||
           pending.records.content().size() > max_delta || pending.records.count() == max_records;
}

Result<void> Writer::finish() {
    if (error_) return tl::unexpected(*error_);
    auto done = pending_ ? complete_fragment() : Result<void>{};
    return done ? remove_given_up() : done;
}

Result<void> Writer::complete_fragment() {
    auto done = write_fragment();
    if (!done) error_ = done.error();
    pending_.reset();
    return done;
}

Result<void> Writer::write_fragment() {
    RecordEncoder full(pending_->begin_time);
    for (const Message& message : pending_->state.messages())
        full.add(pending_->begin_time, message);
    if (full.content().size() > max_content || pending_->records.content().size() > max_content)
        return fail(folder_.string() + ": a fragment above " + std::to_string(max_content) + " bytes");
    const Bytes full_bytes =
        encode(Resource{ResourceKind::full, next_, pending_->begin_time, full.content()});
    const Bytes delta_bytes =
        encode(Resource{ResourceKind::delta, next_, pending_->begin_time, pending_->records.content()});

    const std::filesystem::path folder = folder_ / std::to_string(next_);
    // Only in the recording's folder: whoever removed that removed `start` too, without which nothing is
    // read.
    std::error_code error;
    std::filesystem::create_directory(folder, error);
    Result<void> done = created(folder, error);
    if (done) done = write_file(folder / "full", full_bytes);
    if (done) done = write_file(folder / "delta", delta_bytes);
    if (done) done = sync_folder(folder);
    if (done) done = sync_folder(folder_);
    if (!done) return done;

    written_.push_back({next_, pending_->begin_time, block + on_disk(full_bytes) + on_disk(delta_bytes)});
    bytes_ += written_.back().bytes;
    ++next_;
    return tell(first_within_bound());
}

std::uint32_t Writer::first_within_bound() const {
    std::uint64_t total = 0;
    std::uint32_t first = written_.back().fragment;
    for (auto it = written_.rbegin(); it != written_.rend() && (total += it->bytes) <= max_bytes_; ++it)
        first = it->fragment;
    return first;
}

Result<void> Writer::remove_oldest() {
    if (error_) return tl::unexpected(*error_);
    auto done = tell(written_[1].fragment);
    if (!done) error_ = done.error();
    return done;
}

// Which fragments there are; the others are given up.
Result<void> Writer::tell(std::uint32_t first) {
    auto done = write_file(folder_ / "sync", encode(Sync{first, written_.back().fragment}));
    if (!done || written_.front().fragment == first) return done;
    done = remove_given_up();
    while (written_.front().fragment < first) {
        given_up_.push_back(written_.front().fragment);
        bytes_ -= written_.front().bytes;
        written_.erase(written_.begin());
    }
    return done;
}

Result<void> Writer::remove_given_up() {
    for (const std::uint32_t fragment : given_up_) {
        const std::filesystem::path old = folder_ / std::to_string(fragment);
        std::error_code error;
        std::filesystem::remove_all(old, error);
        if (error) return fail(old.string() + ": cannot remove: " + error.message());
    }
    given_up_.clear();
    return {};
}

std::uint64_t Writer::folder_bytes() const {
    constexpr std::uint64_t others = 3;  // itself, start, sync
    return bytes_ + others * block;
}

}  // namespace camdir::recording
