// Owns a DDS entity; DDS's return codes as the project's errors.
#pragma once

#include <dds/dds.h>

#include <string>
#include <utility>

#include "base/error.hpp"
#include "idl/deletion.h"
#include "idl/security.hpp"

namespace camdir::dds {

// Deletes the entity and its children on destruction. Must not be destroyed inside a DDS callback.
class Entity {
  public:
    Entity() = default;
    explicit Entity(dds_entity_t handle) : handle_(handle) {}
    Entity(Entity&& other) noexcept : handle_(std::exchange(other.handle_, 0)) {}
    Entity& operator=(Entity&& other) noexcept {
        reset(std::exchange(other.handle_, 0));
        return *this;
    }
    ~Entity() { reset(); }

    [[nodiscard]] dds_entity_t handle() const { return handle_; }
    void reset(dds_entity_t handle = 0) {
        if (handle_ > 0) camdir_delete_entity(handle_);
        handle_ = handle;
    }

  private:
    dds_entity_t handle_ = 0;
};

[[nodiscard]] inline tl::unexpected<Error> dds_failure(const std::string& doing, dds_return_t code) {
    return fail(doing + ": DDS says: " + wire::describe_failure(code));
}

// For the result of a dds_create_... call: the entity, or an error that says what `doing` was.
[[nodiscard]] inline Result<Entity> created(dds_entity_t handle, const std::string& doing) {
    if (handle < 0) return dds_failure(doing, handle);
    return Entity(handle);
}

}  // namespace camdir::dds
