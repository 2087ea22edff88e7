// The messages of one match that wait for its turn.
#pragma once

#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <string>
#include <variant>
#include <vector>

#include "config/config.hpp"
#include "director/counters.hpp"
#include "director/messages.hpp"
#include "director/pace.hpp"

namespace camdir::director {

struct ServerLost {};    // the game server's liveliness is lost
struct PosesMissing {};  // no poses for matches.silence_frames
struct MatchEnded {};
struct MatchRefused {
    std::string reason;
};
struct RequestEnded {
    std::string observer_id;
};
struct MapsChanged {};
struct DelayChanged {};  // see DelayBuffer::announce
struct Reconfigured {
    std::shared_ptr<const config::Config> config;
};
struct ViewRequest {
    std::shared_ptr<std::promise<MatchView>> answer;
};

using Message =
    std::variant<MatchInfo, ServerLost, PosesMissing, MatchEnded, MatchRefused, MatchEvent, ObserverRequest,
                 RequestEnded, MapsChanged, DelayChanged, Reconfigured, ViewRequest>;

// Keeps messages in their order of arrival, and only the newest pose frame, which waits until the pace lets
// one of its match be taken. Events and what observers ask for
// are bounded, and drops are counted. Messages about the match itself are never dropped, and neither are the
// ends of requests: observers who have left would keep their places. Each match has its own inbox.
// Thread-safe. Does not allocate once its buffers have grown.
class Inbox {
  public:
    // `max_observer_messages` bounds requests and view requests together. At most 256 events wait.
    Inbox(std::size_t max_observer_messages, const Pace& pace, MatchCounters& counters)
        : max_observer_messages_(max_observer_messages), pace_(pace), counters_(counters) {}

    void put(Message message);

    // Takes the frame and leaves other memory to its caller. Returns whether a frame is due, for which a
    // turn is wanted. Replaces one that no turn has taken. Its discontinuity flags are carried over to the
    // new frame of the same epoch, so that no respawn is lost: not every game server counts them (see
    // Continuity).
    bool put(PoseFrame& frame, std::int64_t received_ns);

    // Replaces an earlier one that no turn has taken.
    void put(const CameraFrame& shown);

    struct Content {
        std::vector<Message> messages;
        bool has_frame = false;
        PoseFrame frame;
        std::size_t messages_before_frame = 0;
        std::int64_t received_ns = 0;  // steady clock; of a delayed frame: when it was due
        bool has_shown = false;
        CameraFrame shown;  // by the director that leads the match
    };

    // Moves everything that waits into `content`, whose memory is reused; not a frame that is not due.
    void take(Content& content);

  private:
    // Why the waiting frame is dropped for this one.
    [[nodiscard]] Counter reason_to_replace(const PoseFrame& frame, std::int64_t received_ns) const;

    std::mutex mutex_;
    Content waiting_;
    bool is_due_ = false;                // the waiting frame
    std::uint32_t left_out_ = 0;         // frames since one was due
    std::size_t events_ = 0;             // in waiting_.messages
    std::size_t observer_messages_ = 0;  // in waiting_.messages
    const std::size_t max_observer_messages_;
    const Pace& pace_;
    MatchCounters& counters_;
};

}  // namespace camdir::director
