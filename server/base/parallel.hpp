// Parallel loops whose order the thread sanitizer sees.
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

// A point that one thread passes before another. oneTBB is not instrumented: without it the sanitizer takes
// everything that a loop's body shares with its caller for a race.
class Order {
  public:
#if defined(__SANITIZE_THREAD__)
    void before() {
        __tsan_release(this);
    }
    void after() {
        __tsan_acquire(this);
    }
#else
    void before() {}
    void after() {}
#endif
};

}  // namespace detail

// body(begin, end) for parts of first .. last of at least `grain`, on the threads of the arena, in any order;
// returns when all are done.
template <class Index, class Body>
void parallel_for_ranges(Index first, Index last, Index grain, const Body& body) {
    detail::Order begin;
    detail::Order end;
    begin.before();
    tbb::parallel_for(tbb::blocked_range<Index>(first, last, grain),
                      [&](const tbb::blocked_range<Index>& range) {
                          begin.after();
                          body(range.begin(), range.end());
                          end.before();
                      });
    end.after();
}

// body(i) for first <= i < last, likewise.
template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
    parallel_for_ranges(first, last, Index{1}, [&](Index begin, Index end) {
        for (Index i = begin; i != end; ++i)
            body(i);
    });
}

// oneTBB hands parts of the sequence from thread to thread where the sanitizer cannot follow.
template <class Iterator, class Compare>
void parallel_sort(Iterator first, Iterator last, const Compare& compare) {
#if defined(__SANITIZE_THREAD__)
    std::sort(first, last, compare);
#else
    tbb::parallel_sort(first, last, compare);
#endif
}

}  // namespace camdir
