// What the wire brings: the director receives it in the server, a recorder in the tests of the wire.
#pragma once

#include <chrono>
#include <string>

#include "director/messages.hpp"

namespace camdir::director {

// The calls return at once. Thread-safe.
class Receiver {
  public:
    virtual ~Receiver() = default;
    // A match is new, changed or back. False: refused because limits.matches are running; nothing is
    // kept, and the next MatchInfo is another try.
    virtual bool receive(const MatchInfo& info) = 0;
    // The game server's liveliness is lost: the cameras hold until poses come again.
    virtual void match_silent(const std::string& match_id) = 0;
    // The game server said that the match is over: its shots end and its observers wait.
    virtual void match_over(const std::string& match_id) = 0;
    // Frames of unknown matches and of other epochs are dropped and counted. Copies into the match's own
    // memory, so that the caller can fill the same PoseFrame again.
    virtual void receive(const std::string& match_id, const PoseFrame& frame) = 0;
    virtual void receive(const std::string& match_id, const MatchEvent& event) = 0;
    virtual void receive(const ObserverRequest& request) = 0;  // new or changed; may come before its match
    virtual void request_gone(const std::string& match_id, const std::string& observer_id) = 0;
    // No worker is busy with one turn for longer than this: a director that is not gives way to its standby.
    [[nodiscard]] virtual bool responsive(std::chrono::milliseconds limit) const = 0;
};

}  // namespace camdir::director
