// DDS domains for tests, which run concurrently. Domains up to 99 have ports (7400 + 250 per domain) below
// the system's ephemeral ones: 1 to 80 are for TestDomain, 81 for directors without a match, 83 to 99 for the
// tests of the SDK.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace camdir::test {

// For directors without a well-known port, which therefore find nobody.
inline constexpr std::uint32_t quiet_domain = 81;
// Shared by the SDK's tests within one process, each with a match of its own.
inline constexpr std::uint32_t shared_domain = 84;
// For the SDK's tests that need a director's well-known port: they take the first free one.
inline constexpr std::uint32_t first_director_domain = 85;
inline constexpr std::uint32_t last_director_domain = 99;

// HOST:PORT at which a director is found.
[[nodiscard]] std::string director_address(std::uint32_t domain, int participant_index,
                                           const std::string& host = "127.0.0.1");

// A domain that no other TestDomain on this machine uses until the destructor, or the process's end. The
// constructor waits for a free one.
class TestDomain {
  public:
    // locks: the same folder for all users, whatever their TMPDIR, and for lock_domain in
    // deploy/processes.sh.
    explicit TestDomain(const std::filesystem::path& locks = "/tmp/camera-director-test-domains");
    ~TestDomain();
    TestDomain(const TestDomain&) = delete;
    TestDomain& operator=(const TestDomain&) = delete;

    [[nodiscard]] std::uint32_t id() const { return id_; }

  private:
    std::uint32_t id_ = 0;
    int lock_ = -1;
};

}  // namespace camdir::test
