#include "director/shared_work.hpp"

#include <thread>

namespace camdir::director {

void SharedWork::begin(std::size_t count, const Item& item) {
    item_ = &item;
    undone_.store(count, std::memory_order_relaxed);
    left_.store(count, std::memory_order_release);
}

void SharedWork::finish() {
    help(0);
    while (undone_.load(std::memory_order_acquire) != 0)
        std::this_thread::yield();  // for at most the last item of each helper
}

void SharedWork::help(std::size_t lane) {
    std::size_t left = left_.load(std::memory_order_acquire);
    while (left != 0) {
        if (!left_.compare_exchange_weak(left, left - 1, std::memory_order_acq_rel,
                                         std::memory_order_acquire))
            continue;
        (*item_)(lane, left - 1);
        undone_.fetch_sub(1, std::memory_order_release);
        left = left_.load(std::memory_order_acquire);
    }
}

}  // namespace camdir::director
