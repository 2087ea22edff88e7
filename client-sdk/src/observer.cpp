#include "observer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <utility>

#include "checks.hpp"
#include "fixed_string.hpp"

namespace camdir::sdk {

namespace {

std::int64_t steady_ns() {
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

Entity condition_on(const Entity& reader) {
    return Entity("cannot create a read condition", dds_create_readcondition(reader.get(), DDS_ANY_STATE));
}

std::string text_or_empty(const char* field, const char* text, std::size_t max_bytes) {
    return checked_string(field, text == nullptr ? "" : text, 0, max_bytes);
}

camera_director_ObserverRequest key_of(const std::string& match_id, const std::string& observer_id) {
    camera_director_ObserverRequest sample{};
    copy_string(sample.match_id, match_id.c_str());
    copy_string(sample.observer_id, observer_id.c_str());
    return sample;
}

}  // namespace

Observer::Observer(std::shared_ptr<const Context> context, const std::string& match_id,
                   const std::string& observer_id, const cdir_observer_options& options)
    : context_(std::move(context)),
      match_id_(match_id),
      observer_id_(observer_id),
      match_(match_id, observer_id, options.interpolation_delay) {
    const dds_entity_t participant = context_->participant();
    const Topics& topics = context_->topics();
    publisher_ = make_publisher(participant, match_id);
    request_writer_ = topics.make_writer(publisher_.get(), Topic::observer_request);
    subscriber_ = make_subscriber(participant, match_id);
    info_reader_ = topics.make_reader(subscriber_.get(), Topic::shown_match);
    status_reader_ = topics.make_reader(subscriber_.get(), Topic::observer_status);
    frame_reader_ = topics.make_reader(subscriber_.get(), Topic::camera_frame);
    guard_ = Entity("cannot create a guard condition", dds_create_guardcondition(participant));
    info_condition_ = condition_on(info_reader_);
    status_condition_ = condition_on(status_reader_);
    frame_condition_ = condition_on(frame_reader_);
    waitset_ = Entity("cannot create a waitset", dds_create_waitset(participant));
    check_dds("cannot set a status mask",
              dds_set_status_mask(status_reader_.get(),
                                  DDS_SUBSCRIPTION_MATCHED_STATUS | DDS_LIVELINESS_CHANGED_STATUS));
    for (const Entity* entity :
         {&guard_, &info_condition_, &status_condition_, &frame_condition_, &status_reader_}) {
        check_dds("cannot attach to a waitset", dds_waitset_attach(waitset_.get(), entity->get(), 0));
    }
}

Observer::Request Observer::checked_request(const cdir_shot_request& request) const {
    require(std::ranges::all_of(request.reserved, [](std::uint8_t byte) { return byte == 0; }),
            "request.reserved is not 0");
    require(request.team == 0 || request.target == CDIR_CHOOSE_TARGET,
            "request.team is not 0: it is for CDIR_CHOOSE_TARGET alone");
    require(request.group_count <= CDIR_MAX_PLAYERS, "group_count is greater than CDIR_MAX_PLAYERS");
    require(request.group_count == 0 || request.group != nullptr, "group is null");
    require(request.target != CDIR_SHOW_GROUP ||
                (request.group_count >= 2 && request.group_count <= CDIR_MAX_GROUP_SHOT),
            "group_count is not 2 to CDIR_MAX_GROUP_SHOT, as CDIR_SHOW_GROUP takes");
    Request checked(allocator_);
    checked.target = request.target;
    checked.team = request.team;
    checked.group.assign(request.group, request.group + request.group_count);
    checked.profile =
        text_or_empty("profile", request.profile, sizeof camera_director_ObserverRequest::profile - 1);
    checked.overrides =
        text_or_empty("overrides", request.overrides, sizeof camera_director_ObserverRequest::overrides - 1);
    return checked;
}

void Observer::request(const cdir_shot_request& request) {
    Request checked = checked_request(request);
    const std::lock_guard lock(mutex_);
    std::swap(request_, checked);
    const dds_return_t written = write_request();
    if (written < 0) std::swap(request_, checked);
    check_written("ObserverRequest", written);
    match_.set_requested(true);
}

dds_return_t Observer::write_request() {
    camera_director_ObserverRequest sample = key_of(match_id_, observer_id_);
    sample.target = request_.target;
    sample.team = request_.team;
    sample.group._buffer = request_.group.data();
    sample.group._length = sample.group._maximum = static_cast<std::uint32_t>(request_.group.size());
    copy_string(sample.profile, request_.profile.c_str());
    copy_string(sample.overrides, request_.overrides.c_str());
    reminder_.asked(steady_ns());
    return dds_write(request_writer_.get(), &sample);
}

void Observer::withdraw() {
    const std::lock_guard lock(mutex_);
    if (!match_.requested()) throw Failure{CDIR_CONFLICT, "there is no request to withdraw"};
    const camera_director_ObserverRequest sample = key_of(match_id_, observer_id_);
    check_dds("cannot withdraw the request", dds_unregister_instance(request_writer_.get(), &sample));
    match_.set_requested(false);
}

cdir_status Observer::wait(std::int64_t timeout) {
    {
        const std::lock_guard lock(wait_mutex_);
        if (ending_) return CDIR_INTERRUPTED;
        ++waiters_;
    }
    const dds_return_t triggered = wait_for_news(timeout);
    const std::lock_guard lock(wait_mutex_);
    const bool interrupted = interrupted_ || ending_;
    if (--waiters_ == 0) {
        if (interrupted_) dds_set_guardcondition(guard_.get(), false);
        interrupted_ = false;
        no_waiters_.notify_all();
    }
    if (interrupted) return CDIR_INTERRUPTED;
    check_dds("cannot wait", triggered);
    return triggered > 0 ? CDIR_OK : CDIR_TIMEOUT;
}

// Whoever waits for the answer to a request does not poll meanwhile.
dds_return_t Observer::wait_for_news(std::int64_t timeout) {
    while (true) {
        const std::int64_t step = timeout < 0 ? Reminder::interval : std::min(timeout, Reminder::interval);
        const dds_return_t triggered = dds_waitset_wait(waitset_.get(), nullptr, 0, step);
        if (triggered != 0) return triggered;
        {
            const std::lock_guard lock(mutex_);
            ask_again();
        }
        if (timeout == step) return triggered;
        if (timeout > 0) timeout -= step;
    }
}

void Observer::interrupt() {
    const std::lock_guard lock(wait_mutex_);
    interrupted_ = true;
    check_dds("cannot interrupt", dds_set_guardcondition(guard_.get(), true));
}

void Observer::end_waits() {
    std::unique_lock lock(wait_mutex_);
    ending_ = true;
    dds_set_guardcondition(guard_.get(), true);
    no_waiters_.wait(lock, [this] { return waiters_ == 0; });
}

std::uint32_t Observer::poll() {
    const std::lock_guard lock(mutex_);
    take_info_and_status();
    ask_again();
    std::uint32_t count = 0;
    while (take_frame()) {
        ++count;
    }
    return count;
}

bool Observer::next_frame(cdir_camera_frame& frame, const StructArray<cdir_camera>& cameras) {
    const std::lock_guard lock(mutex_);
    take_info_and_status();
    ask_again();
    if (!take_frame()) return false;
    frame.camera_count = frame_sample_->camera_id._length;
    frame.epoch = frame_sample_->epoch;
    frame.director_id = frame_sample_->director_id;
    frame.frame_time = frame_sample_->frame_time;
    frame.source_time = frame_sample_->source_time;
    frame.write_time = frame_sample_->write_time;
    frame.frame_number = frame_sample_->frame_number;
    frame.pose_number = frame_sample_->pose_number;
    const std::uint32_t count = std::min(frame.camera_count, cameras.count());
    for (std::uint32_t i = 0; i < count; ++i) {
        cameras.write(i, camera_at(*frame_sample_, i));
    }
    return true;
}

std::optional<std::int64_t> Observer::display_time() {
    const std::lock_guard lock(mutex_);
    return match_.clock().at(steady_ns());
}

// Before the frames, so that these find their camera by the director's answer.
void Observer::take_info_and_status() {
    for (Taken taken; (taken = info_sample_.take(info_reader_)) != Taken::nothing;) {
        if (taken == Taken::data) {
            // One match has ended and another begun since: its epochs count anew.
            const std::uint32_t disposals = info_sample_.disposals();
            if (std::exchange(info_disposals_, disposals) != disposals) match_.match_ended();
            match_.accept(*info_sample_);
        } else if (taken == Taken::disposed) {
            match_.match_ended();
        } else {
            match_.info_abandoned();
        }
    }
    for (Taken taken; (taken = status_sample_.take(status_reader_)) != Taken::nothing;) {
        const bool holds = taken == Taken::data ? match_.accept(*status_sample_)
                                                : match_.statuses_abandoned(status_sample_->bucket);
        unanswered_loss_ = unanswered_loss_ || !holds;  // also of a writer that is back already
    }
    unanswered_loss_ = lost_director() || unanswered_loss_;
}

// A director that was only silent does not answer again by itself, and none answers what it had no room for.
void Observer::ask_again() {
    const bool answered = match_.shot_status().state != CDIR_SHOT_UNANSWERED;
    const bool due = reminder_.due(answered, steady_ns()) || unanswered_loss_;
    if (due && match_.requested()) unanswered_loss_ = write_request() < 0;
}

bool Observer::lost_director() const {
    dds_subscription_matched_status_t matched{};
    dds_liveliness_changed_status_t liveliness{};
    check_dds("ObserverStatus: cannot count its writers",
              dds_get_subscription_matched_status(status_reader_.get(), &matched));
    check_dds("ObserverStatus: cannot count its live writers",
              dds_get_liveliness_changed_status(status_reader_.get(), &liveliness));
    const auto left = static_cast<std::int32_t>(matched.total_count_change) - matched.current_count_change;
    return left > 0 || liveliness.not_alive_count_change > 0;
}

// Takes the next valid frame. Returns false when none waits.
bool Observer::take_frame() {
    for (Taken taken; (taken = frame_sample_.take(frame_reader_)) != Taken::nothing;) {
        if (taken == Taken::data && match_.accept(*frame_sample_, steady_ns())) return true;
    }
    return false;
}

std::uint32_t Observer::director_count() const {
    dds_subscription_matched_status_t matched{};
    check_dds("CameraFrame: cannot count its writers",
              dds_get_subscription_matched_status(frame_reader_.get(), &matched));
    return matched.current_count;
}

}  // namespace camdir::sdk
