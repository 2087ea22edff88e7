// The server's log on standard error: plain text, or one JSON object per line; at most 200 lines in a second,
// and none of up to 4 kB that would have to wait for whoever reads it.
#pragma once

#include "config/config.hpp"

namespace camdir::service {

// Creates spdlog's default logger.
void start_logging(const config::Log& config);
// Applies the level of a reloaded configuration.
void set_log_level(const config::Log& config);

}  // namespace camdir::service
