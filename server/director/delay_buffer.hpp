// The delay between a match and its observers: what the game server sends waits here until it is due.
#pragma once

#include <algorithm>
#include <cstdint>
#include <deque>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "director/inbox.hpp"
#include "director/messages.hpp"

namespace camdir::director {

inline constexpr double max_delay_s = 120.0;

// Everything leaves in the order of its receipt, at least the delay after its receipt. Pose frames are given
// as if none had been slow on its way (Receipt::punctual): the delay has time to take out what the network
// and schedulers add. Those that are closer together all the same are due at most a ninth faster than the
// game's clock ran between them, and for that at most 0.25 s late. The delay is the greater of the match's
// own and the operator's. It may grow at any time: what waits then waits on. A smaller one takes effect with
// the next epoch: nothing is shown earlier than was promised when it was recorded. What cannot be delayed is
// refused and dropped.
//
// Times are the steady clock's in ns; the buffer reads no clock. Thread-safe.
class DelayBuffer {
  public:
    static constexpr std::int64_t never = std::numeric_limits<std::int64_t>::max();
    // How long before a pose frame is due its cameras can be prepared.
    static constexpr std::int64_t lead_ns = 10'000'000;

    explicit DelayBuffer(std::size_t max_bytes) : max_bytes_(max_bytes) {}

    // The delay of an epoch of the match, and the operator's minimum. They return true when the answers to
    // observers change: the delay has grown, or is refused or no longer refused. An epoch older than the
    // newest is ignored.
    bool announce(std::uint64_t epoch, double delay_s, std::int64_t now);
    bool set_minimum(double delay_s, std::int64_t now);

    enum class Admission {
        undelayed,    // nothing is kept: the caller passes it on at once
        delayed,      // kept; a message is moved from
        refused_now,  // it is the first that does not fit in; everything that waited is dropped
        refused,      // dropped
    };
    // Of what the game server sends: MatchInfo (after announce()), MatchEvent, ServerLost, MatchEnded. The
    // end of a refused match is not delayed.
    [[nodiscard]] Admission put(Message& message, std::int64_t now);
    [[nodiscard]] Admission put(const PoseFrame& frame, std::int64_t punctual);

    struct Released {
        bool any = false;           // something has left, or has come within lead_ns of being due
        std::int64_t next = never;  // when there is more
    };
    // Passes on what is due by `now`; pose frames with the time at which they were due. One that is due after
    // another that no turn has taken waits for that, and replaces it once it is more than 0.1 s late.
    Released release(std::int64_t now, Inbox& inbox);

    struct Upcoming {
        std::uint64_t epoch = 0;
        std::int64_t frame_time = 0;
        std::int64_t after = 0;  // the frame_time of the pose frame that has left before
    };
    // The next pose frame to leave, when it is within lead_ns of that as of the last release().
    [[nodiscard]] std::optional<Upcoming> upcoming() const;

    // Calls add(frame) for the pose frames after position `next`, also those not due yet and those of the
    // last second, in order, until one returns false, and hear() for each MatchEvent and MatchInfo among
    // them. `next` becomes the position of that frame. Returns false when the buffer holds nothing.
    template <class Add, class Hear>
    bool look_ahead(std::uint64_t& next, Add&& add, Hear&& hear) const {
        const std::lock_guard lock(mutex_);
        next = std::max(next, first_);
        for (; next < first_ + entries_.size(); ++next) {
            const Item& item = entries_[next - first_].item;
            if (const auto* frame = std::get_if<PoseFrame>(&item)) {
                if (!add(*frame)) break;
            } else if (const auto& message = std::get<Message>(item);
                       const auto* event = std::get_if<MatchEvent>(&message)) {
                hear(*event);
            } else if (const auto* info = std::get_if<MatchInfo>(&message)) {
                hear(*info);
            }
        }
        return !entries_.empty();
    }
    template <class Add>
    bool look_ahead(std::uint64_t& next, Add&& add) const {
        return look_ahead(next, std::forward<Add>(add), [](const auto&) {});
    }

    struct State {
        double delay_s = 0.0;
        std::uint64_t epoch = 0;        // the newest announced
        std::string refusal;            // why the match cannot be delayed; empty when it can
        std::int64_t next_due = never;  // of what waits
        std::int64_t resumes_at = 0;    // when the delay has last grown: until then nothing is due
        std::size_t bytes = 0;
    };
    [[nodiscard]] State state() const;
    // Whether anything is kept that has not left.
    [[nodiscard]] bool waits() const;

  private:
    using Item = std::variant<PoseFrame, Message>;
    struct Entry {
        std::int64_t received;
        std::int64_t due;
        std::size_t bytes;
        Item item;
    };

    // With the mutex held.
    bool update(bool new_epoch, std::int64_t now);
    bool refuse(std::string reason);
    void hold_back(std::int64_t now);
    Admission keep(Item item, std::size_t bytes, std::int64_t due, std::int64_t received);
    [[nodiscard]] bool passes() const { return delay_ns_ == 0 && released_ == entries_.size(); }
    [[nodiscard]] std::int64_t due_of(const PoseFrame& frame, std::int64_t received) const;
    [[nodiscard]] double wanted_s() const { return std::max(announced_s_, minimum_s_); }

    const std::size_t max_bytes_;
    mutable std::mutex mutex_;
    double announced_s_ = 0.0;
    double minimum_s_ = 0.0;
    double refused_s_ = 0.0;  // the delay that `refusal_` is about
    std::string refusal_;
    bool begun_ = false;  // an epoch is announced, and the match has not ended since
    std::uint64_t epoch_ = 0;
    std::int64_t delay_ns_ = 0;
    std::int64_t resumes_at_ = 0;

    std::deque<Entry> entries_;
    std::uint64_t first_ = 0;   // position of entries_.front()
    PoseFrame leaving_;         // during release()
    std::size_t released_ = 0;  // entries before this one have left; kept for a second
    std::uint64_t near_ = 0;    // position of the first that is not within lead_ns of being due
    std::size_t bytes_ = 0;
    std::int64_t last_left_ = 0;  // frame_time
    std::int64_t last_due_ = 0;
    std::int64_t last_frame_due_ = 0;  // 0: no frame yet
    std::uint64_t last_frame_epoch_ = 0;
    std::int64_t last_frame_time_ = 0;
    std::shared_ptr<const MatchMovers> last_movers_;
};

}  // namespace camdir::director
