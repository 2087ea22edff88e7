// The director: all matches, with their players, observers and shots.
#pragma once

#include <chrono>
#include <memory>
#include <span>
#include <string>

#include "config/config.hpp"
#include "director/map_library.hpp"
#include "director/messages.hpp"
#include "director/ports.hpp"
#include "director/view.hpp"

namespace camdir::director {

// Takes messages in, delays what game servers send (delay_buffer.hpp), runs the trackers on a pool of workers
// (one strand per match, the newest pose frame wins, of a burst the newest few in turn; delayed frames have a
// turn each while they are less than 0.1 s late, prepared shortly before they are due) and passes results to
// the publisher, and what observers may know to the audiences. All members are thread-safe. The Ingress calls
// never wait for a tracker. `maps`, `publisher` and the audiences must outlive the director.
class Director final : public Ingress {
  public:
    Director(const config::Config& config, const MapLibrary& maps, Publisher& publisher,
             Audiences audiences = {});
    ~Director() override;  // drains

    [[nodiscard]] bool admit(const std::string& match_id) override;
    [[nodiscard]] bool has_room() const override;
    bool receive(const MatchInfo& info) override;
    void server_lost(const std::string& match_id) override;
    void match_ended(const std::string& match_id) override;
    void receive(std::span<PoseArrival> arrivals) override;
    void receive(const std::string& match_id, const MatchEvent& event) override;
    void receive(const ObserverRequest& request) override;
    void request_ended(const std::string& match_id, const std::string& observer_id) override;
    void follow(const std::string& match_id, const CameraFrame& shown) override;
    [[nodiscard]] std::chrono::nanoseconds silence_limit(const MatchInfo& info) const override;
    [[nodiscard]] bool responsive(std::chrono::milliseconds limit) const override;

    // To be called after the map library changed: shots on its maps begin or end.
    void maps_changed();
    // Applies the profiles and `matches` of a reloaded configuration, and decides about all requests again.
    // `limits` keep their values of the start.
    void reconfigure(const config::Config& config);

    // Sums over all matches, including those that have been removed. Cheap.
    [[nodiscard]] Statistics statistics() const;
    // Of single matches that have a game server: the `max` that began first, by their begin. Cheap.
    [[nodiscard]] std::vector<MatchStatistics> match_statistics(std::size_t max) const;
    // All matches, each as of one instant. Waits for the workers, at most `timeout`; matches that have not
    // answered by then are marked.
    [[nodiscard]] View view(std::chrono::milliseconds timeout) const;
    // Waits until everything received before the call has been processed, except what is not due yet.
    void flush();
    // Processes what was received, except what is not due yet, then stops the workers. Later calls are
    // ignored, and nothing more is published.
    void drain();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace camdir::director
