#include "dds/subscriber.hpp"

#include <pthread.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <iterator>
#include <span>
#include <string_view>
#include <utility>

#include "dds/decode.hpp"

namespace camdir::dds {
namespace {

constexpr std::size_t samples_per_take = 32;
// The shapes of a sample take up to 30 ms to check, a hull up to 1 ms: what comes faster waits, of each
// sender the newest.
constexpr int bounding_share = 10;  // 1 / this of the thread's time at most
constexpr std::chrono::milliseconds bounding_turn{1};
constexpr std::chrono::milliseconds longest_answer{50};
constexpr std::int64_t longest_reception_ns = 10'000'000'000;  // beyond it the clocks differ

// 0 where the sender's clock is ahead. Any source_time is possible.
std::int64_t time_on_the_way(std::int64_t source_time) {
    const std::int64_t now =
        std::chrono::system_clock::now().time_since_epoch() / std::chrono::nanoseconds(1);
    return now - std::clamp(source_time, now - longest_reception_ns, now);
}

}  // namespace

Subscriber::Subscriber(const Participant& participant, Options options, MatchTable& table,
                       WireCounters& counters)
    : participant_(participant),
      options_(std::move(options)),
      table_(table),
      counters_(counters),
      admission_(*this, options_.shards, options_.limits),
      removal_(options_.limits.matches),
      match_info_sample_(topic_type(Topic::match_info), 1),
      pose_samples_(topic_type(Topic::pose_frame), samples_per_take),
      mover_info_samples_(topic_type(Topic::mover_info), samples_per_take),
      mover_frame_samples_(topic_type(Topic::mover_frame), samples_per_take),
      event_samples_(topic_type(Topic::match_event), samples_per_take),
      request_samples_(topic_type(Topic::observer_request), samples_per_take),
      camera_samples_(topic_type(Topic::camera_frame), samples_per_take),
      sign_samples_(topic_type(Topic::director_sign), samples_per_take) {}

Subscriber::~Subscriber() {
    stop();
    ready_.unwatch(match_info_reader_, match_infos_, &matched_);
}

Result<void> Subscriber::open() {
    auto subscriber = created(
        dds_create_subscriber(participant_.handle(), partition_qos(options_.partitions).get(), nullptr),
        "creating the subscriber of MatchInfo");
    if (!subscriber) return tl::unexpected(subscriber.error());
    match_info_subscriber_ = std::move(*subscriber);
    match_info_reader_ =
        dds_create_reader(match_info_subscriber_.handle(), participant_.topic(Topic::match_info),
                          reader_qos(Topic::match_info).get(), nullptr);
    if (match_info_reader_ < 0)
        return dds_failure("creating the reader of MatchInfo in /dds/partitions", match_info_reader_);
    return ready_.watch(match_info_reader_, match_infos_, &matched_);
}

void Subscriber::start(director::Ingress& ingress) {
    assert(!thread_.joinable());
    ingress_ = &ingress;
    thread_ = std::thread([this] { run(); });
    ::pthread_setname_np(thread_.native_handle(), "reception");
}

void Subscriber::stop() {
    if (!thread_.joinable()) return;
    stopping_ = true;
    ready_.wake();
    thread_.join();
    for (const auto& [id, match] : matches_)
        unwatch(*match);
    matches_.clear();
}

void Subscriber::forget(const std::string& match_id) {
    {
        const std::lock_guard lock(mutex_);
        forgotten_.push_back(match_id);
    }
    ready_.wake();
}

void Subscriber::give_up(const std::string& match_id) {
    {
        const std::lock_guard lock(mutex_);
        given_up_.push_back(match_id);
    }
    ready_.wake();
}

void Subscriber::reshard(Shards shards) {
    {
        const std::lock_guard lock(mutex_);
        new_shards_ = std::move(shards);
    }
    ready_.wake();
}

bool Subscriber::responsive(std::chrono::nanoseconds limit) const {
    return Clock::now() - next_assertion_.load() <= limit && removal_.responsive(limit);
}

void Subscriber::run() noexcept {
    next_assertion_ = Clock::now();
    listened_ = Clock::now();
    while (!stopping_) {
        const auto& ready = ready_.wait(std::min(
            {next_assertion_.load(), next_notice_, next_decision_, to_bound_.due(), to_catch_up_.due()}));
        notice_absence();
        take_ready(ready);
        bound_movers();
        mark_given_up();
        remove_forgotten();
        put_new_shards_into_effect();
        take_signs_of_new_matches();  // an assertion decides too
        if (Clock::now() >= next_assertion_.load()) {
            assert_liveliness();
            ask_again_for_bounds();
            leave_matches();
            admit_waiting();
            take_signs_of_new_matches();
            admission_.forget_idle(Clock::now());
            next_assertion_ = Clock::now() + assertion_interval();
        }
        // Last, when all signs that had come by then are seen.
        if (Clock::now() >= next_decision_) decide();
        if (Clock::now() >= next_notice_) notice_what_is_owed();
        if (Clock::now() >= to_catch_up_.due()) catch_up();
    }
    next_assertion_ = Clock::time_point::max();
}

// Also of the whole process, which was stopped.
void Subscriber::notice_absence() {
    const auto now = Clock::now();
    if (now - listened_ > options_.leadership.lease)
        for (const auto& [id, match] : matches_)
            match->ownership.resume(now);
    listened_ = now;
}

void Subscriber::take_ready(const std::vector<ReadyList::Source*>& ready) {
    poses_taken_ = Clock::now();
    bool match_infos = false;
    bool matched = false;
    for (ReadyList::Source* source : ready) {
        if (source == &match_infos_) {
            match_infos = true;
        } else if (source == &matched_) {
            matched = true;
        } else {
            const Source& of_match = static_cast<const Source&>(*source);
            (this->*of_match.take)(of_match.match);
            take_waiting_poses();
        }
    }
    hand_on_poses();
    // Last, because it may remove matches whose sources are ready.
    if (match_infos) take_match_infos();
    if (matched) notice_unmatched();
}

void Subscriber::assert_liveliness() {
    // So early that the next director takes over within a lease.
    if (!ingress_->responsive(options_.leadership.lease - assertion_interval())) {
        ++counters_.liveliness_withheld;
        for (const auto& [id, match] : matches_)
            match->endpoints->resign();
    } else {
        for (const auto& [id, match] : matches_)
            match->endpoints->assert_liveliness();
    }
    counters_.matches_led = static_cast<std::uint32_t>(std::ranges::count_if(
        matches_, [](const auto& entry) { return entry.second->endpoints->is_leading(); }));
}

// In turn: those for which there is no time have theirs after a pause.
void Subscriber::decide() {
    const auto end = Clock::now() + longest_turn();
    next_decision_ = Clock::time_point::max();
    auto next = matches_.find(next_to_decide_);
    for (std::size_t left = matches_.size(); left > 0; --left, ++next) {
        if (next == matches_.end()) next = matches_.begin();
        const auto& [id, match] = *next;
        if (Clock::now() >= end) {
            next_to_decide_ = id;
            next_decision_ = std::min(next_decision_, Clock::now() + longest_turn());
            return;
        }
        next_decision_ = std::min(next_decision_, match->endpoints->decide());
        notice_what_is_owed(*match);
    }
}

// Also of matches of which nothing else is written, whose observers ask again what is not answered.
void Subscriber::notice_what_is_owed() {
    for (const auto& [id, match] : matches_)
        notice_what_is_owed(*match);
    next_notice_ = Clock::now() + std::min(assertion_interval(), longest_answer);
}

void Subscriber::notice_what_is_owed(Match& match) {
    if (match.endpoints->owes()) to_catch_up_.add(match.id());
}

// Of each match its cameras come first. What takes too long goes on after a pause, and what failed with the
// next assertion.
void Subscriber::catch_up() {
    const bool some_are_left =
        to_catch_up_.take_turns(Clock::now() + longest_turn(), [this](const std::string& match_id) {
            const auto found = matches_.find(match_id);
            return found != matches_.end() && found->second->endpoints->catch_up();
        });
    if (some_are_left) to_catch_up_.pause_until(Clock::now() + longest_turn());
}

void Subscriber::drop(Topic topic, ValidationError error, const std::string& match_id) {
    const auto reason = static_cast<std::size_t>(error);
    ++counters_.of(topic).dropped[reason];
    if (const auto count = drop_logs_[static_cast<std::size_t>(topic)][reason].due()) {
        spdlog::warn("{} of match '{}' dropped: {} ({} since the last such line)", topic_name(topic),
                     match_id, validation_error_names[reason], *count);
    }
}

template <class Sample, class Visit>
void Subscriber::take(TakeBuffer<Sample>& buffer, dds_entity_t reader, ReadyList::Source& source,
                      Visit visit) {
    if (buffer.take(reader, visit)) ready_.report(source);
}

// One by one, because a match takes milliseconds to begin: for a turn, and the rest are ready again.
void Subscriber::take_match_infos() {
    const auto visit = [this](const auto& sample, const auto& info) {
        // The state is the instance's after the last sample.
        if (info.valid_data) match_info_found(sample, info);
        if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) match_info_lost(sample, info);
    };
    const auto end = Clock::now() + longest_turn();
    while (match_info_sample_.take(match_info_reader_, visit)) {
        if (Clock::now() >= end) return ready_.report(match_infos_);
        take_waiting_poses();
    }
}

