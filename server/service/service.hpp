// The server: what `camera-director serve` runs.
#pragma once

#include <atomic>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/signals.hpp"
#include "config/config.hpp"
#include "dds/gateway.hpp"
#include "director/director.hpp"
#include "http/kept_answer.hpp"
#include "http/server.hpp"
#include "live/models.hpp"
#include "live/relay.hpp"
#include "maps/loader.hpp"
#include "recording/recorder.hpp"

namespace camdir::service {

class Service {
  public:
    // Joins the DDS domain before anything that opens many file descriptors (DDS uses select), then listens
    // for HTTP. `file` and `shard`, of which config::load() has made `config`, are loaded again on SIGHUP.
    [[nodiscard]] static Result<std::unique_ptr<Service>> open(std::filesystem::path file, std::string shard,
                                                               config::Config config);

    // Loads the maps, receives and serves until SIGTERM or SIGINT; then drains.
    void run(Signals& signals);

  private:
    Service(std::filesystem::path file, std::string shard, config::Config config,
            std::unique_ptr<dds::Gateway> gateway);

    [[nodiscard]] maps::LoaderSink map_sink();
    [[nodiscard]] director::Audiences audiences();
    [[nodiscard]] http::Sources sources();
    // False: a thread has hung, and a restart would help. Of HTTP's it is not known here: they ask.
    [[nodiscard]] bool healthy() const;
    [[nodiscard]] std::vector<std::string> missing() const;
    void watch(bool& settled);
    // "serving 2 of 3 maps", or what is missing: for systemd.
    [[nodiscard]] std::string summary(const std::vector<std::string>& missing) const;
    // The configuration, after which nothing of a reload can fail, with the token of HTTP in effect.
    [[nodiscard]] Result<config::Config> load_again();
    void reload();
    void drain();

    const std::filesystem::path file_;
    const std::string shard_;
    config::Config config_;  // in effect
    std::atomic<bool> draining_{false};
    std::atomic<bool> refused_{false};  // the file, at the last reload
    std::atomic<std::size_t> keys_for_restart_{0};
    bool started_ = false;
    std::unique_ptr<dds::Gateway> gateway_;
    director::MapLibrary maps_;
    std::unique_ptr<recording::Recorder> recorder_;  // null when off
    live::Models models_;
    live::Relay relay_;
    director::Director director_;
    maps::Loader loader_;
    http::KeptAnswer live_list_;
    std::unique_ptr<http::Server> http_;  // null when off
};

}  // namespace camdir::service
