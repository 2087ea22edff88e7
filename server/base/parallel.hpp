// A parallel loop whose order the thread sanitizer sees.
#pragma once

#include <tbb/parallel_for.h>

#if defined(__SANITIZE_THREAD__)
#include <sanitizer/tsan_interface.h>
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

// body(i) for first <= i < last, on all cores, in any order; returns when all are done.
template <class Index, class Body>
void parallel_for(Index first, Index last, const Body& body) {
    detail::Order begin;
    detail::Order end;
    begin.before();
    tbb::parallel_for(first, last, [&](Index i) {
        begin.after();
        body(i);
        end.before();
    });
    end.after();
}

}  // namespace camdir
