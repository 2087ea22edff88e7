// The subcommands of camera-director, one a file of this folder.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "base/error.hpp"
#include "service/interruption.hpp"

namespace camdir::app {

// Exit codes of every subcommand.
inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_usage = 2;
using service::exit_interrupted;  // 130

// Each adds its subcommand to `root`; when the user chose it, `run` is set to what does the work and
// returns the exit code.
using Run = std::function<int()>;
void add_serve(CLI::App& root, Run& run);
void add_bake(CLI::App& root, Run& run);
void add_inspect(CLI::App& root, Run& run);
void add_verify(CLI::App& root, Run& run);
void add_export(CLI::App& root, Run& run);
void add_evaluate(CLI::App& root, Run& run);
void add_render(CLI::App& root, Run& run);

// Prints the error to standard error as `camera-director: message`; returns the exit code that it stands for.
[[nodiscard]] int report(const Error& error);

}  // namespace camdir::app
