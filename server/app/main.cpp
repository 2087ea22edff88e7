// camera-director: dispatches to the subcommands.
#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "app/commands.hpp"

namespace camdir::app {
namespace {

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
    try {
        root.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return root.exit(error) == 0 ? exit_done : exit_usage;
    }
    return run();
}

}  // namespace
}  // namespace camdir::app

int main(int argc, char** argv) {
    try {
        return camdir::app::run_command(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "camera-director: " << error.what() << '\n';
        return camdir::app::exit_failed;
    }
}
