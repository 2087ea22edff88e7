// Counts the allocations of the program by the unaligned operator new that links it.
#pragma once

namespace camdir::test {

// By operator new, since the program's start.
[[nodiscard]] long allocations();

}  // namespace camdir::test
