#include "support/test_domain.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <chrono>
#include <stdexcept>
#include <string>
#include <thread>

namespace camdir::test {
namespace {

constexpr std::uint32_t first_domain = 1;
constexpr std::uint32_t last_domain = 80;

// Any user may have put something else there: nothing is created or waited for through a link or a pipe.
int open_lock(const std::string& path) {
    const int created = ::open(path.c_str(), O_RDONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
    if (created < 0) return ::open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    ::fchmod(created, 0644);  // other users must be able to open it, whatever the umask
    return created;
}

}  // namespace

// By the DDSI standard with port base 7400.
std::string director_address(std::uint32_t domain, int participant_index, const std::string& host) {
    return host + ":" +
           std::to_string(7400 + 250 * domain + 10 + 2 * static_cast<std::uint32_t>(participant_index));
}

TestDomain::TestDomain(const std::filesystem::path& locks) {
    ::mkdir(locks.c_str(), 0777);
    // For every user, who may not replace another's locks. Fails when it belongs to another, who has done so.
    ::chmod(locks.c_str(), 01777);
    const auto pid = static_cast<std::uint32_t>(::getpid());
    constexpr std::uint32_t count = last_domain - first_domain + 1;
    for (std::uint32_t i = 0; i < 100 * count; ++i) {
        id_ = first_domain + (pid + i) % count;
        lock_ = open_lock(locks / std::to_string(id_));
        if (lock_ >= 0 && ::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
        if (lock_ >= 0) ::close(lock_);
        if (i % count == count - 1) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    throw std::runtime_error("every test domain is taken, or its lock in " + locks.string() +
                             " cannot be opened");
}

TestDomain::~TestDomain() {
    ::close(lock_);
}

}  // namespace camdir::test
