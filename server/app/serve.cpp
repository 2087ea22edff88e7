// camera-director serve: the server, or a check of its configuration.
#include <spdlog/spdlog.h>

#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "base/file.hpp"
#include "dds/protection.hpp"
#include "recording/archive.hpp"
#include "service/heap.hpp"
#include "service/logging.hpp"
#include "service/service.hpp"

namespace camdir::app {
namespace {

struct ServeOptions {
    std::string config;
    std::string shard;
    bool check = false;
    bool print_schema = false;
    bool print_reference = false;
};

int check(const config::Config& config, const std::string& file) {
    bool good = true;
    const auto complain = [&](const std::string& what) {
        good = false;
        std::cerr << "camera-director: " << file << ": " << what << '\n';
    };
    if (config.http.enabled) {
        const auto checked = http::Server::check(config.http);
        if (!checked) complain(checked.error().message);
    }
    if (const auto checked = dds::check_protection(config.dds); !checked) complain(checked.error().message);
    if (!config.recording.folder.empty())
        if (const auto checked = recording::Archive::check(config.recording.folder); !checked)
            complain("/recording/folder: " + checked.error().message);
    for (std::size_t i = 0; i < config.maps.size(); ++i) {
        const auto checked = maps::check_map(config.maps[i]);
        if (!checked) complain("/maps/" + std::to_string(i) + ": " + checked.error().message);
    }
    if (!good) return exit_failed;
    std::cerr << "camera-director: " << file << ": valid\n";
    return exit_done;
}

int serve(const ServeOptions& options) {
    if (options.print_schema || options.print_reference) {
        const auto written = write_file("-", options.print_schema ? config::schema() : config::reference());
        return written ? exit_done : report(written.error());
    }
    auto config = config::load(options.config, options.shard);
    if (!config) return report(config.error());
    if (options.check) return check(*config, options.config);

    service::keep_heap_compact();
    Signals signals;
    service::start_logging(config->log);
    auto opened = service::Service::open(options.config, options.shard, std::move(*config));
    if (!opened) {
        spdlog::critical("{}", opened.error().message);
        return exit_failed;
    }
    (*opened)->run(signals);
    return exit_done;
}

}  // namespace

void add_serve(CLI::App& root, Run& run) {
    auto options = std::make_shared<ServeOptions>();
    CLI::App& command =
        *root.add_subcommand("serve", "Serve cameras until SIGTERM; SIGHUP reloads maps and profiles.");
    auto* config =
        command.add_option("--config", options->config, "Configuration (JSON).")->type_name("FILE");
    command
        .add_option(
            "--shard", options->shard,
            "This director's shard, in place of the configuration's: directors of all shards can then "
            "have the same file.")
        ->type_name("NAME")
        ->needs(config);
    command
        .add_flag("--check", options->check,
                  "Validate the configuration and the maps, identity and folder of recordings that it names, "
                  "then exit.")
        ->needs(config);
    auto* print = command.add_option_group("print", "Print documentation of the configuration, then exit");
    print->add_flag("--print-schema", options->print_schema, "JSON Schema of the configuration.");
    print->add_flag("--print-reference", options->print_reference, "Reference of its keys, Markdown.");
    command.callback([&run, options] {
        if (options->config.empty() && !options->print_schema && !options->print_reference)
            throw CLI::RequiredError("--config, --print-schema or --print-reference");
        run = [options] { return serve(*options); };
    });
}

}  // namespace camdir::app