template <class Sample, class Message>
bool Subscriber::is_valid(const Match& match, Topic topic, const Sample& sample, Message& message) {
    if (sample.match_id != match.id()) {
        drop(topic, ValidationError::wrong_partition, match.id());
        return false;
    }
    if (const auto error = decode(sample, message)) {
        drop(topic, *error, match.id());
        return false;
    }
    return true;
}

bool Subscriber::accept(Match& match, Topic topic) {
    ++counters_.of(topic).accepted;
    const bool waits = match.service == Service::given_up && topic == Topic::observer_request;
    if (match.service == Service::served || waits) return true;
    return Clock::now() >= match.next_introduction && introduce(match);
}

bool Subscriber::is_of_owner(Match& match, const dds_sample_info_t& info) {
    const SenderId* sender = match.pose_senders.find(match.endpoints->pose_reader(), info.publication_handle);
    if (sender == nullptr || !match.ownership.knows(*sender)) return false;
    const auto limit = ingress_->silence_limit(match.ownership.info());
    const auto standing = match.ownership.send(*sender, limit, Clock::now());
    if (standing == Ownership::Standing::successor) begin_anew(match);
    return standing != Ownership::Standing::stranger;
}

void Subscriber::take_poses(Match& match) {
    if (!match.movers.empty()) {  // they are written before the poses
        take_mover_infos(match);
        take_mover_frames(match);
    }
    take(pose_samples_, match.endpoints->pose_reader(), match.poses,
         [&](const auto& sample, const auto& info) {
             if (!info.valid_data || !is_valid(match, Topic::pose_frame, sample, pose_frame_)) return;
             if (!is_of_owner(match, info))
                 return drop(Topic::pose_frame, ValidationError::not_owner, match.id());
             if (match.endpoints->hear()) next_decision_ = Clock::now();
             if (!accept(match, Topic::pose_frame)) return;
             if (pose_frame_.source_time != 0)  // it is known
                 counters_.reception.add(time_on_the_way(pose_frame_.source_time));
             if (arrived_ == arrivals_.size()) arrivals_.emplace_back();
             director::PoseArrival& arrival = arrivals_[arrived_++];
             arrival.match_id = match.id();
             std::swap(arrival.frame, pose_frame_);
             arrival.frame.movers = match.movers.at(match.ownership.owner().sender, arrival.frame.epoch,
                                                    arrival.frame.frame_time);
         });
}

