// The options that say how a map's source is read.
#pragma once

#include <CLI/CLI.hpp>

#include "scene/read_options.hpp"

namespace camdir::app {

// Adds --metres-per-unit, --up, --origin and --seed; `options` must outlive the parsing.
void add_read_options(CLI::App& command, scene::ReadOptions& options);

}  // namespace camdir::app
