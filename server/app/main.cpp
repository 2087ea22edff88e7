// camera-director: dispatches to the subcommands.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <system_error>
#include <vector>

#include "app/commands.hpp"
#include "config/spelling.hpp"

namespace camdir::app {
namespace {

std::vector<std::string> commands_of(const CLI::App& root) {
    std::vector<std::string> names;
    for (const CLI::App* command : root.get_subcommands({}))
        names.push_back(command->get_name());
    return names;
}

int report_unknown(const std::string& command, const std::vector<std::string>& known) {
    const std::string nearest = config::nearest_spelling(command, known);
    std::cerr << "camera-director: unknown command '" << command << "'";
    if (!nearest.empty()) std::cerr << ", did you mean '" << nearest << "'?";
    std::cerr << "\nExpected one of:";
    for (const std::string& name : known)
        std::cerr << ' ' << name;
    std::cerr << "; `camera-director --help` says what they do.\n";
    return exit_usage;
}

int run_command(int argc, char** argv) {
    CLI::App root("Automatic cameras for spectators of live 3D games.", "camera-director");
    root.set_version_flag("--version", CAMERA_DIRECTOR_VERSION);
    root.require_subcommand(1);
    Run run;
    add_bake(root, run);
    add_inspect(root, run);
    add_export(root, run);
    add_verify(root, run);
    add_evaluate(root, run);
    add_direct(root, run);
    add_render(root, run);
    add_serve(root, run);
    add_play(root, run);
    const auto known = commands_of(root);
    if (argc > 1 && argv[1][0] != '-' && std::ranges::find(known, argv[1]) == known.end())
        return report_unknown(argv[1], known);
    try {
        root.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return root.exit(error) == 0 ? exit_done : exit_usage;
    }
    return run();
}

// In the words of the user, of the exception that is being handled.
void report_exception() {
    std::cerr << "camera-director: ";
    try {
        throw;
    } catch (const std::bad_alloc&) {
        std::cerr << "out of memory\n";
    } catch (const std::system_error& error) {
        const bool limited = error.code() == std::errc::resource_unavailable_try_again;
        std::cerr << (limited ? "cannot start a thread: " : "") << error.what() << '\n';
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
    } catch (...) {
        std::cerr << "ended by an unknown exception\n";
    }
}

// An exception that leaves a thread, as where memory runs out while it serves.
[[noreturn]] void report_and_abort() {
    if (std::current_exception())
        report_exception();
    else
        std::cerr << "camera-director: terminated without an exception\n";
    std::abort();
}

}  // namespace
}  // namespace camdir::app

int main(int argc, char** argv) {
    std::set_terminate(camdir::app::report_and_abort);
    try {
        return camdir::app::run_command(argc, argv);
    } catch (...) {
        camdir::app::report_exception();
        return camdir::app::exit_failed;
    }
}