// At once: what others send could push the owner's out of the reader.
void Subscriber::take_mover_infos(Match& match) {
    const dds_entity_t reader = match.endpoints->mover_info_reader();
    take(mover_info_samples_, reader, match.mover_infos, [&](const auto& sample, const auto& info) {
        if (!info.valid_data) return;
        auto described = std::make_shared<director::MoverInfo>();
        if (!is_valid(match, Topic::mover_info, sample, *described)) return;
        const SenderId* sender = match.mover_info_senders.find(reader, info.publication_handle);
        const bool counts = comes_from_owner(match, Topic::mover_info, sender);
        if (sender != nullptr && match.movers.admit(*sender, info.publication_handle, match.ownership))
            match.movers.put(*sender, std::move(described), !counts);
    });
    ask_for_bounds(match);
    bound_movers();
}

void Subscriber::ask_for_bounds(Match& match) {
    if (match.movers.has_unbounded()) to_bound_.add(match.id());
}

// Whose description waits may own the match now.
void Subscriber::ask_again_for_bounds() {
    for (const auto& [id, match] : matches_)
        ask_for_bounds(*match);
}

// The only decoding that takes milliseconds waits where there is much of it. A step is a hull.
void Subscriber::bound_movers() {
    const auto begun = Clock::now();
    if (begun < to_bound_.due()) return;
    to_bound_.take_turns(begun + bounding_turn, [this](const std::string& match_id) {
        const auto found = matches_.find(match_id);
        return found != matches_.end() && bound_next(*found->second);
    });
    to_bound_.pause_until(Clock::now() + bounding_share * (Clock::now() - begun));
}

