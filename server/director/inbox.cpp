#include "director/inbox.hpp"

#include <algorithm>
#include <utility>

#include "director/roster.hpp"

namespace camdir::director {
namespace {

constexpr std::size_t most_events = 256;

// Older by epoch, or by number within the epoch; numbers may wrap.
bool older(const PoseFrame& a, const PoseFrame& b) {
    if (a.epoch != b.epoch) return a.epoch < b.epoch;
    return static_cast<std::int32_t>(a.frame_number - b.frame_number) <= 0;
}

void carry_discontinuities(const PoseFrame& from, PoseFrame& to) {
    for (const PlayerPose& pose : from.poses) {
        if ((pose.flags & pose_discontinuity) == 0) continue;
        for (PlayerPose& later : to.poses)
            if (later.player_id == pose.player_id) later.flags |= pose_discontinuity;
    }
}

}  // namespace

void Inbox::put(Control control) {
    const bool event = std::holds_alternative<MatchEvent>(control);
    const bool of_observer = std::holds_alternative<ObserverRequest>(control) ||
                             std::holds_alternative<RequestGone>(control) ||
                             std::holds_alternative<ViewWanted>(control);
    const std::lock_guard lock(mutex_);
    if (event && events_ >= most_events) return counters_.add(Counter::drop_events);
    if (of_observer && of_observers_ >= most_of_observers_) return counters_.add(Counter::drop_control);
    events_ += event ? 1 : 0;
    of_observers_ += of_observer ? 1 : 0;
    waiting_.controls.push_back(std::move(control));
}

void Inbox::put(const PoseFrame& frame, std::int64_t received_ns) {
    const std::lock_guard lock(mutex_);
    if (!waiting_.has_frame) {
        waiting_.frame = frame;
    } else if (older(frame, waiting_.frame)) {
        counters_.add(frame.epoch < waiting_.frame.epoch ? Counter::drop_old_epoch : Counter::drop_old_frame);
        return;
    } else {
        counters_.add(Counter::drop_superseded);
        std::swap(superseded_, waiting_.frame);
        waiting_.frame = frame;
        if (superseded_.epoch == frame.epoch) carry_discontinuities(superseded_, waiting_.frame);
    }
    waiting_.has_frame = true;
    waiting_.received_ns = received_ns;
}

void Inbox::take(Content& content) {
    content.controls.clear();
    content.has_frame = false;
    const std::lock_guard lock(mutex_);
    std::swap(content, waiting_);
    events_ = 0;
    of_observers_ = 0;
}

}  // namespace camdir::director
