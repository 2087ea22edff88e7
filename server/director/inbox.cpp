#include "director/inbox.hpp"

#include <algorithm>
#include <utility>

#include "director/roster.hpp"

namespace camdir::director {
namespace {

constexpr std::size_t max_events = 256;
constexpr std::size_t max_view_requests = 64;
constexpr std::ptrdiff_t max_infos = 8;  // of different epochs

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

// Of one epoch, and sent at an interval of which less than half was left when they arrived.
bool came_together(const Inbox::Frame& first, const PoseFrame& second, std::int64_t second_received_ns) {
    const double sent_apart =
        static_cast<double>(second.source_time) - static_cast<double>(first.poses.source_time);
    return second.epoch == first.poses.epoch &&
           2.0 * static_cast<double>(second_received_ns - first.received_ns) < sent_apart;
}

template <class Kind>
bool is(const Message& message) {
    return std::holds_alternative<Kind>(message);
}

bool is_of_server(const Message& message) {
    return is<MatchInfo>(message) || is<ServerLost>(message) || is<MatchRefused>(message) ||
           is<MatchEvent>(message);
}

// A description after it says that it is over.
bool is_interruption(const Message& message) {
    return is<ServerLost>(message) || is<MatchRefused>(message);
}

// It says only that something is to be looked at again.
bool is_reminder(const Message& message) {
    return is<PosesMissing>(message) || is<MapsChanged>(message) || is<DelayChanged>(message);
}

}  // namespace

void Inbox::put(Message message) {
    const bool event = is<MatchEvent>(message);
    const bool view = is<ViewRequest>(message);
    const std::lock_guard lock(mutex_);
    if (auto* request = std::get_if<ObserverRequest>(&message)) return requests_.put(std::move(*request));
    if (const auto* ended = std::get_if<RequestEnded>(&message)) return requests_.end(ended->observer_id);
    if (auto* info = std::get_if<MatchInfo>(&message); info != nullptr && merge(*info)) return;
    if (is<MatchEnded>(message) && merge_end()) return;
    if (is<MatchEnded>(message)) forget_frame_that_is_not_due();
    const auto same = first_like(message);
    if (is_reminder(message) && same != waiting_.messages.end()) return;
    if (is_interruption(message) && same != waiting_.messages.end()) forget(same);
    if (event && events_ >= max_events) return counters_.add(Counter::drop_events);
    if (view && view_requests_ >= max_view_requests) return counters_.add(Counter::drop_messages);
    events_ += event ? 1 : 0;
    view_requests_ += view ? 1 : 0;
    waiting_.messages.push_back(std::move(message));
}

Inbox::Place Inbox::first_like(const Message& message) {
    return std::ranges::find_if(waiting_.messages,
                                [&](const Message& waiting) { return waiting.index() == message.index(); });
}

void Inbox::forget(Place place) {
    const auto before = static_cast<std::size_t>(place - waiting_.messages.begin());
    for (Frame& frame : waiting_.frames())
        frame.messages_before -= before < frame.messages_before ? 1 : 0;
    waiting_.messages.erase(place);
}

// Nothing would be seen of epochs that pass so fast that many wait.
bool Inbox::merge(MatchInfo& info) {
    std::vector<Message>& messages = waiting_.messages;
    const auto last = std::find_if(messages.rbegin(), messages.rend(), [](const Message& message) {
        return is<MatchInfo>(message) || is<MatchEnded>(message);
    });
    if (last == messages.rend() || is<MatchEnded>(*last)) return false;
    auto& waiting = std::get<MatchInfo>(*last);
    if (info.epoch < waiting.epoch) {
        counters_.add(Counter::drop_old_epoch);
        return true;
    }
    const bool begins = info.epoch > waiting.epoch || info.map_name != waiting.map_name;
    if (begins && std::ranges::count_if(messages, is<MatchInfo>) < max_infos) return false;
    if (std::any_of(messages.rbegin(), last, is_interruption)) {
        forget(std::prev(last.base()));
        return false;
    }
    waiting = std::move(info);
    return true;
}

// Nothing would be seen of a match that begins and ends while an end waits.
bool Inbox::merge_end() {
    std::vector<Message>& messages = waiting_.messages;
    const auto end = std::ranges::find_if(messages, is<MatchEnded>);
    if (end == messages.end()) return false;
    const auto before = static_cast<std::size_t>(end - messages.begin());
    while (waiting_.frame_count > 0 && waiting_.frames().back().messages_before > before) {
        counters_.add(is_due_ ? Counter::drop_superseded : Counter::drop_paced);
        --waiting_.frame_count;
    }
    is_due_ = is_due_ && waiting_.frame_count > 0;
    const auto events = static_cast<std::size_t>(std::count_if(end, messages.end(), is<MatchEvent>));
    counters_.add(Counter::drop_events, events);
    events_ -= events;
    messages.erase(std::remove_if(end, messages.end(), is_of_server), messages.end());
    return true;
}

// Of a match that has ended: frames of the next one may be older than it.
void Inbox::forget_frame_that_is_not_due() {
    if (waiting_.frame_count == 0 || is_due_) return;
    counters_.add(Counter::drop_paced);
    --waiting_.frame_count;
    left_out_ = 0;
}

bool Inbox::put(PoseFrame& frame, std::int64_t received_ns) {
    const std::lock_guard lock(mutex_);
    const std::uint32_t frames_per_camera = pace_.frames_per_camera();
    const bool wanted = left_out_ + 1 >= frames_per_camera;
    if (waiting_.frame_count > 0) {
        const Frame& last = waiting_.frames().back();
        if (older(frame, last.poses)) {
            counters_.add(frame.epoch < last.poses.epoch ? Counter::drop_old_epoch : Counter::drop_old_frame);
            return false;
        }
        const bool together = came_together(last, frame, received_ns);
        const Counter reason = !is_due_ || !wanted ? Counter::drop_paced
                               : together          ? Counter::drop_burst
                                                   : Counter::drop_superseded;
        const bool waits_behind = together && frames_per_camera == 1;
        if (!waits_behind) {
            replace(waiting_.frame_count, frame, reason);
        } else if (waiting_.frame_count == max_frames) {
            replace(1, waiting_.frame_memory[1].poses, reason);
        }
    }
    Frame& place = waiting_.frame_memory[waiting_.frame_count++];
    std::swap(place.poses, frame);
    place.received_ns = received_ns;
    place.messages_before = waiting_.messages.size();
    left_out_ = wanted ? 0 : left_out_ + 1;
    is_due_ = is_due_ || wanted;
    return is_due_;
}

void Inbox::replace(std::size_t count, PoseFrame& by, Counter reason) {
    const std::span<Frame> frames = waiting_.frames();
    for (const Frame& frame : frames.first(count))
        if (frame.poses.epoch == by.epoch) carry_discontinuities(frame.poses, by);
    counters_.add(reason, count);
    std::rotate(frames.begin(), frames.begin() + static_cast<std::ptrdiff_t>(count), frames.end());
    waiting_.frame_count -= count;
}

std::optional<std::int64_t> Inbox::frame_waits_since() {
    const std::lock_guard lock(mutex_);
    if (!is_due_) return std::nullopt;
    return waiting_.frames().front().received_ns;
}

void Inbox::put(const CameraFrame& shown) {
    const std::lock_guard lock(mutex_);
    waiting_.shown = shown;
    waiting_.has_shown = true;
}

void Inbox::take(Content& content) {
    content.messages.clear();
    content.frame_count = 0;
    content.has_shown = false;
    const std::lock_guard lock(mutex_);
    std::swap(content, waiting_);
    put_first_requests(content);
    if (content.frame_count > 0 && !is_due_) {
        Frame& left = waiting_.frame_memory[waiting_.frame_count++];
        std::swap(left, content.frame_memory[--content.frame_count]);
        left.messages_before = 0;
    }
    is_due_ = false;
    events_ = 0;
    view_requests_ = 0;
}

void Inbox::put_first_requests(Content& content) {
    std::vector<Message>& messages = content.messages;
    const auto others = static_cast<std::ptrdiff_t>(messages.size());
    for (std::size_t i = 0; i < max_observers_taken && !requests_.empty(); ++i) {
        ObserverNews news = requests_.take();
        if (news.ended) messages.emplace_back(RequestEnded{std::move(news.observer_id)});
        if (news.request) messages.emplace_back(std::move(*news.request));
    }
    content.leaves_requests = !requests_.empty();
    for (Frame& frame : content.frames())
        frame.messages_before += messages.size() - static_cast<std::size_t>(others);
    std::rotate(messages.begin(), messages.begin() + others, messages.end());
}

}  // namespace camdir::director
