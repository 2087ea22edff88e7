#include "support/test_domain.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

namespace camdir::test {
namespace {

constexpr std::uint32_t first_domain = 1;
constexpr std::uint32_t last_domain = 80;

}  // namespace

TestDomain::TestDomain() {
    const auto folder = std::filesystem::temp_directory_path() / "camera-director-test-domains";
    if (std::filesystem::create_directories(folder))  // for every user of the machine
        std::filesystem::permissions(folder, std::filesystem::perms::all);
    const auto pid = static_cast<std::uint32_t>(::getpid());
    constexpr std::uint32_t count = last_domain - first_domain + 1;
    for (std::uint32_t i = 0; i < 100 * count; ++i) {
        id_ = first_domain + (pid + i) % count;
        lock_ = ::open((folder / std::to_string(id_)).c_str(), O_RDONLY | O_CREAT | O_CLOEXEC, 0644);
        if (lock_ < 0) throw std::runtime_error("cannot open a lock file in " + folder.string());
        if (::flock(lock_, LOCK_EX | LOCK_NB) == 0) return;
        ::close(lock_);
        if (i % count == count - 1) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    }
    throw std::runtime_error("every test domain is taken; locks are in " + folder.string());
}

TestDomain::~TestDomain() {
    ::close(lock_);
}

}  // namespace camdir::test
