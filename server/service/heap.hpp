// The heap of a process that runs for months, while matches and peers come and go.
#pragma once

namespace camdir::service {

// One arena for all threads, and large blocks apart: what leaves goes back to the system, and does not stay
// as gaps between what Cyclone DDS keeps. To be called before the first other thread begins. The lock is no
// bottleneck: blocks of up to 1 kB come from the thread's own cache.
void keep_heap_compact();
// Gives back what is free now.
void trim_heap();

}  // namespace camdir::service
