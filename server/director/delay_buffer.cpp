#include "director/delay_buffer.hpp"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "director/clock.hpp"

namespace camdir::director {
namespace {

constexpr std::int64_t retained_ns = 1'000'000'000;  // of what has left, for those who look ahead late
constexpr std::int64_t max_paced_ns = 250'000'000;
constexpr std::int64_t max_late_ns = 100'000'000;  // of frames that are shown in turn
constexpr std::int64_t turn_ns = 2'000'000;        // until one that waits for its turn is looked at again
constexpr double longest_pace_s = 0.25;            // a longer step of the game's clock is a pause or a jump
constexpr double pace = 0.9;
constexpr std::size_t bytes_of_name = 96;  // a player's name and class

std::size_t bytes_of(const Message& message) {
    const auto* info = std::get_if<MatchInfo>(&message);
    return info == nullptr ? 0 : info->players.size() * (sizeof(Player) + bytes_of_name);
}

std::size_t bytes_of(const MoverInfo& info) {
    std::size_t bytes = sizeof(MoverInfo) + info.movers.size() * sizeof(Mover);
    for (const Mover& mover : info.movers) {
        bytes += mover.shape.name.size() + mover.shape.kind.size() +
                 mover.shape.balls.size() * sizeof(freespace::MoverBall);
        for (const freespace::ConvexHull& hull : mover.shape.hulls)
            bytes += sizeof hull + hull.half_spaces.size() * sizeof(freespace::HalfSpace);
    }
    return bytes;
}

// Of what the frame before has not.
std::size_t bytes_of(const PoseFrame& frame, const MatchMovers* movers_before) {
    std::size_t bytes = frame.poses.size() * sizeof(PlayerPose);
    if (frame.movers && frame.movers.get() != movers_before)
        bytes +=
            sizeof(MatchMovers) + sizeof(MoverFrame) + frame.movers->frame->poses.size() * sizeof(MoverPose);
    if (frame.movers && (movers_before == nullptr || frame.movers->info != movers_before->info))
        bytes += bytes_of(*frame.movers->info);
    return bytes;
}

std::string seconds_text(double seconds) {
    return fmt::format("{:.4g} s", seconds);
}

}  // namespace

bool DelayBuffer::announce(std::uint64_t epoch, double delay_s, std::int64_t now) {
    const std::lock_guard lock(mutex_);
    if (begun_ && epoch < epoch_) return false;
    const bool new_epoch = !begun_ || epoch > epoch_;
    begun_ = true;
    epoch_ = epoch;
    announced_s_ = delay_s;
    return update(new_epoch, now);
}

bool DelayBuffer::set_minimum(double delay_s, std::int64_t now) {
    const std::lock_guard lock(mutex_);
    minimum_s_ = delay_s;
    return (begun_ || released_ < entries_.size()) && update(false, now);
}

bool DelayBuffer::update(bool new_epoch, std::int64_t now) {
    if (wanted_s() > max_delay_s)
        return refuse("a delay of " + seconds_text(wanted_s()) + " is wanted; the longest possible is " +
                      seconds_text(max_delay_s)) ||
               new_epoch;  // each epoch has its answers
    // What did not fit in would not fit in again.
    if (!refusal_.empty() && !new_epoch && wanted_s() == refused_s_) return false;
    const bool accepted_again = !refusal_.empty();
    refusal_.clear();
    const auto wanted = static_cast<std::int64_t>(std::ceil(wanted_s() * 1e9));
    const std::int64_t before = delay_ns_;
    delay_ns_ = new_epoch || accepted_again ? wanted : std::max(delay_ns_, wanted);
    if (delay_ns_ <= before && !accepted_again) return false;
    hold_back(now);
    return true;
}

bool DelayBuffer::refuse(std::string reason) {
    first_ += entries_.size();
    near_ = first_;
    entries_.clear();
    released_ = 0;
    bytes_ = 0;
    last_due_ = last_frame_due_ = 0;  // nothing is before what comes next
    refused_s_ = wanted_s();
    const bool news = reason != refusal_;
    refusal_ = std::move(reason);
    return news;
}

// What waits gets the delay that is in force now.
void DelayBuffer::hold_back(std::int64_t now) {
    for (std::size_t i = released_; i < entries_.size(); ++i) {
        entries_[i].due = std::max(entries_[i].due, entries_[i].received + delay_ns_);
        last_due_ = std::max(last_due_, entries_[i].due);
    }
    near_ = first_ + released_;
    resumes_at_ = released_ < entries_.size() ? entries_[released_].due : now + delay_ns_;
}

DelayBuffer::Admission DelayBuffer::put(Message& message, std::int64_t now) {
    const std::lock_guard lock(mutex_);
    const bool ends = std::holds_alternative<MatchEnded>(message);
    if (ends) begun_ = false;
    if (!refusal_.empty()) {
        if (ends) refusal_.clear();
        return ends ? Admission::undelayed : Admission::refused;
    }
    if (passes()) return Admission::undelayed;
    const std::size_t bytes = bytes_of(message);
    return keep(std::move(message), bytes, now + delay_ns_, now);
}

DelayBuffer::Admission DelayBuffer::put(const PoseFrame& frame, std::int64_t punctual) {
    const std::lock_guard lock(mutex_);
    if (!refusal_.empty()) return Admission::refused;
    if (passes()) return Admission::undelayed;
    const Admission admission =
        keep(frame, bytes_of(frame, last_movers_.get()), due_of(frame, punctual), punctual);
    last_movers_ = frame.movers;
    last_frame_due_ = last_due_;
    last_frame_epoch_ = frame.epoch;
    last_frame_time_ = frame.frame_time;
    return admission;
}

std::int64_t DelayBuffer::due_of(const PoseFrame& frame, std::int64_t received) const {
    const std::int64_t due = received + delay_ns_;
    if (last_frame_due_ == 0 || frame.epoch != last_frame_epoch_) return due;
    const double step = seconds_between(last_frame_time_, frame.frame_time);
    if (!(step > 0.0 && step <= longest_pace_s)) return due;
    return std::clamp(last_frame_due_ + static_cast<std::int64_t>(pace * step * 1e9), due,
                      due + max_paced_ns);
}

DelayBuffer::Admission DelayBuffer::keep(Item item, std::size_t bytes, std::int64_t due,
                                         std::int64_t received) {
    bytes += sizeof(Entry);
    const auto* message = std::get_if<Message>(&item);
    const bool leaves = message != nullptr && (std::holds_alternative<MatchEnded>(*message) ||
                                               std::holds_alternative<ServerLost>(*message));
    if (!leaves && bytes_ + bytes > max_bytes_) {  // a match must be able to end
        refuse("a delay of " + seconds_text(wanted_s()) + " needs more memory than limits.delay_mib, " +
               std::to_string(max_bytes_ >> 20U) + " MiB");
        return Admission::refused_now;
    }
    last_due_ = std::max(last_due_, due);
    bytes_ += bytes;
    entries_.push_back({received, last_due_, bytes, std::move(item)});
    return Admission::delayed;
}

DelayBuffer::Released DelayBuffer::release(std::int64_t now, Inbox& inbox) {
    const std::lock_guard lock(mutex_);
    Released released;
    const auto leaves = [&](const Entry& entry) {
        if (entry.due > now) return false;
        if (std::holds_alternative<Message>(entry.item)) return true;
        const auto waits_since = inbox.frame_waits_since();
        if (!waits_since || *waits_since >= entry.due) return true;
        return *waits_since < now - max_late_ns;  // turns that are too slow do not make frames ever later
    };
    for (; released_ < entries_.size() && leaves(entries_[released_]); ++released_) {
        Entry& entry = entries_[released_];
        if (const auto* frame = std::get_if<PoseFrame>(&entry.item)) {
            leaving_ = *frame;  // which is kept
            released.any |= inbox.put(leaving_, entry.due, Inbox::Arrival::delayed);
            last_left_ = frame->frame_time;
        } else {
            inbox.put(std::move(std::get<Message>(entry.item)));
            released.any = true;
        }
    }
    near_ = std::max(near_, first_ + released_);
    const std::uint64_t end = first_ + entries_.size();
    for (; near_ < end && entries_[near_ - first_].due <= now + lead_ns; ++near_)
        released.any = true;
    while (released_ > 0 && entries_.front().due < now - retained_ns) {
        bytes_ -= entries_.front().bytes;
        entries_.pop_front();
        ++first_;
        --released_;
    }
    if (released_ < entries_.size()) {
        const std::int64_t due = entries_[released_].due;
        released.next = due > now ? due : now + turn_ns;
    }
    if (near_ < end) released.next = std::min(released.next, entries_[near_ - first_].due - lead_ns);
    return released;
}

std::optional<DelayBuffer::Upcoming> DelayBuffer::upcoming() const {
    const std::lock_guard lock(mutex_);
    for (std::uint64_t next = first_ + released_; next < near_; ++next)
        if (const auto* frame = std::get_if<PoseFrame>(&entries_[next - first_].item))
            return Upcoming{frame->epoch, frame->frame_time, last_left_};
    return std::nullopt;
}

bool DelayBuffer::waits() const {
    const std::lock_guard lock(mutex_);
    return released_ < entries_.size();
}

DelayBuffer::State DelayBuffer::state() const {
    const std::lock_guard lock(mutex_);
    return {static_cast<double>(delay_ns_) / 1e9,
            epoch_,
            refusal_,
            released_ < entries_.size() ? entries_[released_].due : never,
            resumes_at_,
            bytes_};
}

}  // namespace camdir::director
