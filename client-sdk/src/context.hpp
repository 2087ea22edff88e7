// A context: one participant in a DDS domain that the contexts of this process share.
#pragma once

#include <camera_director/camera_director.h>

#include <cstdint>
#include <string>

#include "topics.hpp"

namespace camdir::sdk {

// A share of a domain: the first one joins and configures the domain, the last one leaves it. Thread-safe.
class DomainShare {
  public:
    // Throws a Failure: CDIR_CONFLICT when the domain is open with another configuration or identity or the
    // process holds too many file descriptors, CDIR_NETWORK when DDS refuses the configuration or no
    // director's address can be resolved.
    explicit DomainShare(const cdir_context_options& options);
    ~DomainShare();
    DomainShare(const DomainShare&) = delete;
    DomainShare& operator=(const DomainShare&) = delete;

  private:
    std::uint32_t domain_;
};

// The caller's options, whose strings it need not keep.
class OwnedOptions {
  public:
    explicit OwnedOptions(const cdir_context_options& options);
    [[nodiscard]] cdir_context_options get() const;  // valid as long as this

  private:
    cdir_context_options options_;
    std::string network_interface_, directors_, cyclone_xml_, security_;
};

// Immutable: thread-safe.
class Context {
  public:
    explicit Context(const cdir_context_options& options);

    [[nodiscard]] dds_entity_t participant() const { return participant_.get(); }
    [[nodiscard]] const Topics& topics() const { return topics_; }

  private:
    DomainShare domain_;
    Entity participant_;
    Topics topics_;
};

}  // namespace camdir::sdk
