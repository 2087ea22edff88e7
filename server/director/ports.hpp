// The director's two connections: what the wire brings, and where results go.
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

// Called from the director's threads, for one match by one thread at a time; calls for different matches
// may overlap. Must not throw and must not call back into the director.
class Wire {
  public:
    virtual ~Wire() = default;
    virtual void publish(const std::string& match_id, const CameraFrame& frame) = 0;
    virtual void publish(const ObserverStatus& status) = 0;
    // The observer is gone: its status is withdrawn.
    virtual void withdraw(const std::string& match_id, const std::string& observer_id) = 0;
    // The match has neither game server nor observers: what was made for it can go. Nothing more is published
    // for it until it is received again, and a Receiver::receive of its MatchInfo that returns after this
    // call overrules it. Called while those wait, so it must not wait for them.
    virtual void forget(const std::string& match_id) = 0;
};

}  // namespace camdir::director
