// The director: matches, their players and observers, and the shots between them.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include "config/config.hpp"
#include "director/map_library.hpp"
#include "director/messages.hpp"
#include "director/view.hpp"
#include "director/wire.hpp"

namespace camdir::director {

// Receives from the wire, runs the trackers on a pool of workers (one strand a match, newest pose frame
// wins), publishes to the wire. All members are thread-safe. The receiving calls return at once and never
// wait for a tracker. `maps` and `wire` outlive the director.
class Director {
  public:
    Director(const config::Config& config, const MapLibrary& maps, Wire& wire);
    ~Director();  // drains

    // A match is new, changed or back. False: refused because limits.matches are running; nothing is
    // kept, and the next MatchInfo is another try.
    bool receive(const MatchInfo& info);
    // The game server's liveliness is lost: the cameras hold until poses come again.
    void match_silent(const std::string& match_id);
    // The game server said that the match is over: its shots end and its observers wait.
    void match_over(const std::string& match_id);
    // Frames of unknown matches and of other epochs are dropped and counted. Copies into the match's own
    // memory, so that the caller can fill the same PoseFrame again.
    void receive(const std::string& match_id, const PoseFrame& frame);
    void receive(const std::string& match_id, const MatchEvent& event);
    void receive(const ObserverRequest& request);  // new or changed; may come before its match
    void request_gone(const std::string& match_id, const std::string& observer_id);

    // The library's maps changed: shots on them begin or end.
    void maps_changed();
    // Profiles and `matches` of a reloaded configuration take effect; requests are judged again.
    void reconfigure(const config::Config& config);

    // Counters over all matches, also those that are gone. Cheap.
    [[nodiscard]] Statistics statistics() const;
    // All matches, each as of one instant. Waits for the workers, at most `patience`; matches that did not
    // answer by then are marked.
    [[nodiscard]] View view(std::chrono::milliseconds patience) const;
    // No worker is busy with one turn for longer than this.
    [[nodiscard]] bool responsive(std::chrono::milliseconds limit) const;

    // Waits until all that was received before the call is handled.
    void settle();
    // Settles and stops the workers; what is received afterwards is ignored, and nothing is published.
    void drain();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace camdir::director
