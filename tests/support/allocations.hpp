// Counts every allocation of the program that links it.
#pragma once

namespace camdir::test {

// By operator new, since the program's start.
[[nodiscard]] long allocations();

}  // namespace camdir::test
