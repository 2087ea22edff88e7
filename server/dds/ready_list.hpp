// What has arrived at which reader, for the one thread that takes it.
#pragma once

#include <dds/dds.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <vector>

#include "base/error.hpp"

namespace camdir::dds {

// Readers report to it through listeners. A DDS waitset would look at all readers of all matches each time
// that it waits.
class ReadyList {
  public:
    using Clock = std::chrono::steady_clock;

    // What a reader reports. It lives for as long as the reader is watched.
    class Source {
      private:
        friend class ReadyList;
        std::atomic<ReadyList*> list_{nullptr};
        bool is_ready_ = false;
    };

    ReadyList() = default;
    ReadyList(const ReadyList&) = delete;
    ReadyList& operator=(const ReadyList&) = delete;

    // `samples` becomes ready now and whenever samples arrive, and `writers`, if any, when writers come or
    // go. One thread at a time watches, unwatches and waits.
    [[nodiscard]] Result<void> watch(dds_entity_t reader, Source& samples, Source* writers = nullptr);
    // When this returns the reader reports no more, and its sources are not ready. It need not be watched.
    void unwatch(dds_entity_t reader, Source& samples, Source* writers = nullptr);

    // Thread-safe; does not allocate.
    void report(Source& source);
    // Ends a wait, this one or the next. Thread-safe.
    void wake();

    // Waits until something is ready, somebody wakes it or this time. Returns what is ready, in the order in
    // which it became so; valid until the next call.
    [[nodiscard]] const std::vector<Source*>& wait(Clock::time_point until);

  private:
    void add(Source& source);
    void remove(Source& source);

    std::mutex mutex_;
    std::condition_variable reported_;
    bool is_woken_ = false;
    std::size_t sources_ = 0;
    std::vector<Source*> ready_;  // has room for all sources
    std::vector<Source*> taken_;
};

}  // namespace camdir::dds
