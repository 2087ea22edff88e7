#include "service/heap.hpp"

#include <malloc.h>

namespace camdir::service {

void keep_heap_compact() {
    ::mallopt(M_ARENA_MAX, 1);
}

void trim_heap() {
    ::malloc_trim(0);
}

}  // namespace camdir::service
