// A program that SIGINT and SIGTERM end in good order.
#pragma once

#include "base/signals.hpp"
#include "support/program.hpp"

namespace camdir::soak {

// As test::run_program(), but calls run(stop), which ends early when a stop is requested. Call it before
// there are other threads.
template <class Run>
int run_until_interrupted(CLI::App& app, int argc, char** argv, const Run& run) {
    return test::run_program(app, argc, argv, [&] {
        const Interruption interruption;
        return run(interruption.token());
    });
}

}  // namespace camdir::soak
