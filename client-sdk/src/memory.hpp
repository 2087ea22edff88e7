// Where the objects that handles stand for take their memory from: see cdir_library_options.
#pragma once

#include <camera_director/camera_director.h>

#include <cstddef>
#include <limits>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace camdir::sdk {

struct Memory {
    cdir_allocate_function allocate;
    cdir_free_function free;
    void* user_data;

    bool operator==(const Memory&) const = default;
};

// In use for what is made from now on. Thread-safe.
[[nodiscard]] Memory current_memory();
// Null functions: the C++ runtime's. Thread-safe.
void use_memory(cdir_allocate_function allocate, cdir_free_function free, void* user_data);

// A standard allocator that keeps to the memory in use when it was made, and takes it along.
template <class T>
class Allocator {
  public:
    using value_type = T;
    using propagate_on_container_copy_assignment = std::true_type;
    using propagate_on_container_move_assignment = std::true_type;
    using propagate_on_container_swap = std::true_type;
    using is_always_equal = std::false_type;

    Allocator() : memory_(current_memory()) {}
    template <class Other>
    Allocator(const Allocator<Other>& other) noexcept : memory_(other.memory()) {}

    [[nodiscard]] T* allocate(std::size_t count) {
        if (count > std::numeric_limits<std::size_t>::max() / sizeof(T)) throw std::bad_alloc();
        void* taken = memory_.allocate(memory_.user_data, count * sizeof(T), alignof(T));
        if (taken == nullptr) throw std::bad_alloc();
        return static_cast<T*>(taken);
    }
    void deallocate(T* taken, std::size_t count) noexcept {
        memory_.free(memory_.user_data, taken, count * sizeof(T), alignof(T));
    }

    [[nodiscard]] const Memory& memory() const noexcept { return memory_; }
    template <class Other>
    bool operator==(const Allocator<Other>& other) const noexcept {
        return memory_ == other.memory();
    }

  private:
    Memory memory_;
};

template <class T>
using Vector = std::vector<T, Allocator<T>>;

template <class T, class... Arguments>
[[nodiscard]] std::shared_ptr<T> make_object_in(const Allocator<T>& allocator, Arguments&&... arguments) {
    return std::allocate_shared<T>(allocator, std::forward<Arguments>(arguments)...);
}

template <class T, class... Arguments>
[[nodiscard]] std::shared_ptr<T> make_object(Arguments&&... arguments) {
    return make_object_in<T>(Allocator<T>(), std::forward<Arguments>(arguments)...);
}

}  // namespace camdir::sdk
