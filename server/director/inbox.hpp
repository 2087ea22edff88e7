// What came in for a match and waits for a worker.
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

namespace camdir::director {

struct ServerLost {};    // the game server's liveliness
struct PosesMissing {};  // for as long as makes a match silent
struct MatchEnded {};
struct MatchRefused {
    std::string reason;
};
struct RequestGone {
    std::string observer_id;
};
struct MapsChanged {};
struct Reconfigured {
    std::shared_ptr<const config::Config> config;
};
struct ViewWanted {
    std::shared_ptr<std::promise<MatchView>> answer;
};

using Control = std::variant<MatchInfo, ServerLost, PosesMissing, MatchEnded, MatchRefused, MatchEvent,
                             ObserverRequest, RequestGone, MapsChanged, Reconfigured, ViewWanted>;

// Messages in the order of their coming; of pose frames the newest only. Those that anybody may send in any
// number are bounded, and what is dropped is counted: a match's life does not depend on them. Thread-safe; a
// match has its own. Does not allocate once its buffers have grown.
class Inbox {
  public:
    // `most_of_observers`: of requests, their ends and questions. Of events at most 256 wait.
    Inbox(std::size_t most_of_observers, Counters& counters)
        : most_of_observers_(most_of_observers), counters_(counters) {}

    void put(Control control);

    // A frame that nobody took gives way; its discontinuities go over to the newer one, so that no respawn
    // is lost with it.
    void put(const PoseFrame& frame, std::int64_t received_ns);

    struct Content {
        std::vector<Control> controls;
        bool has_frame = false;
        PoseFrame frame;
        std::int64_t received_ns = 0;  // steady clock
    };

    // Swaps what waits into `content`, whose memory is used again.
    void take(Content& content);

  private:
    std::mutex mutex_;
    Content waiting_;
    PoseFrame superseded_;
    std::size_t events_ = 0;        // in waiting_.controls
    std::size_t of_observers_ = 0;  // in waiting_.controls
    const std::size_t most_of_observers_;
    Counters& counters_;
};

}  // namespace camdir::director
