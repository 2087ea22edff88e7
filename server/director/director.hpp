// The director: matches, their players and observers, and the shots between them.
#pragma once

#include <memory>
#include <string>

#include "config/config.hpp"
#include "director/messages.hpp"
#include "director/wire.hpp"

namespace camdir::director {

class MapLibrary;

// Receives from the wire, runs the trackers on a pool of workers (one strand a match, newest pose frame
// wins), publishes to the wire. The receiving calls are thread-safe, return at once and never block on
// a tracker.
class Director {
  public:
    Director(const config::Config& config, MapLibrary& maps, Wire& wire);
    ~Director();  // drains

    void receive(MatchInfo info);                    // new, changed or back
    void match_silent(const std::string& match_id);  // its game server's liveliness is lost
    void receive(const std::string& match_id, PoseFrame frame);
    void receive(const std::string& match_id, const MatchEvent& event);
    void receive(ObserverRequest request);  // new or changed
    void request_gone(const std::string& match_id, const std::string& observer_id);

    // Finishes what is queued and stops the workers; nothing is published afterwards.
    void drain();

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace camdir::director
