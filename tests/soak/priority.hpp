// Who gets the processor of a machine that stands for several.
#pragma once

#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <stdexcept>

namespace camdir::soak {

// Lets the directors and those whom they serve have the processor first: of what this process does they are
// to feel the messages, not the work of making them. Threads inherit it: call it before there are others.
inline void stand_for_another_machine() {
    errno = 0;  // a priority may be -1
    if (::nice(10) == -1 && errno != 0) throw std::runtime_error("cannot lower the priority");
}

// The same for one of a hundred processes, which with a lower priority alone would together have most of the
// processor: they run when nobody else does.
inline void stand_for_one_of_many_machines() {
    const sched_param priority{};
    if (::sched_setscheduler(0, SCHED_IDLE, &priority) != 0)
        throw std::runtime_error("cannot leave the processor to others");
}

}  // namespace camdir::soak