// Whether the match has another: not where only strangers have described movers.
bool Subscriber::bound_next(Match& match) {
    const auto step = match.movers.bound_next(match.ownership);
    if (!step) return false;
    if (step->is_accepted) ++counters_.of(Topic::mover_info).accepted;
    if (step->error) drop(Topic::mover_info, *step->error, match.id());
    return match.movers.has_unbounded();
}

void Subscriber::take_mover_frames(Match& match) {
    const dds_entity_t reader = match.endpoints->mover_frame_reader();
    take(mover_frame_samples_, reader, match.mover_frames, [&](const auto& sample, const auto& info) {
        if (!info.valid_data) return;
        auto frame = std::make_shared<director::MoverFrame>();
        if (!is_valid(match, Topic::mover_frame, sample, *frame)) return;
        const SenderId* sender = match.mover_frame_senders.find(reader, info.publication_handle);
        if (comes_from_owner(match, Topic::mover_frame, sender)) ++counters_.of(Topic::mover_frame).accepted;
        if (sender != nullptr && match.movers.admit(*sender, info.publication_handle, match.ownership))
            match.movers.put(*sender, std::move(frame));
    });
}

bool Subscriber::comes_from_owner(const Match& match, Topic topic, const SenderId* sender) {
    if (sender != nullptr && match.ownership.owns(*sender)) return true;
    drop(topic, ValidationError::not_owner, match.id());
    return false;
}

void Subscriber::notice_unmatched_movers(Match& match) {
    // Else what is still to be read of a sender that is gone would be kept.
    match.mover_info_senders = match.mover_frame_senders = {};
    std::vector<WriterHandle> matched;
    std::ranges::merge(matched_writers(match.endpoints->mover_info_reader()),
                       matched_writers(match.endpoints->mover_frame_reader()), std::back_inserter(matched));
    match.movers.retain(matched);
}

void Subscriber::hand_on_poses() {
    if (arrived_ > 0) ingress_->receive(std::span(arrivals_).first(std::exchange(arrived_, 0)));
}

// Between what may take long, many matches that begin or much else that is ready: else the frames that wait
// meanwhile would come out together, late, and all but the newest few be lost.
void Subscriber::take_waiting_poses() {
    constexpr std::chrono::milliseconds interval(4);
    if (Clock::now() - poses_taken_ < interval) return;
    for (const auto& [id, match] : matches_)
        take_poses(*match);
    hand_on_poses();
    poses_taken_ = Clock::now();
}

void Subscriber::take_events(Match& match) {
    take(event_samples_, match.endpoints->event_reader(), match.events,
         [&](const auto& sample, const auto& info) {
             if (!info.valid_data || !is_valid(match, Topic::match_event, sample, match_event_)) return;
             const SenderId* sender =
                 match.event_senders.find(match.endpoints->event_reader(), info.publication_handle);
             if (!comes_from_owner(match, Topic::match_event, sender)) return;
             if (accept(match, Topic::match_event)) ingress_->receive(match.id(), match_event_);
         });
}

