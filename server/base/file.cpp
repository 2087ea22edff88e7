#include "base/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace camdir {
namespace {

std::string reason(int error) {
    return std::generic_category().message(error);
}

class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(Descriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
    Descriptor& operator=(Descriptor&&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) ::close(fd_);
    }
    [[nodiscard]] int get() const { return fd_; }
    [[nodiscard]] bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

  private:
    int fd_;
};

struct OpenFile {
    Descriptor descriptor;
    std::size_t size;
};

Result<OpenFile> open_regular(const std::filesystem::path& path) {
    // Non-blocking, so that a named pipe is refused instead of waited for.
    OpenFile file{Descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)), 0};
    if (file.descriptor.get() < 0) return fail(path.string() + ": cannot open: " + reason(errno));
    struct stat status {};
    if (::fstat(file.descriptor.get(), &status) != 0)
        return fail(path.string() + ": cannot stat: " + reason(errno));
    if (!S_ISREG(status.st_mode)) return fail(path.string() + ": not a regular file");
    file.size = static_cast<std::size_t>(status.st_size);
    return file;
}

bool write_all(int fd, std::span<const std::byte> content) {
    while (!content.empty()) {
        const ssize_t written = ::write(fd, content.data(), content.size());
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) return false;
        content = content.subspan(static_cast<std::size_t>(written));
    }
    return true;
}

}  // namespace

Result<Bytes> read_file(const std::filesystem::path& path, std::size_t max_bytes) {
    auto file = open_regular(path);
    if (!file) return tl::unexpected(file.error());
    if (file->size > max_bytes)
        return fail(path.string() + ": has " + std::to_string(file->size) + " bytes, expected at most " +
                    std::to_string(max_bytes));
    Bytes content(file->size);
    std::size_t done = 0;
    while (done < content.size()) {
        const ssize_t got = ::read(file->descriptor.get(), content.data() + done, content.size() - done);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return fail(path.string() + ": cannot read: " + reason(errno));
        if (got == 0) break;
        done += static_cast<std::size_t>(got);
    }
    content.resize(done);
    return content;
}

namespace {

// A device or a pipe must not be replaced by a file.
bool is_special(const std::filesystem::path& path) {
    struct stat status {};
    return ::stat(path.c_str(), &status) == 0 && !S_ISREG(status.st_mode) && !S_ISDIR(status.st_mode);
}

// Where the link leads, also when nothing is there yet.
std::filesystem::path target_of(std::filesystem::path path) {
    constexpr int most_links = 40;
    std::error_code error;
    for (int i = 0; i < most_links && std::filesystem::is_symlink(path, error); ++i)
        path = path.parent_path() / std::filesystem::read_symlink(path, error);
    return path;
}

Result<void> write_into(const std::filesystem::path& path, std::span<const std::byte> content) {
    Descriptor descriptor(::open(path.c_str(), O_WRONLY | O_CLOEXEC));
    if (descriptor.get() < 0) return fail(path.string() + ": cannot open: " + reason(errno));
    if (!write_all(descriptor.get(), content) || !descriptor.close())
        return fail(path.string() + ": cannot write: " + reason(errno));
    return {};
}

Result<void> replace(const std::filesystem::path& path, std::span<const std::byte> content) {
    std::string temporary = path.string() + ".XXXXXX";
    Descriptor descriptor(::mkostemp(temporary.data(), O_CLOEXEC));
    if (descriptor.get() < 0) return fail(path.string() + ": cannot create: " + reason(errno));
    const bool written = write_all(descriptor.get(), content) && ::fchmod(descriptor.get(), 0644) == 0 &&
                         ::fsync(descriptor.get()) == 0 && descriptor.close() &&
                         ::rename(temporary.c_str(), path.c_str()) == 0;
    if (!written) {
        const int error = errno;
        ::unlink(temporary.c_str());
        return fail(path.string() + ": cannot write: " + reason(error));
    }
    return {};
}

}  // namespace

Result<void> write_file(const std::filesystem::path& path, std::span<const std::byte> content) {
    if (path == "-") {
        if (!write_all(STDOUT_FILENO, content))
            return fail("standard output: cannot write: " + reason(errno));
        return {};
    }
    if (is_special(path)) return write_into(path, content);
    return replace(target_of(path), content);
}

Result<void> write_file(const std::filesystem::path& path, const std::string& content) {
    return write_file(path, std::as_bytes(std::span(content)));
}

namespace {

std::filesystem::path part_of(const std::filesystem::path& path) {
    return path.string() + ".part";
}

// Whether the name still stands for the open file: another process may have renamed or removed it.
bool is_named(int fd, const std::filesystem::path& name) {
    struct stat open_file {};
    struct stat named {};
    return ::fstat(fd, &open_file) == 0 && ::stat(name.c_str(), &named) == 0 &&
           open_file.st_dev == named.st_dev && open_file.st_ino == named.st_ino;
}

}  // namespace

Result<std::optional<PendingFile>> PendingFile::begin(const std::filesystem::path& named) {
    const std::filesystem::path path = target_of(named);
    const std::filesystem::path part = part_of(path);
    for (;;) {
        const int fd = ::open(part.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK, 0644);
        if (fd < 0)
            return fail(part.string() + ": cannot create: " + reason(errno) +
                        "; expected a folder that this user may write to");
        PendingFile pending(path, fd);
        if (::flock(fd, LOCK_EX | LOCK_NB) != 0) {
            const int error = errno;
            pending.release();
            if (error == EWOULDBLOCK) return std::nullopt;
            return fail(part.string() + ": cannot lock: " + reason(error));
        }
        if (is_named(fd, part)) return pending;
        pending.release();
    }
}

PendingFile::PendingFile(PendingFile&& other) noexcept
    : path_(std::move(other.path_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

PendingFile::~PendingFile() {
    if (descriptor_ < 0) return;
    ::unlink(part_of(path_).c_str());
    release();
}

void PendingFile::release() {
    ::close(std::exchange(descriptor_, -1));
}

Result<void> PendingFile::finish(std::span<const std::byte> content) && {
    const bool written = ::ftruncate(descriptor_, 0) == 0 && write_all(descriptor_, content) &&
                         ::fchmod(descriptor_, 0644) == 0 && ::fsync(descriptor_) == 0 &&
                         ::rename(part_of(path_).c_str(), path_.c_str()) == 0;
    if (!written) {
        const int error = errno;
        return fail(path_.string() + ": cannot write: " + reason(error));
    }
    release();
    return {};
}

}  // namespace camdir
