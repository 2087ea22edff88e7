#include "director/inbox.hpp"

#include <algorithm>
#include <utility>

#include "director/roster.hpp"

namespace camdir::director {
namespace {

constexpr std::size_t max_events = 256;

// By epoch, then by frame number, which may wrap. Equal frames count as older.
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

// Sent at an interval of which less than half was left when they arrived.
bool came_together(const PoseFrame& first, std::int64_t first_received_ns, const PoseFrame& second,
                   std::int64_t second_received_ns) {
    const double sent_apart =
        static_cast<double>(second.source_time) - static_cast<double>(first.source_time);
    return 2.0 * static_cast<double>(second_received_ns - first_received_ns) < sent_apart;
}

}  // namespace

void Inbox::put(Message message) {
    const bool event = std::holds_alternative<MatchEvent>(message);
    const bool of_observer =
        std::holds_alternative<ObserverRequest>(message) || std::holds_alternative<ViewRequest>(message);
    const std::lock_guard lock(mutex_);
    if (event && events_ >= max_events) return counters_.add(Counter::drop_events);
    if (of_observer && observer_messages_ >= max_observer_messages_)
        return counters_.add(Counter::drop_messages);
    events_ += event ? 1 : 0;
    observer_messages_ += of_observer ? 1 : 0;
    waiting_.messages.push_back(std::move(message));
}

bool Inbox::put(PoseFrame& frame, std::int64_t received_ns) {
    const std::lock_guard lock(mutex_);
    if (waiting_.has_frame) {
        if (older(frame, waiting_.frame)) {
            counters_.add(frame.epoch < waiting_.frame.epoch ? Counter::drop_old_epoch
                                                             : Counter::drop_old_frame);
            return false;
        }
        counters_.add(reason_to_replace(frame, received_ns));
        if (waiting_.frame.epoch == frame.epoch) carry_discontinuities(waiting_.frame, frame);
    }
    std::swap(waiting_.frame, frame);
    if (++left_out_ >= pace_.frames_per_camera()) {
        left_out_ = 0;
        is_due_ = true;
    }
    waiting_.has_frame = true;
    waiting_.messages_before_frame = waiting_.messages.size();
    waiting_.received_ns = received_ns;
    return is_due_;
}

Counter Inbox::reason_to_replace(const PoseFrame& frame, std::int64_t received_ns) const {
    if (!is_due_) return Counter::drop_paced;
    const bool together = frame.epoch == waiting_.frame.epoch &&
                          came_together(waiting_.frame, waiting_.received_ns, frame, received_ns);
    return together ? Counter::drop_burst : Counter::drop_superseded;
}

void Inbox::put(const CameraFrame& shown) {
    const std::lock_guard lock(mutex_);
    waiting_.shown = shown;
    waiting_.has_shown = true;
}

void Inbox::take(Content& content) {
    content.messages.clear();
    content.has_frame = false;
    content.has_shown = false;
    const std::lock_guard lock(mutex_);
    std::swap(content, waiting_);
    if (content.has_frame && !is_due_) {
        std::swap(content.frame, waiting_.frame);
        waiting_.has_frame = std::exchange(content.has_frame, false);
        waiting_.received_ns = content.received_ns;
        waiting_.messages_before_frame = 0;
    }
    is_due_ = false;
    events_ = 0;
    observer_messages_ = 0;
}

}  // namespace camdir::director
