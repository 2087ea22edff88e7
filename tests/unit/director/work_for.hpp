// Work of a known cost.
#pragma once

#include <chrono>

#include "director/clock.hpp"

namespace camdir::director {

// Until the calling thread has had so much processor time more.
inline void work_for(std::chrono::nanoseconds time) {
    for (const std::int64_t end = processor_ns() + time.count(); processor_ns() < end;) {
    }
}

}  // namespace camdir::director
