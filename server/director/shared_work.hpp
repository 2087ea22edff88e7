// Work that one worker has begun and others that are idle help to finish.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>

namespace camdir::director {

class SharedWork {
  public:
    // Does one item. Calls with the same `lane` come one after another. Must not throw.
    using Item = std::function<void(std::size_t lane, std::size_t item)>;

    // The owner's: begin(), then finish() before anything else. From begin() on others may help; finish()
    // does what they leave, on lane 0, and returns when every item from 0 to `count` - 1 is done.
    void begin(std::size_t count, const Item& item);
    void finish();

    // Does items while any are left. Thread-safe, with one thread at a time on a lane.
    void help(std::size_t lane);

  private:
    const Item* item_ = nullptr;          // valid while an item is left or not done
    std::atomic<std::size_t> left_{0};    // items that nobody has taken
    std::atomic<std::size_t> undone_{0};  // items that are not done
};

}  // namespace camdir::director
