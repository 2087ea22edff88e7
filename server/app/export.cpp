// camera-director export: the medial mesh with its free distances, for mesh viewers.
#include <memory>
#include <utility>

#include "app/commands.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "export/glb.hpp"
#include "export/ply.hpp"
#include "freespace/freespace.hpp"

namespace camdir::app {
namespace {

struct ExportOptions {
    std::string file, ply, glb;
};

void check_usage(const ExportOptions& options) {
    if (options.ply.empty() && options.glb.empty()) throw CLI::RequiredError("--ply or --glb");
    check_one_standard_output({{"--ply", options.ply}, {"--glb", options.glb}});
}

struct Files {
    Bytes ply, glb;  // empty where not wanted
};

Result<Files> make_files(const ExportOptions& options, const Interruption& interruption) {
    const ExitWhenInterrupted exits(interruption);
    const auto freespace = freespace::Freespace::open(options.file);
    if (!freespace) return tl::unexpected(freespace.error());
    Files files;
    if (!options.ply.empty()) files.ply = exports::to_ply(*freespace);
    if (options.glb.empty()) return files;
    auto glb = exports::to_glb(*freespace);
    if (!glb) return fail(options.glb + ": " + glb.error().message);
    files.glb = std::move(*glb);
    return files;
}

Result<void> export_mesh(const ExportOptions& options) {
    const Interruption interruption;
    if (auto writable = check_outputs({options.ply, options.glb}, {options.file}); !writable) return writable;
    const auto files = make_files(options, interruption);
    if (!files) return tl::unexpected(files.error());
    if (!options.ply.empty())
        if (auto written = write_file(options.ply, files->ply); !written) return written;
    return options.glb.empty() ? Result<void>{} : write_file(options.glb, files->glb);
}

}  // namespace

void add_export(CLI::App& root, Run& run) {
    const auto options = std::make_shared<ExportOptions>();
    CLI::App* command =
        root.add_subcommand("export", "Write the medial mesh of a baked map for mesh viewers.");
    command->add_option("FILE.vfs", options->file, "Baked map")->required();
    command->add_option("--ply", options->ply, "Binary PLY file to write; - is standard output");
    command->add_option("--glb", options->glb,
                        "Binary glTF 2.0 file to write; - is standard output: the mesh coloured by free "
                        "distance, the roadmap, spawn points; metres, y up");
    command->callback([options, &run] {
        check_usage(*options);
        run = [options] { return exit_code_of(export_mesh(*options)); };
    });
}

}  // namespace camdir::app