void Subscriber::take_requests(Match& match) {
    take(request_samples_, match.endpoints->request_reader(), match.requests,
         [&](const auto& sample, const auto& info) {
             if (info.valid_data && is_valid(match, Topic::observer_request, sample, observer_request_))
                 request_found(match, info.publication_handle);
             if (info.instance_state != DDS_ALIVE_INSTANCE_STATE && sample.match_id == match.id())
                 request_lost(match, sample.observer_id, info);
         });
}

void Subscriber::request_found(Match& match, WriterHandle writer) {
    // Nobody will tell of the end of a writer that has left.
    const MatchedWriter found = find_writer(match.endpoints->request_reader(), writer);
    if (!found) return drop(Topic::observer_request, ValidationError::not_owner, match.id());
    using Standing = RequestOwners::Standing;
    const Standing standing = match.request_owners.put(observer_request_, writer, sender_of(*found));
    if (standing == Standing::stranger)
        return drop(Topic::observer_request, ValidationError::not_owner, match.id());
    if (standing == Standing::refused)
        return drop(Topic::observer_request, ValidationError::participant_limit, match.id());
    pass_on(match, observer_request_);
}

void Subscriber::pass_on(Match& match, const director::ObserverRequest& request) {
    if (!accept(match, Topic::observer_request)) return;
    ingress_->receive(request);
    cancel_forget(match.id());
}

void Subscriber::request_lost(Match& match, const std::string& observer_id, const dds_sample_info_t& info) {
    const auto outcome =
        info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE
            ? match.request_owners.dispose(observer_id, info.publication_handle, !info.valid_data)
            : match.request_owners.lose(observer_id);
    if (outcome) put_into_effect(*outcome, match);
}

void Subscriber::put_into_effect(const RequestOwners::Outcome& outcome, Match& match) {
    if (outcome.next)
        pass_on(match, *outcome.next);
    else
        ingress_->request_ended(match.id(), outcome.observer_id);
}

// DDS tells of the end of a request when all who have written it are gone.
void Subscriber::notice_unmatched_requests(Match& match) {
    const dds_entity_t reader = match.endpoints->request_reader();
    for (const auto& outcome : match.request_owners.retain(matched_writers(reader)))
        put_into_effect(outcome, match);
}

void Subscriber::take_cameras(Match& match) {
    take(camera_samples_, match.endpoints->camera_reader(), match.cameras,
         [&](const auto& sample, const auto& info) {
             if (!info.valid_data || !is_valid(match, Topic::camera_frame, sample, shown_)) return;
             ++counters_.of(Topic::camera_frame).accepted;
             if (match.endpoints->see(shown_)) ingress_->follow(match.id(), shown_);
         });
}

void Subscriber::take_signs(Match& match) {
    take_cameras(match);  // what a leader wrote before it left
    take(sign_samples_, match.endpoints->sign_reader(), match.signs,
         [&](const auto& sample, const auto& info) {
             Sign sign;
             // One whose writer is gone, as far as DDS knows, may be out of reach: its lease will tell.
             if (info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE) {
                 match.endpoints->leave(sample.director_id);
             } else if (info.valid_data && is_valid(match, Topic::director_sign, sample, sign)) {
                 if (sign.director_id == options_.director_id) return warn_of_namesake(match.id());
                 match.endpoints->see(sign);
                 ++counters_.of(Topic::director_sign).accepted;
                 next_decision_ = std::min(next_decision_, match.endpoints->decide());
             }
         });
    notice_what_is_owed(match);
}

// The director may have taken longer to begin them than it looks for others.
void Subscriber::take_signs_of_new_matches() {
    for (const std::string& match_id : new_matches_)
        if (const auto known = matches_.find(match_id); known != matches_.end()) take_signs(*known->second);
    new_matches_.clear();
}

void Subscriber::warn_of_namesake(const std::string& match_id) {
    if (const auto count = namesake_log_.due())
        spdlog::error(
            "match {}: another director has the id {} too: both lead. Give each its own "
            "/dds/director_id, or none ({} signs since the last such line)",
            match_id, options_.director_id, *count);
}

}  // namespace camdir::dds
