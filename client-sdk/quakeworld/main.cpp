// qtv-publisher: publishes the matches of a QuakeWorld server to the camera director.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>

#include "base/file.hpp"
#include "base/signals.hpp"
#include "session.hpp"

namespace camdir::qtv {
namespace {

enum Exit { exit_done = 0, exit_failed = 1, exit_usage = 2 };

struct Options {
    std::string server;
    std::string source;
    std::string password_file;
    std::string match;
    camera_director::ContextOptions context;
    std::string security;
};

void add_options(CLI::App& app, Options& options) {
    app.add_option("server", options.server, "The QTV server, HOST:PORT: of mvdsv the port qtv_streamport")
        ->required();
    app.add_option("--source", options.source, "Which stream of a QTV proxy, as it names them");
    app.add_option("--password-file", options.password_file,
                   "File whose first line is the password (qtv_password), which is sent as plain text");
    app.add_option("--match", options.match, "Match id (default: quakeworld-HOST:PORT)");
    app.add_option("--domain", options.context.domain, "DDS domain")
        ->check(CLI::Range(0, 230))
        ->capture_default_str();
    app.add_option("--interface", options.context.network_interface, "Network interface or address")
        ->capture_default_str();
    app.add_option("--directors", options.context.directors, "Addresses of the directors")
        ->capture_default_str();
    app.add_option("--security", options.security, "Folder of an identity for DDS Security");
}

// The first line, without its end.
Result<std::string> read_password(const std::string& path) {
    const auto content = read_file(path);
    if (!content) return tl::unexpected(content.error());
    const std::string text(reinterpret_cast<const char*>(content->data()), content->size());
    std::string line = text.substr(0, text.find_first_of("\r\n"));
    if (line.empty()) return fail(path + ": the first line is empty, expected a password");
    return line;
}

Result<Subscription> subscription_of(const Options& options) {
    Subscription subscription;
    auto address = parse_address(options.server);
    if (!address) return tl::unexpected(address.error());
    subscription.server = std::move(*address);
    subscription.request.source = options.source;
    if (!options.password_file.empty()) {
        auto password = read_password(options.password_file);
        if (!password) return tl::unexpected(password.error());
        subscription.request.password = std::move(*password);
    }
    if (auto checked = check(subscription.request); !checked) return tl::unexpected(checked.error());
    subscription.match_id =
        options.match.empty() ? "quakeworld-" + text_of(subscription.server) : options.match;
    return subscription;
}

Result<void> run(Options options) {
    const auto subscription = subscription_of(options);
    if (!subscription) return tl::unexpected(subscription.error());
    const Interruption interruption;
    const StopEvent stop(interruption.token());
    if (!options.security.empty()) options.context.security = options.security;
    const auto context = camera_director::Context::open(options.context);
    if (!context) return fail(context.error().what());
    return publish_stream(*subscription, *context, stop);
}

int run_program(int argc, char** argv) {
    CLI::App app(
        "Publishes the matches of a QuakeWorld server, which it receives over QTV, to the camera director.",
        "qtv-publisher");
    app.set_version_flag("--version", CAMERA_DIRECTOR_VERSION);
    Options options;
    add_options(app, options);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        return app.exit(error) == 0 ? exit_done : exit_usage;
    }
    const auto done = run(std::move(options));
    if (done) return exit_done;
    std::cerr << "qtv-publisher: " << done.error().message << '\n';
    return exit_failed;
}

}  // namespace
}  // namespace camdir::qtv

int main(int argc, char** argv) {
    try {
        return camdir::qtv::run_program(argc, argv);
    } catch (const std::exception& error) {
        std::cerr << "qtv-publisher: " << error.what() << '\n';
        return 1;
    }
}
