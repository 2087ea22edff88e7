// The operator's pages: GET /-/healthy, /-/ready, /metrics, /status; POST /hand-over. What viewers fetch:
// GET /broadcast and below; the window: /, /live, /map.
#pragma once

#include <prometheus/metric_family.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "config/config.hpp"
#include "live/models.hpp"
#include "live/relay.hpp"

namespace camdir::http {

struct HandOver {
    std::size_t led = 0;   // matches that this director led
    std::size_t kept = 0;  // of these, for want of another that could serve them
};

// A resource that caches may keep.
struct Resource {
    std::string type;
    std::string tag;  // like that of no other; empty: it changes within a second or so
    std::string content;
};

// What the pages show and do. Called from the server's threads.
struct Sources {
    // Wait for nothing: they are called between the reads and writes of all connections.
    std::function<bool()> healthy;                      // false: a restart would help
    std::function<std::vector<std::string>()> missing;  // what readiness still waits for; empty: ready
    // May take long: at most two at a time are called.
    std::function<std::vector<prometheus::MetricFamily>()> metrics;  // to which the server adds its own
    std::function<std::string()> status;                             // JSON
    std::function<HandOver()> hand_over;
    // Of a path below /broadcast, which is "" or begins with /; nullopt: there is none.
    std::function<std::optional<Resource>(std::string_view path)> broadcast;
    std::function<std::string()> live;  // JSON: what there is to watch
    std::function<live::Models::Answer(const std::string& map, live::ModelKind kind)> model;
    // Waits for nothing. Messages reach the viewer from then on.
    std::function<live::Relay::Admission(const std::string& match_id,
                                         const std::shared_ptr<live::Viewer>& viewer)>
        join;
};

// Connections that exceed a time are closed.
struct Limits {
    // At once; fewer when the process may not open so many files. One more closes the one whose last request
    // or answer began longest ago.
    std::size_t connections = 2048;
    // Answers of pages that may take long, made or sent at once; one more is 503.
    std::size_t slow_pages = 64;
    std::chrono::milliseconds idle{60'000};     // until a request begins
    std::chrono::milliseconds request{20'000};  // from a request's first byte to its last
    std::chrono::milliseconds answer{
        20'000};  // until the client has taken some of the answer: all of it, with a second for each 64 kB
};

// Serves until it is destroyed, with three threads: one for all connections and the prompt pages, two that
// make the others. A header above 16 kB is answered with 431, a body above 4 kB with 413.
class Server {
  public:
    // Fails when the address cannot be listened on, or as Access::load or Files::read.
    [[nodiscard]] static Result<std::unique_ptr<Server>> start(const config::Http& config, Sources sources,
                                                               const Limits& limits = {});
    // What of start can be checked without listening.
    [[nodiscard]] static Result<void> check(const config::Http& config);
    ~Server();

    // Reads the token file again. When that fails, the token stays as it was.
    [[nodiscard]] Result<void> reload();

    [[nodiscard]] std::uint16_t port() const;

    // False when the thread of the connections is late by more than `limit`: it has hung. Thread-safe.
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const;

  private:
    struct Listener;
    explicit Server(std::unique_ptr<Listener> listener);
    std::unique_ptr<Listener> listener_;
};

}  // namespace camdir::http
