// Parallel loops that the thread sanitizer understands.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>

#include <algorithm>
#else
#include <tbb/parallel_sort.h>
#endif

namespace camdir {
namespace detail {

// What precedes release() happens before what follows acquire(). oneTBB is not instrumented: without fences
// the sanitizer reports everything that a loop's body shares with its caller as a race.
class HappensBeforeFence {
  public:
#if defined(__SANITIZE_THREAD__)
    void release() {
        __tsan_release(this);
    }
    void acquire() {
        __tsan_acquire(this);
    }
#else
    void release() {}
    void acquire() {}
#endif
};

}  // namespace detail

// body(begin, end) for parts of first .. last of at least `grain`, on the threads of the arena, in any order;
// returns when all are done.
template <class Index, class Body>
void parallel_for_ranges(Index first, Index last, Index grain, const Body& body) {
    detail::HappensBeforeFence begin;
    detail::HappensBeforeFence end;
    begin.release();
    tbb::parallel_for(tbb::blocked_range<Index>(first, last, grain),
                      [&](const tbb::blocked_range<Index>& range) {
                          begin.acquire();
                          body(range.begin(), range.end());
                          end.release();
                      });
    end.acquire();
}

// body(i) for first <= i < last, likewise.
template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
    parallel_for_ranges(first, last, Index{1}, [&](Index begin, Index end) {
        for (Index i = begin; i != end; ++i)
            body(i);
    });
}

// The sanitizer cannot see how oneTBB passes parts of the sequence between threads.
template <class Iterator, class Compare>
void parallel_sort(Iterator first, Iterator last, const Compare& compare) {
#if defined(__SANITIZE_THREAD__)
    std::sort(first, last, compare);
#else
    tbb::parallel_sort(first, last, compare);
#endif
}

}  // namespace camdir
