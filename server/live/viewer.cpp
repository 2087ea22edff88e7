#include "live/viewer.hpp"

#include <algorithm>
#include <utility>

#include "live/notes.hpp"

namespace camdir::live {

Viewer::Viewer(std::function<void()> wake, const ViewerLimits& limits)
    : wake_(std::move(wake)), limits_(limits) {}

std::size_t Viewer::put(SharedMessage message) {
    const std::lock_guard lock(mutex_);
    if (!wake_ || lost_ || ends_) return 0;
    const bool was_empty = waiting_.empty();
    const bool is_frame = message->kind == Message::Kind::frame;
    waiting_.push_back(std::move(message));
    if (is_frame) ++frames_;
    const bool drops = frames_ > limits_.frames;
    if (drops) drop_oldest_frame();
    lost_ = waiting_.size() - frames_ > limits_.notes;
    if (lost_) waiting_.clear();
    if (was_empty || lost_) wake_();
    return drops ? 1 : 0;
}

void Viewer::drop_oldest_frame() {
    waiting_.erase(std::ranges::find(waiting_, Message::Kind::frame,
                                     [](const SharedMessage& message) { return message->kind; }));
    --frames_;
    ++dropped_;
}

void Viewer::finish() {
    const std::lock_guard lock(mutex_);
    ends_ = true;
    if (wake_ && waiting_.empty()) wake_();
}

SharedMessage Viewer::take() {
    const std::lock_guard lock(mutex_);
    if (const std::size_t dropped = std::exchange(dropped_, 0); dropped > 0) return dropped_note(dropped);
    if (waiting_.empty()) return nullptr;
    SharedMessage next = std::move(waiting_.front());
    waiting_.pop_front();
    if (next->kind == Message::Kind::frame) --frames_;
    return next;
}

bool Viewer::lost() const {
    const std::lock_guard lock(mutex_);
    return lost_;
}

bool Viewer::finished() const {
    const std::lock_guard lock(mutex_);
    return ends_ && waiting_.empty();
}

void Viewer::leave() {
    const std::lock_guard lock(mutex_);
    wake_ = nullptr;
    waiting_.clear();
    frames_ = 0;
}

bool Viewer::left() const {
    const std::lock_guard lock(mutex_);
    return !wake_;
}

}  // namespace camdir::live
