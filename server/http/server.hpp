// The operator's pages: GET /healthz, /readyz, /metrics, /status.
#pragma once

#include <prometheus/metric_family.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "config/config.hpp"

namespace camdir::http {

// What the pages show. Called from the server's threads.
struct Sources {
    std::function<bool()> healthy;                      // false: a restart would help
    std::function<std::vector<std::string>()> missing;  // what readiness still waits for; empty: ready
    std::function<std::vector<prometheus::MetricFamily>()> metrics;
    std::function<std::string()> status;  // JSON
};

// Serves until it is destroyed, with a fixed number of threads; more than a few connections wait in the
// kernel. Requests that have a body, are larger than 16 KB or take longer than 3 s including the answer are
// cut off.
class Server {
  public:
    // Fails when the address cannot be listened on.
    [[nodiscard]] static Result<std::unique_ptr<Server>> start(const config::Http& config, Sources sources);
    ~Server();

    [[nodiscard]] std::uint16_t port() const;

  private:
    struct Listener;
    explicit Server(std::unique_ptr<Listener> listener);
    std::unique_ptr<Listener> listener_;
};

}  // namespace camdir::http
