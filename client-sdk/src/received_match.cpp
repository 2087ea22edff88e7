#include "received_match.hpp"

#include <algorithm>
#include <cstring>
#include <span>
#include <utility>

#include "checks.hpp"
#include "fixed_string.hpp"

namespace camdir::sdk {

namespace {

constexpr std::int64_t max_step_back = 1'000'000'000;  // ns; what comes late by less has been shown

cdir_player player_at(const camera_director_ShownMatch& info, std::uint32_t index) {
    cdir_player player{};
    player.id = info.player_id._buffer[index];
    if (info.player_team._length > 0) player.team = info.player_team._buffer[index];
    if (info.player_name._length > 0) copy_string(player.name, info.player_name._buffer[index]);
    if (info.player_class._length > 0) copy_string(player.player_class, info.player_class._buffer[index]);
    return player;
}

ReceivedMatch::Info info_from(const camera_director_ShownMatch& sample,
                              const Allocator<cdir_player>& allocator) {
    ReceivedMatch::Info info{cdir_match_info_default(), Vector<cdir_player>(allocator)};
    copy_string(info.match.match_id, sample.match_id);
    copy_string(info.match.map_name, sample.map_name);
    info.match.epoch = sample.epoch;
    info.match.map_hash = sample.map_hash;
    info.match.metres_per_unit = sample.metres_per_unit;
    info.match.rate_hz = sample.rate_hz;
    info.match.spectator_delay_s = sample.spectator_delay_s;
    for (std::uint32_t i = 0; i < sample.player_id._length; ++i) {
        info.players.push_back(player_at(sample, i));
    }
    return info;
}

// The director tells it when it changes.
void copy_reason(const cdir_camera& from, cdir_camera& to) {
    to.reason_actor = from.reason_actor;
    to.reason_subject = from.reason_subject;
    copy_string(to.reason, from.reason);
}

}  // namespace

cdir_camera camera_at(const camera_director_CameraFrame& frame, std::uint32_t index) {
    cdir_camera camera{};
    camera.camera_id = frame.camera_id._buffer[index];
    camera.target = frame.target._buffer[index];
    std::copy_n(frame.position._buffer + 3 * index, 3, camera.position);
    std::copy_n(frame.orientation._buffer + 4 * index, 4, camera.orientation);
    camera.vertical_fov = frame.vertical_fov._buffer[index];
    camera.clearance = frame.clearance._buffer[index];
    camera.flags = frame.flags._buffer[index];
    camera.reason_actor = camera.reason_subject = CDIR_NO_PLAYER;
    for (std::uint32_t i = 0; i < frame.reasons._length; ++i) {
        const camera_director_ShotReason& reason = frame.reasons._buffer[i];
        if (reason.camera_id != camera.camera_id) continue;
        camera.reason_actor = reason.actor;
        camera.reason_subject = reason.subject;
        copy_string(camera.reason, reason.why);
    }
    return camera;
}

ReceivedMatch::ReceivedMatch(std::string match_id, std::string observer_id, std::int64_t interpolation_delay)
    : match_id_(std::move(match_id)), observer_id_(std::move(observer_id)), clock_(interpolation_delay) {}

bool ReceivedMatch::enter_epoch(std::uint64_t epoch) {
    if (described_ && epoch < epoch_) {
        ++counters_.stale_epoch;
        return false;
    }
    if (epoch != epoch_) begin_epoch(epoch);
    return true;
}

bool ReceivedMatch::is_of_epoch(std::uint64_t epoch) {
    if (epoch < epoch_) ++counters_.stale_epoch;
    if (epoch > epoch_ && !described_) begin_epoch(epoch);
    return epoch == epoch_;
}

void ReceivedMatch::begin_epoch(std::uint64_t epoch) {
    epoch_ = epoch;
    info_.reset();
    status_.reset();
    last_frame_.reset();
    track_.clear();
    clock_.clear();
}

// Samples of different topics can overtake each other.
void ReceivedMatch::take_early_status() {
    if (early_status_) accept(*std::exchange(early_status_, std::nullopt));
}

// Directors that did not know of each other have written the same frames, and one that could not be reached
// sends its last ones again. The time of a game that pauses stands still, and the numbers of its poses go on.
bool ReceivedMatch::is_repeated(const camera_director_CameraFrame& frame) const {
    if (!last_frame_ || is_of_past(frame)) return false;
    if (frame.frame_time != last_frame_->frame_time) return frame.frame_time < last_frame_->frame_time;
    return static_cast<std::int32_t>(frame.pose_number - last_frame_->pose_number) <= 0;
}

bool ReceivedMatch::is_of_past(const camera_director_CameraFrame& frame) const {
    return last_frame_ && frame.frame_time < last_frame_->frame_time - max_step_back;
}

// A frame of the far future would keep out all later ones.
void ReceivedMatch::forget_future(const camera_director_CameraFrame& frame) {
    if (!is_of_past(frame)) return;
    track_.clear();
    clock_.clear();
}

void ReceivedMatch::accept(const camera_director_ShownMatch& info) {
    if (!is_valid(info, match_id_)) {
        ++counters_.invalid;
    } else if (enter_epoch(info.epoch)) {
        info_ = info_from(info, allocator_);
        described_ = true;
        take_early_status();
    }
}

void ReceivedMatch::match_ended() {
    info_.reset();
    described_ = false;
    take_early_status();
}

bool ReceivedMatch::accept(const camera_director_ObserverStatusBucket& answers) {
    if (answers.match_id != match_id_) {
        ++counters_.invalid;
        return true;
    }
    const std::span statuses(answers.statuses._buffer, answers.statuses._length);
    const auto own = std::find_if(statuses.begin(), statuses.end(),
                                  [this](const auto& status) { return status.observer_id == observer_id_; });
    if (own == statuses.end()) return statuses_abandoned(answers.bucket);
    bucket_ = answers.bucket;
    accept(*own);
    return true;
}

bool ReceivedMatch::statuses_abandoned(std::uint8_t bucket) {
    if (bucket_ != bucket) return true;  // other observers'
    bucket_.reset();
    answered_ = false;
    early_status_.reset();
    return false;
}

void ReceivedMatch::accept(const camera_director_ObserverStatus& status) {
    if (!is_valid(status)) {
        ++counters_.invalid;
        return;
    }
    if (!is_of_epoch(status.epoch)) {
        if (status.epoch > epoch_ || !described_) early_status_ = status;
        return;
    }
    answered_ = true;
    if (status_ && status_->camera_id != status.camera_id) track_.interrupt();
    status_ = cdir_shot_status_default();
    status_->state = status.state;
    status_->epoch = status.epoch;
    status_->camera_id = status.camera_id;
    copy_string(status_->reason, status.reason);
}

bool ReceivedMatch::accept(const camera_director_CameraFrame& frame, std::int64_t now) {
    if (!is_valid(frame, match_id_)) {
        ++counters_.invalid;
        return false;
    }
    if (!is_of_epoch(frame.epoch)) return false;
    if (is_repeated(frame)) {
        ++counters_.repeated;
        return false;
    }
    ++counters_.frames;
    forget_future(frame);
    if (!follows_last(frame)) track_.interrupt();
    last_frame_ = FrameId{frame.director_id, frame.frame_number, frame.pose_number, frame.frame_time};
    clock_.observe(frame.frame_time, now);
    if (const std::optional<cdir_camera> camera = camera_of_shot(frame)) {
        track_.add(frame.frame_time, *camera, (camera->flags & CDIR_CAMERA_CUT) == 0);
    } else {
        track_.interrupt();
    }
    return true;
}

// Missing frames may have held a cut. A director that takes over from one that it has followed counts on from
// its last frame; another one has other cameras.
bool ReceivedMatch::follows_last(const camera_director_CameraFrame& frame) {
    if (!last_frame_) return false;
    const std::uint32_t missing = frame.frame_number - last_frame_->frame_number - 1;
    if (last_frame_->director_id != frame.director_id) {
        ++counters_.hand_overs;
        return missing == 0;
    }
    // Frames of one director arrive in order: a smaller number means that the director has restarted.
    if (frame.frame_number > last_frame_->frame_number) counters_.gaps += missing;
    return missing == 0;
}

std::optional<cdir_camera> ReceivedMatch::camera_of_shot(const camera_director_CameraFrame& frame) const {
    const bool answered =
        status_ && (status_->state == CDIR_SHOT_ACCEPTED || status_->state == CDIR_SHOT_WAITING_FOR_PLAYER);
    if (!requested_ || !answered) return std::nullopt;
    const std::uint32_t* ids = frame.camera_id._buffer;
    const std::uint32_t count = frame.camera_id._length;
    const auto index = static_cast<std::uint32_t>(std::find(ids, ids + count, status_->camera_id) - ids);
    if (index == count) return std::nullopt;
    cdir_camera camera = camera_at(frame, index);
    const std::optional<View> before = track_.newest();
    if (camera.reason[0] == '\0' && before && before->camera.camera_id == camera.camera_id &&
        before->camera.target == camera.target)
        copy_reason(before->camera, camera);
    return camera;
}

void ReceivedMatch::set_requested(bool requested) {
    requested_ = requested;
    if (requested) return;
    bucket_.reset();
    status_.reset();
    early_status_.reset();
    track_.clear();
}

cdir_shot_status ReceivedMatch::shot_status() const {
    if (requested_ && status_ && answered_) return *status_;
    cdir_shot_status status = cdir_shot_status_default();
    status.state = requested_ ? CDIR_SHOT_UNANSWERED : CDIR_SHOT_NOT_REQUESTED;
    return status;
}

}  // namespace camdir::sdk
