// Where the director's results go: DDS in the server, memory in the tests.
#pragma once

#include <string>

#include "director/messages.hpp"

namespace camdir::director {

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
