// camera-director play: serves a recording over HTTP, with the page that shows it.
#include <boost/asio/ip/address.hpp>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "base/utf8.hpp"
#include "http/server.hpp"
#include "http/status.hpp"
#include "recording/playback.hpp"
#include "scene/load.hpp"
#include "service/viewers.hpp"

namespace camdir::app {
namespace {

constexpr std::chrono::milliseconds step{50};

struct PlayOptions {
    std::string recording;
    std::string freespace;
    std::string map;
    std::string http = "127.0.0.1:9464";
    std::string token_file;
    bool live = false;
    double from = 0.0;
    double speed = 1.0;
};

// ADDRESS:PORT; the address may be [IPv6].
Result<config::Http> listening(const PlayOptions& options) {
    config::Http http;
    const std::size_t colon = options.http.rfind(':');
    const std::string port = colon == std::string::npos ? "" : options.http.substr(colon + 1);
    if (colon == 0 || port.empty() || port.size() > 5 ||
        port.find_first_not_of("0123456789") != std::string::npos || std::stoi(port) > 65535)
        return fail("--http " + options.http + ": expected ADDRESS:PORT");
    http.address = options.http.substr(0, colon);
    if (http.address.starts_with('[') && http.address.ends_with(']'))
        http.address = http.address.substr(1, http.address.size() - 2);
    http.port = std::stoi(port);
    http.token_file = options.token_file;
    return http;
}

// For a browser on this host.
std::string link_to(const std::string& address, std::uint16_t port) {
    boost::system::error_code error;
    const auto ip = boost::asio::ip::make_address(address, error);
    const bool is_ipv6 = !error && ip.is_v6();
    const std::string host = !error && ip.is_unspecified() ? "localhost"
                             : is_ipv6                     ? "[" + address + "]"
                                                           : address;
    return "http://" + host + ":" + std::to_string(port) + "/";
}

// The map of the recording's match, as far as the options name it.
class PlayedMap {
  public:
    // The page asks for the map by the name that the recording has.
    Result<void> load(const PlayOptions& options, const director::MatchInfo& match) {
        auto freespace = freespace::Freespace::open(options.freespace);
        if (!freespace) return tl::unexpected(freespace.error());
        if (match.map_hash != 0 && match.map_hash != freespace->metadata().source_hash)
            std::cerr << "camera-director: warning: " << options.freespace
                      << " was baked from another version of the map " << printable(match.map_name)
                      << " than the match was played on\n";
        if (match.map_hash == 0 && match.map_name != freespace->metadata().map_name)
            std::cerr << "camera-director: warning: the match was played on " << printable(match.map_name)
                      << ", " << options.freespace << " is of " << printable(freespace->metadata().map_name)
                      << ": its walls may not be those of the match\n";
        if (auto named = name_source(options, match.map_name, freespace->metadata()); !named) return named;
        library_.set_ready(match.map_name, std::move(*freespace));
        return {};
    }

    [[nodiscard]] live::Models& models() { return models_; }

  private:
    // It is read when a page asks for it: too late to tell whoever named it.
    Result<void> name_source(const PlayOptions& options, const std::string& map_name,
                             const freespace::Metadata& baked) {
        if (options.map.empty()) return {};
        const auto hash = scene::hash_source(options.map);
        if (!hash) return tl::unexpected(hash.error());
        if (*hash != baked.source_hash)
            std::cerr << "camera-director: warning: " << options.freespace
                      << " was baked from another file than " << options.map << ": no walls are shown\n";
        models_.set_source(map_name, options.map);
        return {};
    }

