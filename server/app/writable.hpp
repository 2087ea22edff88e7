// Output files, before the work that fills them.
#pragma once

#include <string>

#include "base/error.hpp"

namespace camdir::app {

// Whether `file` can be made in its folder; empty and - always can. Asked before long work, not after it.
[[nodiscard]] Result<void> check_writable(const std::string& file);

}  // namespace camdir::app
