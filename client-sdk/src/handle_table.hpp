// Maps handles to objects. A handle is a slot and the slot's generation, so that closed handles are detected.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <shared_mutex>
#include <vector>

namespace camdir::sdk {

// Thread-safe.
template <class T>
class HandleTable {
  public:
    // Returns the handle, never 0: the low half is the slot's index + 1, the high half its generation.
    [[nodiscard]] std::uint64_t insert(std::shared_ptr<T> object) {
        const std::unique_lock lock(mutex_);
        std::size_t index = 0;
        while (index < slots_.size() && slots_[index].object) {
            ++index;
        }
        if (index == slots_.size()) slots_.emplace_back();
        slots_[index].object = std::move(object);
        return (std::uint64_t{slots_[index].generation} << 32U) | (index + 1);
    }

    // Null when the handle is closed or was never issued.
    [[nodiscard]] std::shared_ptr<T> find(std::uint64_t id) const {
        const std::shared_lock lock(mutex_);
        const std::size_t index = index_of(id);
        return index < slots_.size() ? slots_[index].object : nullptr;
    }

    // Like find(), and closes the handle.
    [[nodiscard]] std::shared_ptr<T> remove(std::uint64_t id) {
        const std::unique_lock lock(mutex_);
        const std::size_t index = index_of(id);
        return index < slots_.size() ? release(slots_[index]) : nullptr;
    }

    [[nodiscard]] std::vector<std::shared_ptr<T>> remove_if(const std::function<bool(const T&)>& chosen) {
        const std::unique_lock lock(mutex_);
        std::vector<std::shared_ptr<T>> removed;
        for (Slot& slot : slots_) {
            if (slot.object && chosen(*slot.object)) removed.push_back(release(slot));
        }
        return removed;
    }

  private:
    struct Slot {
        std::uint32_t generation = 1;
        std::shared_ptr<T> object;
    };

    [[nodiscard]] std::size_t index_of(std::uint64_t id) const {
        const std::size_t index = static_cast<std::size_t>(id & 0xffffffffU) - 1;  // 0 wraps: no slot has it
        const bool current = index < slots_.size() && slots_[index].generation == id >> 32U;
        return current ? index : slots_.size();
    }

    [[nodiscard]] static std::shared_ptr<T> release(Slot& slot) {
        ++slot.generation;
        return std::move(slot.object);
    }

    mutable std::shared_mutex mutex_;
    std::vector<Slot> slots_;
};

}  // namespace camdir::sdk
