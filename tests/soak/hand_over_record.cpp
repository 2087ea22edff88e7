#include "hand_over_record.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::soak {

void HandOverRecord::begin(double now) {
    begun_ = now;
    found_ = {};
}

std::optional<std::uint64_t> HandOverRecord::director() const {
    if (!last_) return std::nullopt;
    return last_->frame.director_id;
}

void HandOverRecord::add(const camera_director::CameraFrame& frame, const camera_director::Camera* own,
                         double now) {
    if (is_stale(frame)) {
        ++found_.stale;
        return;
    }
    newest_ = frame;
    if (own == nullptr) {
        ++found_.unanswered;
        return;
    }
    const Seen seen{frame, Eigen::Map<const Vec3f>(own->position).cast<double>(), now};
    if (last_) compare(*last_, seen, (own->flags & CDIR_CAMERA_CUT) != 0);
    last_ = seen;
}

bool HandOverRecord::is_stale(const camera_director::CameraFrame& frame) const {
    if (!newest_ || frame.epoch > newest_->epoch) return false;
    return frame.epoch < newest_->epoch || frame.frame_time <= newest_->frame_time;
}

void HandOverRecord::compare(const Seen& before, const Seen& seen, bool cut) {
    found_.gap_ms = std::max(found_.gap_ms, 1e3 * (seen.time - std::max(begun_, before.time)));
    found_.changes += seen.frame.director_id != before.frame.director_id ? 1 : 0;
    if (seen.frame.epoch > before.frame.epoch) return;
    const std::int64_t from = index_of(before.frame);
    const std::int64_t to = index_of(seen.frame);
    found_.lost += static_cast<std::uint64_t>(to - from - 1);
    const bool broken = is_broken(from, to);
    found_.unforced += cut && !broken ? 1 : 0;
    // Readers take frames whose numbers have a gap for a cut. After a stall of the game there is no other
    // way.
    const bool joined =
        seen.frame.frame_number == before.frame.frame_number + 1 && static_cast<double>(to - from) < rate_hz_;
    if (cut || (broken && !joined)) return;
    const double player = broken ? 0.0 : (pose_at(to)->eye - pose_at(from)->eye).norm();
    found_.leap = std::max(found_.leap, (seen.camera - before.camera).norm() - player);
}

HandOver HandOverRecord::finish(double now) {
    found_.silent_s = now - std::max(begun_, last_ ? last_->time : begun_);
    found_.gap_ms = std::max(found_.gap_ms, 1e3 * found_.silent_s);
    return found_;
}

std::int64_t HandOverRecord::index_of(const camera_director::CameraFrame& frame) const {
    return std::llround(1e-9 * static_cast<double>(frame.frame_time) * rate_hz_);
}

const evaluation::TracePose* HandOverRecord::pose_at(std::int64_t index) const {
    const auto& frame = trace_.frames[static_cast<std::size_t>(index) % trace_.frames.size()];
    const std::uint32_t pose = evaluation::pose_of(trace_, frame, player_);
    return pose == evaluation::absent ? nullptr : &trace_.poses[pose];
}

// Whether the player was absent, dead, respawned or teleported anywhere after `from` until `to`.
bool HandOverRecord::is_broken(std::int64_t from, std::int64_t to) const {
    if (pose_at(from) == nullptr) return true;
    for (std::int64_t index = from + 1; index <= to; ++index) {
        const evaluation::TracePose* pose = pose_at(index);
        const bool wraps = static_cast<std::size_t>(index) % trace_.frames.size() == 0;
        if (pose == nullptr || pose->discontinuity || wraps) return true;
    }
    return false;
}

}  // namespace camdir::soak