    director::MapLibrary library_;
    live::Models models_{library_};
};

http::Sources sources_of(const recording::Broadcast& broadcast, live::Models& models) {
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
    sources.live = [] { return http::live_page({}, true); };
    sources.model = [&models](const std::string& map, live::ModelKind kind) {
        return models.find(map, kind);
    };
    sources.join = [](const std::string& /*match_id*/, const std::shared_ptr<live::Viewer>& /*viewer*/) {
        return live::Relay::Admission::no_match;
    };
    return sources;
}

void announce(const PlayOptions& options, const recording::Playback& playback, const std::string& link) {
    const auto seconds = static_cast<long>(std::ceil(playback.length_s()));
    std::fprintf(stderr, "camera-director: %s: match %s on %s, %ld:%02ld: watch it, until Ctrl-C, at %s\n",
                 options.recording.c_str(), printable(playback.match().match_id).c_str(),
                 printable(playback.match().map_name).c_str(), seconds / 60, seconds % 60, link.c_str());
    if (options.freespace.empty())
        std::fprintf(
            stderr,
            "camera-director: the map is not shown: name its baked file, and with --map its source\n");
}

// What the match had come to so many seconds after it went on.
void show(double elapsed_s, recording::Playback& playback, recording::Broadcast& broadcast) {
    broadcast.set(playback.match().match_id, playback.at(elapsed_s));
}

// What the first request finds.
Result<void> show_first(const PlayOptions& options, recording::Playback& playback,
                        recording::Broadcast& broadcast) {
    if (!options.live) {
        broadcast.set(playback.match().match_id, playback.whole());
        return {};
    }
    if (auto begun = playback.go_on(options.from, options.speed); !begun) return begun;
    show(0.0, playback, broadcast);
    return {};
}

// Until the user stops it.
void serve(const PlayOptions& options, recording::Playback& playback, recording::Broadcast& broadcast,
           Signals& signals) {
    const auto begin = std::chrono::steady_clock::now();
    while (signals.wait(step) != Signal::stop) {
        const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - begin;
        if (options.live) show(elapsed.count(), playback, broadcast);
    }
}

Result<void> play(const PlayOptions& options) {
    Signals signals;
    const auto http = listening(options);
    if (!http) return tl::unexpected(http.error());
    if (auto usable = http::Server::check(*http); !usable) return usable;
    auto playback = recording::Playback::open(options.recording);
    if (!playback) return tl::unexpected(playback.error());
    PlayedMap map;
    if (!options.freespace.empty())
        if (auto loaded = map.load(options, playback->match()); !loaded) return loaded;
    recording::Broadcast broadcast;
    if (auto shown = show_first(options, *playback, broadcast); !shown) return shown;
    const auto server = http::Server::start(*http, sources_of(broadcast, map.models()));
    if (!server) return fail(server.error().message + "; --http takes another address or port");
    announce(options, *playback, link_to(http->address, (*server)->port()));
    serve(options, *playback, broadcast, signals);
    return {};
}

}  // namespace

void add_play(CLI::App& root, Run& run) {
    auto options = std::make_shared<PlayOptions>();
    CLI::App* command = root.add_subcommand(
        "play", "Show a recorded match in a browser, at the link that this prints, until Ctrl-C.");
    command->add_option("RECORDING", options->recording, "The recording's folder")->required();
    auto* freespace = command->add_option("FILE.vfs", options->freespace,
                                          "The match's map, baked, for the page: its free space");
    command->add_option("--map", options->map, "The map that it was baked from, for the page: its walls")
        ->type_name("MAP")
        ->needs(freespace);
    command->add_option("--http", options->http, "Address and port to listen on; port 0: any free one")
        ->type_name("ADDRESS:PORT")
        ->capture_default_str();
    command
        ->add_option("--token-file", options->token_file,
                     "The token that requests carry; needed where other hosts reach the address")
        ->type_name("FILE");
    auto* live = command->add_flag("--live", options->live,
                                   "As if the match went on now: fragments follow each other, as a running "
                                   "director broadcasts them");
    command->add_option("--from", options->from, "Seconds after the recording's begin at which it goes on")
        ->capture_default_str()
        ->check(number_between(0.0, 1e9))
        ->needs(live);
    command->add_option("--speed", options->speed, "How fast fragments follow each other")
        ->capture_default_str()
        ->check(number_between(0.01, 1000.0))
        ->needs(live);
    command->callback([options, &run] { run = [options] { return exit_code_of(play(*options)); }; });
}

}  // namespace camdir::app
