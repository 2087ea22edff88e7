// A DDS domain that nobody else on this machine is using: tests run beside each other.
#pragma once

#include <cstdint>

namespace camdir::test {

// Held until the object's end, or the process's. Waits for a free one.
class TestDomain {
  public:
    TestDomain();
    ~TestDomain();
    TestDomain(const TestDomain&) = delete;
    TestDomain& operator=(const TestDomain&) = delete;

    [[nodiscard]] std::uint32_t id() const { return id_; }

  private:
    std::uint32_t id_ = 0;
    int lock_ = -1;
};

}  // namespace camdir::test
