#include "director/inbox.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "director/continuity.hpp"

namespace camdir::director {
namespace {

constexpr std::size_t max_events = 256;
constexpr std::size_t max_view_requests = 64;
constexpr std::ptrdiff_t max_infos = 8;  // of different epochs
// Of so many frames one may wait behind another. An overload is heard of for that from 4.4 % of late frames
// on instead of 2 %: see Pace.
constexpr std::uint32_t frames_per_wait = 40;
constexpr std::uint32_t most_credit = frames_per_wait * (Inbox::max_late_frames - 1);

// By epoch, then by frame number, which may wrap. Equal frames count as older.
bool older(const PoseFrame& a, const PoseFrame& b) {
    if (a.epoch != b.epoch) return a.epoch < b.epoch;
    return static_cast<std::int32_t>(a.frame_number - b.frame_number) <= 0;
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
    if (is_reminder(message) && same != messages_.end()) return;
    if (is_interruption(message) && same != messages_.end()) forget(same);
    if (event && events_ >= max_events) return counters_.add(Counter::drop_events);
    if (view && view_requests_ >= max_view_requests) return counters_.add(Counter::drop_messages);
    events_ += event ? 1 : 0;
    view_requests_ += view ? 1 : 0;
    messages_.push_back(std::move(message));
}

Inbox::Place Inbox::first_like(const Message& message) {
    return std::ranges::find_if(messages_,
                                [&](const Message& waiting) { return waiting.index() == message.index(); });
}

void Inbox::forget(Place place) {
    const auto before = static_cast<std::size_t>(place - messages_.begin());
    for (Frame& frame : frames())
        if (before < frame.messages_before) --frame.messages_before;
    messages_.erase(place);
}

// Nothing would be seen of epochs that pass so fast that many wait.
bool Inbox::merge(MatchInfo& info) {
    const auto last = std::find_if(messages_.rbegin(), messages_.rend(), [](const Message& message) {
        return is<MatchInfo>(message) || is<MatchEnded>(message);
    });
    if (last == messages_.rend() || is<MatchEnded>(*last)) return false;
    auto& waiting = std::get<MatchInfo>(*last);
    if (info.epoch < waiting.epoch) {
        counters_.add(Counter::drop_old_epoch);
        return true;
    }
    const bool begins = info.epoch > waiting.epoch || info.map_name != waiting.map_name;
    if (begins && std::ranges::count_if(messages_, is<MatchInfo>) < max_infos) return false;
    if (std::any_of(messages_.rbegin(), last, is_interruption)) {
        forget(std::prev(last.base()));
        return false;
    }
    waiting = std::move(info);
    return true;
}

// Nothing would be seen of a match that begins and ends while an end waits.
bool Inbox::merge_end() {
    const auto end = std::ranges::find_if(messages_, is<MatchEnded>);
    if (end == messages_.end()) return false;
    const auto before = static_cast<std::size_t>(end - messages_.begin());
    const auto after = static_cast<std::size_t>(
        std::ranges::count_if(frames(), [&](const Frame& frame) { return frame.messages_before > before; }));
    count_dropped(after, is_due() ? Counter::drop_superseded : Counter::drop_paced);
    frame_count_ -= after;
    const auto events = static_cast<std::size_t>(std::count_if(end, messages_.end(), is<MatchEvent>));
    counters_.add(Counter::drop_events, events);
    events_ -= events;
    messages_.erase(std::remove_if(end, messages_.end(), is_of_server), messages_.end());
    return true;
}

// Of a match that has ended: frames of the next one may be older than it.
void Inbox::forget_frame_that_is_not_due() {
    if (frame_count_ == 0 || is_due()) return;
    counters_.add(Counter::drop_paced);
    frame_count_ = 0;
    left_out_ = 0;
}

bool Inbox::put(PoseFrame& frame, std::int64_t received_ns, Arrival arrival) {
    const std::lock_guard lock(mutex_);
    if (frame_count_ > 0 && older(frame, frames().back().poses)) {
        counters_.add(frame.epoch < frames().back().poses.epoch ? Counter::drop_old_epoch
                                                                : Counter::drop_old_frame);
        return false;
    }
    const std::uint32_t frames_per_camera = pace_.frames_per_camera();
    const bool in_burst = arrival == Arrival::in_burst;
    const bool wanted = left_out_ + 1 >= frames_per_camera && received_ns >= rests_until_;
    const bool was_due = is_due();
    const bool behind_burst = frame_count_ > 0 && frames().back().in_burst;
    const bool stalled = in_burst || (behind_burst && !was_late_);
    const bool may_wait = frames_per_camera == 1 && wanted;
    if (may_wait && frame_count_ == 0) credit_ = std::min(credit_ + 1, most_credit);
    const bool waits = may_wait && was_due && (in_burst || (arrival == Arrival::alone && take_credit()));
    const bool joins_burst = in_burst || (waits && behind_burst);
    if (!joins_burst) was_late_ = frame_count_ > 0;
    if (!waits) {
        replace(frame_count_, frame,
                !was_due || !wanted ? Counter::drop_paced
                : stalled           ? Counter::drop_burst
                                    : Counter::drop_superseded);
    } else if (frame_count_ == max_frames) {
        replace(1, frames()[1].poses, Counter::drop_burst);
    }
    left_out_ = wanted ? 0 : left_out_ + 1;
    Frame& place = frame_memory_[frame_count_++];
    std::swap(place.poses, frame);
    place.received_ns = received_ns;
    place.messages_before = messages_.size();
    place.in_burst = joins_burst;
    place.is_due = wanted || was_due;
    return place.is_due;
}

// For a hiccup of the workers, where they have been punctual for long enough; also one in which they have not
// got through a burst.
bool Inbox::take_credit() {
    if (credit_ < frames_per_wait) return false;
    credit_ -= frames_per_wait;
    return true;
}

void Inbox::rest_until(std::int64_t ns) {
    const std::lock_guard lock(mutex_);
    rests_until_ = ns;
    put_aside();
}

// What waits: the newest frame of it until a later one comes.
void Inbox::put_aside() {
    if (frame_count_ > 1) replace(frame_count_ - 1, frames().back().poses, Counter::drop_paced);
    for (Frame& frame : frames())
        frame.is_due = false;
    if (std::ranges::any_of(messages_, is<MatchEnded>)) forget_frame_that_is_not_due();
}

void Inbox::replace(std::size_t count, PoseFrame& by, Counter reason) {
    for (const Frame& frame : frames().first(count))
        carry_discontinuities(frame.poses, by);
    count_dropped(count, reason);
    forget_oldest(count);
}

// Of a burst that the workers did not get to, one frame counts as their fault.
void Inbox::count_dropped(std::size_t count, Counter reason) {
    const bool of_burst = reason == Counter::drop_superseded && count > 1 && frames().back().in_burst;
    counters_.add(reason, of_burst ? 1 : count);
    if (of_burst) counters_.add(Counter::drop_burst, count - 1);
}

void Inbox::forget_oldest(std::size_t count) {
    const auto waiting = frames();
    for (Frame& frame : waiting.first(count))
        frame.poses.movers.reset();
    std::rotate(waiting.begin(), waiting.begin() + static_cast<std::ptrdiff_t>(count), waiting.end());
    frame_count_ -= count;
}

std::optional<std::int64_t> Inbox::frame_waits_since() {
    const std::lock_guard lock(mutex_);
    if (!is_due()) return std::nullopt;
    return frames().front().received_ns;
}

void Inbox::put(const CameraFrame& shown) {
    const std::lock_guard lock(mutex_);
    shown_ = shown;
    has_shown_ = true;
}

void Inbox::take(Content& content, bool with_frame) {
    const std::lock_guard lock(mutex_);
    if (!with_frame) put_aside();
    take_messages(content);
    take_frame(content);
    put_first_requests(content);
    content.leaves_more = is_due() || !requests_.empty();
    content.has_shown = std::exchange(has_shown_, false);
    if (content.has_shown) std::swap(content.shown, shown_);
}

// Those before the second frame.
void Inbox::take_messages(Content& content) {
    const std::size_t count = frame_count_ > 1 ? frames()[1].messages_before : messages_.size();
    const auto end = messages_.begin() + static_cast<std::ptrdiff_t>(count);
    content.messages.assign(std::make_move_iterator(messages_.begin()), std::make_move_iterator(end));
    messages_.erase(messages_.begin(), end);
    content.messages_before_frame = 0;
    if (frame_count_ > 0) content.messages_before_frame = std::exchange(frames()[0].messages_before, 0);
    for (Frame& frame : frames().subspan(std::min<std::size_t>(frame_count_, 1)))
        frame.messages_before -= count;
    events_ = static_cast<std::size_t>(std::ranges::count_if(messages_, is<MatchEvent>));
    view_requests_ = static_cast<std::size_t>(std::ranges::count_if(messages_, is<ViewRequest>));
}

void Inbox::take_frame(Content& content) {
    content.has_frame = is_due();
    if (!content.has_frame) return;
    Frame& first = frames().front();
    std::swap(content.frame, first.poses);
    content.received_ns = first.received_ns;
    forget_oldest(1);
}

void Inbox::put_first_requests(Content& content) {
    std::vector<Message>& messages = content.messages;
    const auto others = static_cast<std::ptrdiff_t>(messages.size());
    for (std::size_t i = 0; i < max_observers_taken && !requests_.empty(); ++i) {
        ObserverNews news = requests_.take();
        if (news.ended) messages.emplace_back(RequestEnded{std::move(news.observer_id)});
        if (news.request) messages.emplace_back(std::move(*news.request));
    }
    content.messages_before_frame += messages.size() - static_cast<std::size_t>(others);
    std::rotate(messages.begin(), messages.begin() + others, messages.end());
}

}  // namespace camdir::director
