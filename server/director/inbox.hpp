// The messages of one match that wait for its turn.
#pragma once

#include <array>
#include <cstdint>
#include <future>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "config/config.hpp"
#include "director/counters.hpp"
#include "director/messages.hpp"
#include "director/pace.hpp"
#include "director/request_queue.hpp"

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
// one of its match be taken; of a burst, and of a hiccup of punctual workers, the newest few. Whatever others
// send, what waits is bounded. Of each observer, of an epoch's descriptions with one map, of losses of the
// game server, and of refusals only the newest waits. Of the match that begins after an end that waits,
// nothing is left once it ends. Few epochs wait, a bounded number of events and of view requests: drops of
// these are counted. Each match has its own inbox. Thread-safe. Frames do not allocate once its buffers have
// grown.
class Inbox {
  public:
    // Frames that wait: of a burst what a stall of 130 ms holds up at 60 Hz; of a hiccup one of 60 ms.
    static constexpr std::size_t max_frames = 8;
    static constexpr std::size_t max_late_frames = 4;
    // Requests of so many observers are taken at once: what they do delays a frame no more than that.
    static constexpr std::size_t max_observers_taken = 32;

    Inbox(const Pace& pace, MatchCounters& counters) : pace_(pace), counters_(counters) {}

    void put(Message message);

    // How a pose frame comes: in its time, with others that a stall on the way held up, or through the delay,
    // which holds back what comes while another waits.
    enum class Arrival { alone, in_burst, delayed };

    // Takes the frame and leaves other memory to its caller. Returns whether a frame is due, for which a
    // turn is wanted. In a burst it waits behind those that no turn has taken, and so may one that comes
    // alone while punctual workers hiccup; else it replaces all of them, and their discontinuities are
    // carried over to it.
    bool put(PoseFrame& frame, std::int64_t received_ns, Arrival arrival = Arrival::alone);

    // Frames that wait, or come before that time, steady clock, are not due: a later one takes their place.
    void rest_until(std::int64_t ns);

    // When the first frame was received, or due, that waits for a turn and that the pace lets be taken.
    [[nodiscard]] std::optional<std::int64_t> frame_waits_since();

    // Replaces an earlier one that no turn has taken.
    void put(const CameraFrame& shown);

    struct Content {
        std::vector<Message> messages;  // those of observers come first
        bool leaves_more = false;       // for another turn
        bool has_frame = false;
        PoseFrame frame;
        std::size_t messages_before_frame = 0;
        std::int64_t received_ns = 0;  // steady clock; of a delayed frame: when it was due
        bool has_shown = false;
        CameraFrame shown;  // by the director that leads the match
    };

    // Moves what waits into `content`, whose memory is reused; not a frame that is not due, of several one
    // with the messages around it, and not the requests of more observers than max_observers_taken.
    // Without a frame: those that wait are not due from then on.
    void take(Content& content, bool with_frame = true);

  private:
    using Place = std::vector<Message>::iterator;
    struct Frame {
        PoseFrame poses;
        std::int64_t received_ns = 0;
        std::size_t messages_before = 0;
        bool in_burst = false;  // or behind one
        bool is_due = false;    // when several wait, all are
    };

    // The first of the same kind that waits.
    [[nodiscard]] Place first_like(const Message& message);
    void forget(Place place);
    // Makes one of the description and of that which waits; a late one is dropped. Returns false when it is
    // to wait in its own place.
    [[nodiscard]] bool merge(MatchInfo& info);
    // Makes one of an end and of that which waits. Returns false when none does.
    [[nodiscard]] bool merge_end();
    void forget_frame_that_is_not_due();
    [[nodiscard]] bool take_credit();
    void put_aside();
    // The frames that wait, the oldest first.
    [[nodiscard]] std::span<Frame> frames() { return std::span(frame_memory_).first(frame_count_); }
    [[nodiscard]] bool is_due() const { return frame_count_ > 0 && frame_memory_.front().is_due; }
    // The oldest ones, for a newer frame.
    void replace(std::size_t count, PoseFrame& by, Counter reason);
    void count_dropped(std::size_t count, Counter reason);
    void forget_oldest(std::size_t count);
    void take_messages(Content& content);
    void take_frame(Content& content);
    void put_first_requests(Content& content);

    std::mutex mutex_;
    std::vector<Message> messages_;
    std::array<Frame, max_frames> frame_memory_;
    std::size_t frame_count_ = 0;
    bool was_late_ = false;          // the last frame in no burst found one that waited
    std::uint32_t credit_ = 0;       // frames that found none waiting, less those spent on hiccups
    std::uint32_t left_out_ = 0;     // frames since one was due
    std::int64_t rests_until_ = 0;   // see rest_until()
    std::size_t events_ = 0;         // in messages_
    std::size_t view_requests_ = 0;  // likewise
    bool has_shown_ = false;
    CameraFrame shown_;
    RequestQueue requests_;
    const Pace& pace_;
    MatchCounters& counters_;
};

}  // namespace camdir::director
