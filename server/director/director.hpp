// The director: matches, their players and observers, and the shots between them.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "config/config.hpp"
#include "director/map_library.hpp"
#include "director/messages.hpp"
#include "director/ports.hpp"
#include "director/view.hpp"

namespace camdir::director {

// Receives from the wire, runs the trackers on a pool of workers (one strand a match, newest pose frame
// wins), publishes to the wire. All members are thread-safe. The receiving calls never wait for a tracker.
// `maps` and `wire` outlive the director.
class Director final : public Receiver {
  public:
    Director(const config::Config& config, const MapLibrary& maps, Wire& wire);
    ~Director() override;  // drains

    bool receive(const MatchInfo& info) override;
    void match_silent(const std::string& match_id) override;
    void match_over(const std::string& match_id) override;
    void receive(const std::string& match_id, const PoseFrame& frame) override;
    void receive(const std::string& match_id, const MatchEvent& event) override;
    void receive(const ObserverRequest& request) override;
    void request_gone(const std::string& match_id, const std::string& observer_id) override;
    [[nodiscard]] bool responsive(std::chrono::milliseconds limit) const override;

    // The library's maps changed: shots on them begin or end.
    void maps_changed();
    // Profiles and `matches` of a reloaded configuration take effect; requests are judged again.
    void reconfigure(const config::Config& config);

    // Counters over all matches, also those that are gone. Cheap.
    [[nodiscard]] Statistics statistics() const;
    // All matches, each as of one instant. Waits for the workers, at most `patience`; matches that did not
    // answer by then are marked.
    [[nodiscard]] View view(std::chrono::milliseconds patience) const;
    // Waits until all that was received before the call is handled.
    void settle();
    // Settles and stops the workers; what is received afterwards is ignored, and nothing is published.
    void drain();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace camdir::director
