// The server's log: standard error, as text or as a JSON object a line.
#pragma once

#include "config/config.hpp"

namespace camdir::service {

// Makes spdlog's default logger.
void start_logging(const config::Log& config);
// Of a reloaded configuration the level takes effect.
void set_log_level(const config::Log& config);

}  // namespace camdir::service
