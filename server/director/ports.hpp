// What connects the director with the outside: the ingress that takes messages in, the publisher that takes
// results out, audiences that look on. DDS implements the publisher and calls the ingress; tests use memory.
#pragma once

#include <chrono>
#include <span>
#include <string>
#include <vector>

#include "director/messages.hpp"

namespace camdir::director {

// All calls return at once, but for poses. Thread-safe.
class Ingress {
  public:
    virtual ~Ingress() = default;
    // To be asked before the first MatchInfo of a match is passed on. Returns false when limits.matches are
    // running already: nothing is kept, and there may be another attempt when there is room.
    [[nodiscard]] virtual bool admit(const std::string& match_id) = 0;
    // Whether limits.matches lets another match in.
    [[nodiscard]] virtual bool has_room() const = 0;
    // A match is new, has changed or is back. The director may publish before this returns. Returns false as
    // admit() does.
    virtual bool receive(const MatchInfo& info) = 0;
    // The game server's liveliness is lost: the cameras hold until poses arrive again.
    virtual void server_lost(const std::string& match_id) = 0;
    // The game server ended the match: its shots end, its observers wait for another game server.
    virtual void match_ended(const std::string& match_id) = 0;
    // Of any matches, as they have arrived together. What is short work may be done before this returns, on
    // the calling thread. Frames of unknown matches and of other epochs are dropped and counted. The frames
    // are taken; their memory, or other, is left to the caller to be refilled.
    virtual void receive(std::span<PoseArrival> arrivals) = 0;
    virtual void receive(const std::string& match_id, const MatchEvent& event) = 0;
    virtual void receive(const ObserverRequest& request) = 0;  // new or changed; may precede its match
    // The observer withdrew its request, or its liveliness is lost.
    virtual void request_ended(const std::string& match_id, const std::string& observer_id) = 0;
    // What the director that leads the match has published, while this one stands by: its shots go on from
    // there.
    virtual void follow(const std::string& match_id, const CameraFrame& shown) = 0;
    // Without poses for this long the match is silent.
    [[nodiscard]] virtual std::chrono::nanoseconds silence_limit(const MatchInfo& info) const = 0;
    // False when a thread has been busy with one turn, or with the housekeeping, for longer than `limit`, or
    // no worker was free for one: such a director must give way to its standby.
    [[nodiscard]] virtual bool responsive(std::chrono::milliseconds limit) const = 0;
};

// Called from the director's threads and from those that bring it poses: by one thread at a time for one
// match, concurrently for different matches. Must not throw and must not call back into the director.
class Publisher {
  public:
    virtual ~Publisher() = default;
    // The match as it is shown from now on. Precedes the cameras of its epoch.
    virtual void publish(const MatchInfo& shown) = 0;
    // The match has been shown to its end.
    virtual void end(const std::string& match_id) = 0;
    virtual void publish(const std::string& match_id, const CameraFrame& frame) = 0;
    // Written soon, after the next frame. Returns false when there is no room for it: to be tried again
    // later.
    virtual bool publish(const ObserverStatus& status) = 0;
    // The observer's request has ended: its status is disposed, likewise soon.
    virtual void withdraw(const std::string& match_id, const std::string& observer_id) = 0;
    // The match has neither a game server nor observers: its endpoints can be closed. Nothing more is
    // published for it until its MatchInfo is received again; an Ingress::receive of that MatchInfo which
    // returns after this call takes precedence. Must not wait for such a call: it waits for this one.
    virtual void forget(const std::string& match_id) = 0;
    // The game server has been gone for too long: the match has ended for its observers, who wait on. Its
    // MatchInfo is to be received again when that game server sends again. May be called while another thread
    // publishes for the match. Must not wait, likewise.
    virtual void give_up(const std::string& match_id) = 0;
};

// Sees of every match what its observers may know, and nothing earlier: game servers' messages after the
// match's delay, in the order in which they take effect. The same matches in a new director with the same
// maps and configuration give the same cameras.
//
// A director that stands by shows its matches as well: its state is the leader's. Called as a Publisher; a
// call must also return at once, for cameras wait for it.
class Audience {
  public:
    virtual ~Audience() = default;
    // The match as Publisher::publish has it: new, changed, or of another epoch.
    virtual void show(const MatchInfo& shown) = 0;
    // Of every pose frame that is processed. Players that came back or were moved while no frame was
    // processed have pose_discontinuity. `cameras` are those of this frame: none where nobody has asked for
    // one, or the map is missing.
    virtual void show(const std::string& match_id, const PoseFrame& poses, const CameraFrame& cameras) = 0;
    virtual void show(const std::string& match_id, const MatchEvent& event) = 0;
    // A request is new or has changed, be it refused or not. Requests may precede their match and outlive it:
    // each ends by itself.
    virtual void request(const ObserverRequest& request) = 0;
    virtual void request_ended(const std::string& match_id, const std::string& observer_id) = 0;
    // The match has been shown to its end.
    virtual void end(const std::string& match_id) = 0;
};

using Audiences = std::vector<Audience*>;

}  // namespace camdir::director
