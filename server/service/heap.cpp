#include "service/heap.hpp"

#include <malloc.h>

namespace camdir::service {
namespace {

// Given, it stays: otherwise the first receive buffer of Cyclone DDS that is freed, of 1 MB, raises it beyond
// those that follow.
constexpr int smallest_block_apart = 128 * 1024;

}  // namespace

void keep_heap_compact() {
    ::mallopt(M_ARENA_MAX, 1);
    ::mallopt(M_MMAP_THRESHOLD, smallest_block_apart);
}

void trim_heap() {
    ::malloc_trim(0);
}

}  // namespace camdir::service
