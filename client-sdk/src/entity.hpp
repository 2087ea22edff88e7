// Owns Cyclone DDS's entities; its return codes as Failures.
#pragma once

#include <dds/dds.h>

#include <string>
#include <utility>

#include "failure.hpp"
#include "idl/deletion.h"
#include "idl/security.hpp"

namespace camdir::sdk {

// `what` is what failed, such as "cannot create the reader of CameraFrame".
[[noreturn]] inline void fail_dds(const std::string& what, dds_return_t code) {
    throw Failure{CDIR_NETWORK, what + ": " + wire::describe_failure(code)};
}

inline void check_dds(const std::string& what, dds_return_t code) {
    if (code < 0) fail_dds(what, code);
}

// For the result of dds_write(): a full send queue is CDIR_BUSY.
inline void check_written(const std::string& topic, dds_return_t code) {
    if (code == DDS_RETCODE_TIMEOUT) throw Failure{CDIR_BUSY, topic + ": the send queue is full"};
    check_dds(topic + ": cannot write", code);
}

// Owns a DDS entity and deletes it.
class Entity {
  public:
    Entity() = default;
    // `created` is the result of a dds_create_ function. Throws a Failure when it is negative.
    Entity(const std::string& what, dds_entity_t created) : entity_(created) { check_dds(what, created); }
    Entity(Entity&& other) noexcept : entity_(std::exchange(other.entity_, 0)) {}
    Entity& operator=(Entity&& other) noexcept {
        std::swap(entity_, other.entity_);
        return *this;
    }
    Entity(const Entity&) = delete;
    Entity& operator=(const Entity&) = delete;
    ~Entity() {
        if (entity_ > 0) camdir_delete_entity(entity_);
    }

    [[nodiscard]] dds_entity_t get() const { return entity_; }

  private:
    dds_entity_t entity_ = 0;
};

}  // namespace camdir::sdk
