// The heap of a process that runs for months, while matches and peers come and go.
#pragma once

namespace camdir::service {

// One arena for all threads: each would have gaps of its own between what Cyclone DDS keeps
// (README.md, Memory over months). To be called before the first other thread begins. Its lock is
// rarely waited for: small blocks come from each thread's own cache.
void keep_heap_compact();
// Gives back what is free now.
void trim_heap();

}  // namespace camdir::service
