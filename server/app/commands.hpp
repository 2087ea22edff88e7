// The subcommands of camera-director, one a file of this folder, and what they share.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <initializer_list>
#include <stop_token>
#include <string>
#include <utility>

#include "app/number_between.hpp"
#include "base/error.hpp"
#include "base/signals.hpp"

namespace camdir::app {

// Exit codes of every subcommand.
inline constexpr int exit_done = 0;
inline constexpr int exit_failed = 1;
inline constexpr int exit_usage = 2;

// Each adds its subcommand to `root`; when the user chose it, `run` is set to what does the work and
// returns the exit code.
using Run = std::function<int()>;
void add_serve(CLI::App& root, Run& run);
void add_bake(CLI::App& root, Run& run);
void add_inspect(CLI::App& root, Run& run);
void add_verify(CLI::App& root, Run& run);
void add_export(CLI::App& root, Run& run);
void add_evaluate(CLI::App& root, Run& run);
void add_direct(CLI::App& root, Run& run);
void add_play(CLI::App& root, Run& run);
void add_render(CLI::App& root, Run& run);

// Prints the error to standard error as `camera-director: message`; returns the exit code that it stands for.
[[nodiscard]] int report(const Error& error);

// While it lives, an interruption ends the process at once, with a message and exit_interrupted: around work
// that takes no stop token and leaves nothing behind.
class ExitWhenInterrupted {
  public:
    explicit ExitWhenInterrupted(const Interruption& interruption) : callback_(interruption.token(), leave) {}

  private:
    static void leave();

    std::stop_callback<void (*)()> callback_;
};

// exit_done, or reports the error.
[[nodiscard]] int exit_code_of(const Result<void>& done);

// Whether each file can be created in its folder, is named once and is none of the inputs, which may be
// members of archives; an empty name and "-" always can. For use before long work.
[[nodiscard]] Result<void> check_outputs(std::initializer_list<std::string> files,
                                         std::initializer_list<std::string> inputs);

// Options and the files that they name. Throws CLI::ValidationError when more than one file is "-".
void check_one_standard_output(std::initializer_list<std::pair<const char*, std::string>> outputs);

}  // namespace camdir::app
