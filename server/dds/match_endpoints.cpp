#include "dds/match_endpoints.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cstring>
#include <utility>

namespace camdir::dds {
namespace {

// A quarter of the shortest lease: some may come late. Each is a packet for every observer.
constexpr std::chrono::milliseconds slow_assertion_interval{250};
constexpr std::size_t max_kept = 32;  // as many as a reader of cameras keeps
// Each is sent to every observer: the next frame and other matches must not wait for many.
constexpr std::size_t statuses_beside_a_frame = 4;
constexpr std::size_t kept_in_a_step = 4;
// Of what is kept until the leader's lease ends, and of its last frame.
constexpr std::chrono::seconds max_age_beyond_lease{1};

std::int64_t now_realtime() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

// Ownership goes to the latest term, then by rank.
std::int32_t strength_of(const Sign& part) {
    return static_cast<std::int32_t>(part.term * (max_rank + 1) + part.rank);
}

}  // namespace

MatchEndpoints::MatchEndpoints(std::string match_id, const Leadership& leadership, std::uint64_t director_id,
                               WireCounters& counters)
    : match_id_(std::move(match_id)),
      counters_(counters),
      lease_(leadership.lease),
      succession_(director_id, leadership.rank, leadership.lease, Clock::now()),
      in_effect_(succession_.own()),
      encoder_(match_id_, director_id),
      status_encoder_(match_id_),
      strength_(strength_of(in_effect_)) {}

Result<std::unique_ptr<MatchEndpoints>> MatchEndpoints::open(const Participant& participant,
                                                             const std::string& match_id,
                                                             const Leadership& leadership,
                                                             std::uint64_t director_id,
                                                             WireCounters& counters) {
    std::unique_ptr<MatchEndpoints> match(new MatchEndpoints(match_id, leadership, director_id, counters));
    if (auto opened = match->open_readers(participant); !opened) return tl::unexpected(opened.error());
    if (auto opened = match->open_writers(participant, leadership); !opened) {
        return tl::unexpected(opened.error());
    }
    match->write_sign();
    return match;
}

Result<void> MatchEndpoints::open_readers(const Participant& participant) {
    const std::string partition = match_partition(match_id_);
    auto subscriber =
        created(dds_create_subscriber(participant.handle(), partition_qos({&partition, 1}).get(), nullptr),
                "creating the subscriber of " + partition);
    if (!subscriber) return tl::unexpected(subscriber.error());
    subscriber_ = std::move(*subscriber);

    for (const auto& [topic, reader] :
         {std::pair{Topic::pose_frame, &pose_reader_}, std::pair{Topic::match_event, &event_reader_},
          std::pair{Topic::observer_request, &request_reader_},
          std::pair{Topic::camera_frame, &camera_reader_}, std::pair{Topic::director_sign, &sign_reader_}}) {
        if (auto opened = open_reader(participant, topic, *reader); !opened) return opened;
    }
    if (!participant.has_movers()) return {};
    auto opened = open_reader(participant, Topic::mover_info, mover_info_reader_);
    if (opened) opened = open_reader(participant, Topic::mover_frame, mover_frame_reader_);
    return opened;
}

Result<void> MatchEndpoints::open_reader(const Participant& participant, Topic topic, dds_entity_t& reader) {
    reader =
        dds_create_reader(subscriber_.handle(), participant.topic(topic), reader_qos(topic).get(), nullptr);
    if (reader >= 0) return {};
    return dds_failure("creating the reader of " + match_partition(match_id_) + " " + topic_name(topic),
                       reader);
}

Result<void> MatchEndpoints::open_writers(const Participant& participant, const Leadership& leadership) {
    const std::string partition = match_partition(match_id_);
    auto publisher =
        created(dds_create_publisher(participant.handle(), partition_qos({&partition, 1}).get(), nullptr),
                "creating the publisher of " + partition);
    if (!publisher) return tl::unexpected(publisher.error());
    publisher_ = std::move(*publisher);

    for (const auto& [topic, writer] :
         {std::pair{Topic::shown_match, &shown_writer_}, std::pair{Topic::camera_frame, &camera_writer_},
          std::pair{Topic::observer_status, &status_writer_},
          std::pair{Topic::director_sign, &sign_writer_}}) {
        Qos qos = topic == Topic::director_sign ? sign_qos() : writer_qos(topic, leadership.lease);
        dds_qset_ownership_strength(qos.get(), strength_);
        *writer = dds_create_writer(publisher_.handle(), participant.topic(topic), qos.get(), nullptr);
        if (*writer < 0) {
            return dds_failure("creating the writer of " + partition + " " + topic_name(topic), *writer);
        }
    }
    return {};
}

template <class Change>
void MatchEndpoints::change(Change change) {
    {
        const std::lock_guard lock(deciding_);
        change(succession_, Clock::now());
        if (succession_.own() == in_effect_) return;
    }
    const std::lock_guard lock(writing_);
    put_into_effect();
}

// With writing_ held. Returns whether this director writes.
bool MatchEndpoints::put_into_effect() {
    Sign before;
    Sign part;
    {
        const std::lock_guard lock(deciding_);
        before = in_effect_;
        part = in_effect_ = succession_.own();
    }
    if (part == before) return part.leads;
    if (part.leads != before.leads)
        spdlog::info("match {}: this director {}", match_id_, part.leads ? "leads" : "stands by");
    write_sign();  // before what may take long
    if (before.leads && !part.leads) stand_by();
    if (part.leads && !before.leads) take_over();
    set_strength();
    note_what_is_owed();
    return part.leads;
}

// Readers would take what it wrote as leader for a standby's, which will own the match: not before they have
// forgotten that.
void MatchEndpoints::set_strength() {
    const std::int32_t strength = strength_of(in_effect_);
    if (strength == strength_ || (!in_effect_.leads && is_registered())) return;
    strength_ = strength;
    const Qos qos(dds_create_qos());
    dds_qset_ownership_strength(qos.get(), strength);
    for (const dds_entity_t writer : {shown_writer_, camera_writer_, status_writer_}) {
        const dds_return_t set = dds_set_qos(writer, qos.get());
        if (set < 0)
            spdlog::error("match {}: ownership strength {} not set: {}", match_id_, strength,
                          dds_strretcode(set));
    }
}

// A director that was stopped for too long finds out here, before it writes anything.
bool MatchEndpoints::leads() {
    {
        const std::lock_guard lock(deciding_);
        succession_.notice_absence(Clock::now());
    }
    return put_into_effect();
}

bool MatchEndpoints::may_write() {
    if (!leads()) return false;
    show_kept(kept_.size());
    return true;
}

// The thread that finds this out has other matches too, and its own signs to write.
void MatchEndpoints::take_over() {
    owes_shown_ = is_shown_registered_ = true;
    owed_statuses_ = written_statuses_;  // some may be empty meanwhile
    for (const auto& [number, bucket] : statuses_.used())
        if (!bucket.empty()) owed_statuses_.insert(number);
}

bool MatchEndpoints::catch_up() {
    const std::lock_guard lock(writing_);
    status_failed_ = false;
    if (!leads())
        unregister_next();
    else if (owes_cameras())
        show_kept(kept_in_a_step);
    else
        write_owed_statuses(1);
    note_what_is_owed();
    return owes_ && !status_failed_;
}

void MatchEndpoints::show_kept(std::size_t most) {
    if (!owes_cameras()) return;
    forget_shown();
    if (std::exchange(ended_unwritten_, false)) dispose_shown();
    if (std::exchange(owes_shown_, false)) begin_to_show();
    for (; most > 0 && !kept_.empty(); --most) {
        count(write_now(kept_.front().frame), counters_.camera_frames_written);
        kept_.pop_front();
    }
}

// Where there are few observers they have their answers before their cameras.
void MatchEndpoints::begin_to_show() {
    if (shown_)
        count(dds_write(shown_writer_, &shown_encoder_.encode(*shown_)), counters_.shown_matches_written);
    write_owed_statuses(statuses_beside_a_frame);
}

void MatchEndpoints::write_owed_statuses(std::size_t most) {
    for (; most > 0 && !owed_statuses_.empty() && !status_failed_; --most)
        write_next_status();
}

// In turn: one that changes again and again keeps no other waiting.
void MatchEndpoints::write_next_status() {
    auto next = owed_statuses_.upper_bound(last_status_);
    if (next == owed_statuses_.end()) next = owed_statuses_.begin();
    last_status_ = *next;
    written_statuses_.insert(*next);
    const dds_return_t written =
        dds_write(status_writer_, &status_encoder_.encode(*next, statuses_.bucket(*next)));
    count(written, counters_.statuses_written);
    status_failed_ = written < 0;
    if (!status_failed_) owed_statuses_.erase(next);
}

void MatchEndpoints::note_what_is_owed() {
    owes_ = in_effect_.leads ? owes_cameras() || !owed_statuses_.empty() : is_registered();
}

// What is too old to go on from, or to be shown.
void MatchEndpoints::forget_shown() {
    const auto oldest = Clock::now() - lease_ - max_age_beyond_lease;
    if (last_shown_ && last_shown_->seen < oldest) last_shown_.reset();
    while (!kept_.empty() && kept_.front().computed < oldest)
        drop_kept();
}

// Of what a take-over writes, and of statuses; of all else the caller counts.
void MatchEndpoints::count(dds_return_t written, WireCounter& counter) {
    if (written >= 0) {
        ++counter;
        return;
    }
    ++counters_.write_failures;
    if (const auto failures = failure_log_.due())
        spdlog::error("match {}: not written: {} ({} failures since the last such line)", match_id_,
                      dds_strretcode(written), *failures);
}

// The signs of other matches do not wait until readers have forgotten what this director wrote.
void MatchEndpoints::stand_by() {
    owes_shown_ = false;
    owed_statuses_.clear();
}

void MatchEndpoints::unregister_next() {
    if (std::exchange(is_shown_registered_, false)) {
        const camera_director_ShownMatch any{};  // it has no key
        dds_unregister_instance(shown_writer_, &any);
        unregister_cameras();
    } else if (!written_statuses_.empty()) {
        const camera_director_ObserverStatusBucket key = observer_status_key(*written_statuses_.begin());
        dds_unregister_instance(status_writer_, &key);
        written_statuses_.erase(written_statuses_.begin());
    }
    set_strength();
}

void MatchEndpoints::unregister_cameras() const {
    const camera_director_CameraFrame any{};  // it has no key
    dds_unregister_instance(camera_writer_, &any);
}

// Never an older one after a newer one.
void MatchEndpoints::write_sign() {
    const std::lock_guard lock(deciding_);
    const camera_director_DirectorSign sample = encode(match_id_, in_effect_);
    dds_write(sign_writer_, &sample);
}

Written MatchEndpoints::write(const director::MatchInfo& shown) {
    const std::lock_guard lock(writing_);
    const bool writes = may_write();
    shown_ = shown;
    if (!writes) return std::nullopt;
    return dds_write(shown_writer_, &shown_encoder_.encode(shown));
}

Written MatchEndpoints::end_shown() {
    const std::lock_guard lock(writing_);
    const bool writes = may_write();
    shown_.reset();
    last_shown_.reset();
    kept_.clear();
    ended_unwritten_ = !writes;
    if (!writes) return std::nullopt;
    return dispose_shown();
}

dds_return_t MatchEndpoints::dispose_shown() {
    const camera_director_ShownMatch any{};  // it has no key
    return dds_dispose(shown_writer_, &any);
}

Written MatchEndpoints::write(const director::CameraFrame& frame) {
    const std::lock_guard lock(writing_);
    const bool writes = may_write();
    if (!frame.cameras.empty()) {
        const std::lock_guard deciding(deciding_);
        succession_.produce(Clock::now());
    }
    if (writes) forget_shown();  // it may be of a match whose epoch was later
    if (is_shown({frame.epoch, frame.pose_number})) return std::nullopt;
    if (!writes) {
        keep(frame);
        return std::nullopt;
    }
    const dds_return_t written = write_now(frame);
    write_owed_statuses(statuses_beside_a_frame);
    note_what_is_owed();
    return written;
}

bool MatchEndpoints::write(const director::ObserverStatus& status) {
    const std::lock_guard lock(writing_);
    if (!statuses_.put(status)) return false;
    owe_status(status.observer_id);
    return true;
}

void MatchEndpoints::withdraw(const std::string& observer_id) {
    const std::lock_guard lock(writing_);
    if (statuses_.erase(observer_id)) owe_status(observer_id);
}

void MatchEndpoints::owe_status(const std::string& observer_id) {
    if (leads()) owed_statuses_.insert(StatusBuckets::number_of(observer_id));
    note_what_is_owed();
}

dds_return_t MatchEndpoints::write_now(const director::CameraFrame& frame) {
    wrote_frame_ = true;
    if (last_shown_) number_on(frame);
    const std::uint32_t offset = frame.epoch == numbered_epoch_ ? number_offset_ : 0;
    return dds_write(camera_writer_, &encoder_.encode(frame, now_realtime(), offset));
}

// From the leader's last frame, so that readers know whether they have missed something: a cut, perhaps.
void MatchEndpoints::number_on(const director::CameraFrame& first) {
    numbered_epoch_ = last_shown_->epoch;
    number_offset_ = last_shown_->frame_number + (misses_frames() ? 2 : 1) - first.frame_number;
    last_shown_.reset();
}

void MatchEndpoints::keep(const director::CameraFrame& frame) {
    if (kept_.size() >= max_kept) drop_kept();
    kept_.push_back({frame, Clock::now()});
}

// Nobody will have written it.
void MatchEndpoints::drop_kept() {
    dropped_ = {kept_.front().frame.epoch, kept_.front().frame.pose_number};
    kept_.pop_front();
}

bool MatchEndpoints::misses_frames() const {
    return dropped_ && !is_shown(*dropped_);
}

// By the leader. Frame numbers may wrap.
bool MatchEndpoints::is_shown(const PoseId& frame) const {
    if (!last_shown_ || frame.epoch > last_shown_->epoch) return false;
    return frame.epoch < last_shown_->epoch ||
           static_cast<std::int32_t>(frame.pose_number - last_shown_->pose_number) <= 0;
}

bool MatchEndpoints::see(const director::CameraFrame& shown) {
    const std::lock_guard lock(writing_);
    if (leads()) return false;
    if (shown_ && shown.epoch == shown_->epoch) ended_unwritten_ = false;
    last_shown_ = {shown.epoch, shown.frame_number, shown.pose_number, Clock::now()};
    while (!kept_.empty() && is_shown({kept_.front().frame.epoch, kept_.front().frame.pose_number}))
        kept_.pop_front();
    return true;
}

bool MatchEndpoints::hear() {
    bool awaited = false;
    change([&](Succession& succession, Clock::time_point now) { awaited = succession.hear(now); });
    return awaited;
}

void MatchEndpoints::see(const Sign& sign) {
    change([&](Succession& succession, Clock::time_point now) { succession.see(sign, now); });
}

void MatchEndpoints::leave(std::uint64_t director_id) {
    change([&](Succession& succession, Clock::time_point now) { succession.leave(director_id, now); });
}

Succession::Time MatchEndpoints::decide() {
    Succession::Time next;
    change([&](Succession& succession, Clock::time_point now) {
        succession.decide(now);
        next = succession.next_change(now);
    });
    return next;
}

bool MatchEndpoints::is_leading() {
    const std::lock_guard lock(deciding_);
    return in_effect_.leads;
}

bool MatchEndpoints::is_following() {
    const std::lock_guard lock(deciding_);
    return succession_.follows(Clock::now());
}

void MatchEndpoints::set_shards(std::uint64_t own, std::uint64_t home) {
    change([&](Succession& succession, Clock::time_point) { succession.set_shards(own, home); });
}

void MatchEndpoints::assert_liveliness() {
    change([](Succession& succession, Clock::time_point now) { succession.live(now); });
    write_sign();
    if (!wrote_frame_.exchange(false)) dds_assert_liveliness(camera_writer_);
    const auto now = Clock::now();
    if (now < next_slow_assertion_) return;
    next_slow_assertion_ = now + slow_assertion_interval;
    dds_assert_liveliness(status_writer_);
    // Whoever writes may take long. It comes again.
    const std::unique_lock lock(writing_, std::try_to_lock);
    if (lock && shown_ && leads() && !owes_shown_)
        dds_write(shown_writer_, &shown_encoder_.encode(*shown_));  // which asserts it too
    else
        dds_assert_liveliness(shown_writer_);
}

void MatchEndpoints::resign() {
    change([](Succession& succession, Clock::time_point now) { succession.resign(now); });
    const std::lock_guard lock(writing_);
    const camera_director_DirectorSign key = encode(match_id_, in_effect_);
    dds_dispose(sign_writer_, &key);
}

bool MatchEndpoints::hand_over() {
    {
        const std::lock_guard lock(deciding_);
        if (!succession_.has_successor(Clock::now())) return false;
    }
    resign();
    return true;
}

void MatchEndpoints::release_ownership() {
    unregister_cameras();
    // Deleting a writer unregisters its instances at the readers.
    camdir_delete_entity(status_writer_);
    camdir_delete_entity(shown_writer_);
}

}  // namespace camdir::dds
