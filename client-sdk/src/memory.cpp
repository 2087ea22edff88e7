#include "memory.hpp"

#include <mutex>

namespace camdir::sdk {

namespace {

void* allocate_by_runtime(void* /*user_data*/, std::size_t size, std::size_t alignment) {
    return ::operator new(size, std::align_val_t(alignment), std::nothrow);
}

void free_by_runtime(void* /*user_data*/, void* memory, std::size_t /*size*/, std::size_t alignment) {
    ::operator delete(memory, std::align_val_t(alignment));
}

std::mutex memory_mutex;
Memory memory_in_use{allocate_by_runtime, free_by_runtime, nullptr};

}  // namespace

Memory current_memory() {
    const std::lock_guard lock(memory_mutex);
    return memory_in_use;
}

void use_memory(cdir_allocate_function allocate, cdir_free_function free, void* user_data) {
    const std::lock_guard lock(memory_mutex);
    memory_in_use = allocate == nullptr ? Memory{allocate_by_runtime, free_by_runtime, nullptr}
                                        : Memory{allocate, free, user_data};
}

}  // namespace camdir::sdk
