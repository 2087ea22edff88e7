// The DDS domains that this process has joined, shared by its contexts.
#pragma once

#include <cstdint>
#include <string>

namespace camdir::sdk {

// One context's share of a domain. The first share of a domain configures it, the last one leaves it.
// Thread-safe.
class DomainShare {
  public:
    // Throws Failure: CDIR_CONFLICT when the domain is open with another configuration or the process holds
    // too many file descriptors.
    DomainShare(std::uint32_t domain, const std::string& configuration);
    ~DomainShare();
    DomainShare(const DomainShare&) = delete;
    DomainShare& operator=(const DomainShare&) = delete;

  private:
    std::uint32_t domain_;
};

}  // namespace camdir::sdk
