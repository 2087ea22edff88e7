// camera-director play: serves a recording over HTTP like a match that goes on.
#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "http/server.hpp"
#include "http/status.hpp"
#include "recording/playback.hpp"
#include "service/viewers.hpp"

namespace camdir::app {
namespace {

constexpr std::chrono::milliseconds step{50};

struct PlayOptions {
    std::string recording;
    std::string http = "127.0.0.1:9464";
    std::string token_file;
    double from = 0.0;
    double speed = 1.0;
};

// ADDRESS:PORT; the address may be [IPv6].
Result<config::Http> listening(const PlayOptions& options) {
    config::Http http;
    const std::size_t colon = options.http.rfind(':');
    const std::string port = colon == std::string::npos ? "" : options.http.substr(colon + 1);
    if (port.empty() || port.size() > 5 || port.find_first_not_of("0123456789") != std::string::npos ||
        std::stoi(port) > 65535)
        return fail("--http " + options.http + ": expected ADDRESS:PORT");
    http.address = options.http.substr(0, colon);
    if (http.address.starts_with('[') && http.address.ends_with(']'))
        http.address = http.address.substr(1, http.address.size() - 2);
    http.port = std::stoi(port);
    http.token_file = options.token_file;
    return http;
}

http::Sources sources_of(const recording::Broadcast& broadcast) {
    http::Sources sources;
    sources.healthy = [] { return true; };
    sources.missing = [] { return std::vector<std::string>{}; };
    sources.metrics = [] { return std::vector<prometheus::MetricFamily>{}; };
    sources.status = [] { return std::string("{}\n"); };
    sources.hand_over = [] { return http::HandOver{}; };
    sources.broadcast = [&broadcast](std::string_view path) {
        return service::viewers_resource(broadcast, path);
    };
    // A recording is fetched. Nothing of it is streamed live.
    sources.live = [] { return http::live_page({}); };
    sources.model = [](const std::string& /*map*/, live::ModelKind /*kind*/) {
        return live::Models::Answer();
    };
    sources.join = [](const std::string& /*match_id*/, const std::shared_ptr<live::Viewer>& /*viewer*/) {
        return live::Relay::Admission::no_match;
    };
    return sources;
}

Result<void> play(const PlayOptions& options) {
    service::Signals signals;
    const auto http = listening(options);
    if (!http) return tl::unexpected(http.error());
    auto playback = recording::Playback::open(options.recording, options.from, options.speed);
    if (!playback) return tl::unexpected(playback.error());
    recording::Broadcast broadcast;
    const auto server = http::Server::start(*http, sources_of(broadcast));
    if (!server) return tl::unexpected(server.error());
    std::cerr << "camera-director: " << options.recording << ": match " << playback->match_id() << " on port "
              << (*server)->port() << ", /broadcast; until Ctrl-C\n";
    const auto begin = std::chrono::steady_clock::now();
    do {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
        auto channel = playback->at(elapsed.count());
        if (!channel) return tl::unexpected(channel.error());
        broadcast.set(playback->match_id(), std::move(*channel));
    } while (signals.wait(step) != service::Signal::stop);
    return {};
}

}  // namespace

void add_play(CLI::App& root, Run& run) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App* command =
        root.add_subcommand("play", "Serve a recording over HTTP like a match that goes on, until Ctrl-C.");
    command->add_option("RECORDING", options->recording, "The recording's folder")->required();
    command->add_option("--http", options->http, "Address and port to listen on; port 0: any free one")
        ->type_name("ADDRESS:PORT")
        ->capture_default_str();
    command
        ->add_option("--token-file", options->token_file,
                     "The token that requests carry; needed where other hosts reach the address")
        ->type_name("FILE");
    command->add_option("--from", options->from, "Seconds after the recording's begin")
        ->capture_default_str()
        ->check(CLI::Range(0.0, 1e9));
    command->add_option("--speed", options->speed, "How fast fragments follow each other")
        ->capture_default_str()
        ->check(CLI::Range(0.01, 1000.0));
    command->callback([options, &run] { run = [options] { return exit_code_of(play(*options)); }; });
}

}  // namespace camdir::app
