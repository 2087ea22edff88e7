// What the programs of benchmarks and soak runs have in common.
//
// Exit codes: 0 done, 1 something failed, 2 bad usage.
#pragma once

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

namespace camdir::test {

// Parses the arguments, then calls run(), which returns the exit code or throws. Prints help and errors.
template <class Run>
int run_program(CLI::App& app, int argc, char** argv, const Run& run) {
    try {
        app.parse(argc, argv);
        return run();
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? 0 : 2;
    } catch (const std::exception& error) {
        std::cerr << app.get_name() << ": " << error.what() << '\n';
        return 1;
    }
}

}  // namespace camdir::test
