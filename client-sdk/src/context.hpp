// One participant in a DDS domain.
#pragma once

#include <camera_director/camera_director.h>

#include "domain.hpp"
#include "topics.hpp"

namespace camdir::sdk {

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
