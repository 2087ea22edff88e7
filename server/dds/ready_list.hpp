// What has arrived at which reader, for the one thread that takes it.
#pragma once

#include <dds/dds.h>

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

    // What a reader reports. It must be forgotten before it is destroyed.
    class Source {
      private:
        friend class ReadyList;
        ReadyList* list_ = nullptr;
        bool is_ready_ = false;
    };

    ReadyList() = default;
    ReadyList(const ReadyList&) = delete;
    ReadyList& operator=(const ReadyList&) = delete;

    // `samples` becomes ready now and whenever samples arrive, and `writers`, if any, when writers come or
    // go. One thread at a time watches, forgets and waits.
    [[nodiscard]] Result<void> watch(dds_entity_t reader, Source& samples, Source* writers = nullptr);
    // The reader reports no more when this returns.
    static void unwatch(dds_entity_t reader);
    // It is ready no more. Precondition: no reader reports it.
    void forget(Source& source);

    // Thread-safe; does not allocate.
    void report(Source& source);
    // Ends a wait, this one or the next. Thread-safe.
    void wake();

    // Waits until something is ready, somebody wakes it or this time. Returns what is ready, in the order in
    // which it became so; valid until the next call.
    [[nodiscard]] const std::vector<Source*>& wait(Clock::time_point until);

  private:
    void add(Source& source);

    std::mutex mutex_;
    std::condition_variable reported_;
    bool is_woken_ = false;
    std::size_t sources_ = 0;
    std::vector<Source*> ready_;  // has room for all sources
    std::vector<Source*> taken_;
};

}  // namespace camdir::dds
