// A value that is made when it is first asked for.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>

namespace camdir {

// Thread-safe: while one caller makes the value, the others wait. When making it fails with an exception, the
// next caller tries again.
template <class Value>
class Lazy {
  public:
    // `make` returns the value; every call must give the same.
    template <class Make>
    [[nodiscard]] const Value& get(const Make& make) const {
        if (const Value* made = made_.load(std::memory_order_acquire)) return *made;
        const std::lock_guard lock(making_);
        if (!value_) made_.store(&value_.emplace(make()), std::memory_order_release);
        return *value_;
    }

  private:
    mutable std::atomic<const Value*> made_ = nullptr;
    mutable std::mutex making_;
    mutable std::optional<Value> value_;
};

}  // namespace camdir
