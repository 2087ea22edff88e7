#include "dds/subscriber.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <cassert>
#include <chrono>
#include <string_view>

#include "dds/decode.hpp"

namespace camdir::dds {
namespace {

constexpr std::size_t samples_per_take = 32;

// Tags in the waitset that are not a Source.
const char guard_tag = 0;
const char match_info_tag = 0;

dds_attach_t attachment(const void* tag) {
    return reinterpret_cast<dds_attach_t>(tag);
}

}  // namespace

Subscriber::Subscriber(const Participant& participant, Options options, MatchTable& table,
                       WireCounters& counters)
    : participant_(participant),
      options_(std::move(options)),
      table_(table),
      counters_(counters),
      match_info_samples_(topic_type(Topic::match_info), samples_per_take),
      pose_samples_(topic_type(Topic::pose_frame), samples_per_take),
      event_samples_(topic_type(Topic::match_event), samples_per_take),
      request_samples_(topic_type(Topic::observer_request), samples_per_take) {}

Subscriber::~Subscriber() {
    stop();
}

Result<void> Subscriber::open() {
    auto waitset = created(dds_create_waitset(participant_.handle()), "creating the waitset");
    if (!waitset) return tl::unexpected(waitset.error());
    waitset_ = std::move(*waitset);
    auto guard = created(dds_create_guardcondition(participant_.handle()), "creating the guard condition");
    if (!guard) return tl::unexpected(guard.error());
    guard_ = std::move(*guard);
    if (const auto code = dds_waitset_attach(waitset_.handle(), guard_.handle(), attachment(&guard_tag));
        code < 0) {
        return dds_failure("attaching the guard condition", code);
    }
    triggered_.resize(2);

    auto subscriber = created(
        dds_create_subscriber(participant_.handle(), partition_qos(options_.partitions).get(), nullptr),
        "creating the subscriber of MatchInfo");
    if (!subscriber) return tl::unexpected(subscriber.error());
    match_info_subscriber_ = std::move(*subscriber);
    match_info_reader_ =
        dds_create_reader(match_info_subscriber_.handle(), participant_.topic(Topic::match_info),
                          reader_qos(Topic::match_info).get(), nullptr);
    if (match_info_reader_ < 0) return dds_failure("creating the reader of MatchInfo", match_info_reader_);
    return watch(match_info_reader_, &match_info_tag);
}

// The condition is deleted and detached with its reader.
Result<void> Subscriber::watch(dds_entity_t reader, const void* tag) {
    const dds_entity_t condition = dds_create_readcondition(reader, DDS_ANY_STATE);
    if (condition < 0) return dds_failure("creating a read condition", condition);
    const dds_return_t attached = dds_waitset_attach(waitset_.handle(), condition, attachment(tag));
    if (attached < 0) return dds_failure("attaching a read condition", attached);
    return {};
}

void Subscriber::start(director::Ingress& ingress) {
    assert(!thread_.joinable());
    ingress_ = &ingress;
    thread_ = std::thread([this] { run(); });
}

void Subscriber::stop() {
    if (!thread_.joinable()) return;
    stopping_ = true;
    dds_set_guardcondition(guard_.handle(), true);
    thread_.join();
    matches_.clear();
}

void Subscriber::forget(const std::string& match_id) {
    {
        const std::lock_guard lock(forgotten_mutex_);
        forgotten_.push_back(match_id);
    }
    dds_set_guardcondition(guard_.handle(), true);
}

void Subscriber::run() noexcept {
    // Four assertions per lease: some may come late.
    const std::chrono::nanoseconds interval = std::chrono::nanoseconds(options_.leadership.lease) / 4;
    Clock::time_point next_assertion = Clock::now();
    while (!stopping_) {
        const std::chrono::nanoseconds patience =
            std::max(std::chrono::nanoseconds(next_assertion - Clock::now()), std::chrono::nanoseconds(0));
        const dds_return_t count =
            dds_waitset_wait(waitset_.handle(), triggered_.data(), triggered_.size(), patience.count());
        if (count > 0) take_triggered(static_cast<std::size_t>(count));
        remove_forgotten();
        if (Clock::now() >= next_assertion) {
            assert_liveliness();
            next_assertion = Clock::now() + interval;
        }
    }
}

void Subscriber::take_triggered(std::size_t count) {
    bool match_infos = false;
    for (std::size_t i = 0; i < std::min(count, triggered_.size()); ++i) {
        const dds_attach_t tag = triggered_[i];
        if (tag == attachment(&guard_tag)) {
            dds_set_guardcondition(guard_.handle(), false);
        } else if (tag == attachment(&match_info_tag)) {
            match_infos = true;
        } else {
            const Source& source = *reinterpret_cast<const Source*>(tag);
            (this->*source.take)(*source.match);
        }
    }
    // Last, because it may remove matches whose sources are reported above.
    if (match_infos) take_match_infos();
}

void Subscriber::assert_liveliness() {
    if (!ingress_->responsive(options_.leadership.lease)) {
        ++counters_.liveliness_withheld;
        return;
    }
    for (const auto& [id, match] : matches_)
        match->endpoints->assert_liveliness();
}

void Subscriber::drop(Topic topic, ValidationError error, const std::string& match_id) {
    const auto reason = static_cast<std::size_t>(error);
    ++counters_.of(topic).dropped[reason];
    if (const auto count = drop_logs_[static_cast<std::size_t>(topic)][reason].due()) {
        spdlog::warn("{} of match '{}' dropped: {} ({} since the last such line)", topic_name(topic),
                     match_id, validation_error_names[reason], *count);
    }
}

void Subscriber::take_match_infos() {
    match_info_samples_.take(match_info_reader_, [this](const auto& sample, const auto& info) {
        // The state is the instance's after the last sample.
        if (info.valid_data) match_info_found(sample, info);
        if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) match_info_lost(sample.match_id, info);
    });
}

void Subscriber::match_info_found(const camera_director_MatchInfo& sample, const dds_sample_info_t& info) {
    director::MatchInfo message;
    if (const auto error = decode(sample, message)) {
        return drop(Topic::match_info, *error, sample.match_id);
    }
    if (!written_in(info, match_partition(message.match_id))) {
        return drop(Topic::match_info, ValidationError::wrong_partition, sample.match_id);
    }
    ++counters_.of(Topic::match_info).accepted;
    const bool known = matches_.contains(message.match_id);
    // The endpoints first, because the director publishes at once. It counts and logs what it refuses.
    if (!known && !(ingress_->admit(message.match_id) && add_match(message.match_id))) return;
    if (!ingress_->receive(message)) return;
    Match& match = *matches_[message.match_id];
    match.info = std::move(message);
    match.server = info.publication_handle;
    match.has_server = true;
    match.forgotten = false;
    cancel_forget(match.info.match_id);
}

// The director knows the match again: an earlier forget() must not remove it.
void Subscriber::cancel_forget(const std::string& match_id) {
    const std::lock_guard lock(forgotten_mutex_);
    std::erase(forgotten_, match_id);
}

bool Subscriber::add_match(const std::string& match_id) {
    const auto opened = open_match(match_id);
    if (opened) return true;
    ++counters_.endpoint_failures;
    spdlog::error("match '{}' cannot be served: {}", match_id, opened.error().message);
    remove_match(match_id);
    ingress_->match_ended(match_id);
    return false;
}

// On failure the caller removes the match.
Result<void> Subscriber::open_match(const std::string& match_id) {
    auto endpoints = MatchEndpoints::open(participant_, match_id, options_.leadership, options_.director_id);
    if (!endpoints) return tl::unexpected(endpoints.error());
    auto& match = matches_[match_id];
    match = std::make_unique<Match>();
    match->endpoints = std::move(*endpoints);
    match->poses = {match.get(), &Subscriber::take_poses};
    match->events = {match.get(), &Subscriber::take_events};
    match->requests = {match.get(), &Subscriber::take_requests};
    table_.add(match->endpoints);
    counters_.matches = static_cast<std::uint32_t>(matches_.size());
    for (const auto& [reader, source] : {std::pair{match->endpoints->pose_reader(), &match->poses},
                                         std::pair{match->endpoints->event_reader(), &match->events},
                                         std::pair{match->endpoints->request_reader(), &match->requests}}) {
        if (auto watched = watch(reader, source); !watched) return watched;
    }
    triggered_.resize(2 + 3 * matches_.size());
    return {};
}

void Subscriber::remove_match(const std::string& match_id) {
    table_.remove(match_id);
    matches_.erase(match_id);
    counters_.matches = static_cast<std::uint32_t>(matches_.size());
}

void Subscriber::match_info_lost(const std::string& match_id, const dds_sample_info_t& info) {
    const auto known = matches_.find(match_id);
    if (known == matches_.end()) return;
    Match& match = *known->second;
    const bool over = info.instance_state == DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE;
    if (over && info.publication_handle != match.server) return;  // not its game server
    match.has_server = false;
    if (match.forgotten) return remove_match(match_id);
    if (over) {
        ingress_->match_ended(match_id);
    } else {
        ingress_->server_lost(match_id);
    }
}

void Subscriber::remove_forgotten() {
    std::vector<std::string> forgotten;
    {
        const std::lock_guard lock(forgotten_mutex_);
        forgotten.swap(forgotten_);
    }
    for (const std::string& match_id : forgotten) {
        const auto known = matches_.find(match_id);
        if (known == matches_.end()) continue;
        // A paused game server may send poses again without another MatchInfo.
        if (known->second->has_server) {
            known->second->forgotten = true;
        } else {
            remove_match(match_id);
        }
    }
}

// Announces a match again that the director has forgotten. Returns false when it was refused.
bool Subscriber::reintroduce(Match& match) {
    if (match.forgotten) match.forgotten = !ingress_->receive(match.info);
    return !match.forgotten;
}

bool Subscriber::written_in(const dds_sample_info_t& info, const std::string& partition) const {
    using Endpoint = std::unique_ptr<dds_builtintopic_endpoint_t, decltype(&dds_builtintopic_free_endpoint)>;
    const Endpoint writer(dds_get_matched_publication_data(match_info_reader_, info.publication_handle),
                          dds_builtintopic_free_endpoint);
    if (!writer) return false;  // the writer has left
    std::uint32_t count = 0;
    char** names = nullptr;
    if (!dds_qget_partition(writer->qos, &count, &names)) return false;
    const bool written =
        std::any_of(names, names + count, [&](const char* name) { return name == partition; });
    for (std::uint32_t i = 0; i < count; ++i)
        dds_free(names[i]);
    dds_free(names);
    return written;
}

template <class Sample, class Message>
bool Subscriber::accept(Match& match, Topic topic, const Sample& sample, Message& message) {
    const std::string& match_id = match.info.match_id;
    if (sample.match_id != match_id) {
        drop(topic, ValidationError::wrong_partition, match_id);
        return false;
    }
    if (const auto error = decode(sample, message)) {
        drop(topic, *error, match_id);
        return false;
    }
    ++counters_.of(topic).accepted;
    return reintroduce(match);
}

void Subscriber::take_poses(Match& match) {
    pose_samples_.take(match.endpoints->pose_reader(), [&](const auto& sample, const auto& info) {
        if (info.valid_data && accept(match, Topic::pose_frame, sample, pose_frame_))
            ingress_->receive(match.info.match_id, pose_frame_);
    });
}

void Subscriber::take_events(Match& match) {
    event_samples_.take(match.endpoints->event_reader(), [&](const auto& sample, const auto& info) {
        if (info.valid_data && accept(match, Topic::match_event, sample, match_event_))
            ingress_->receive(match.info.match_id, match_event_);
    });
}

void Subscriber::take_requests(Match& match) {
    request_samples_.take(match.endpoints->request_reader(), [&](const auto& sample, const auto& info) {
        const std::string& match_id = match.info.match_id;
        if (info.instance_state != DDS_ALIVE_INSTANCE_STATE) {
            if (sample.match_id == match_id) ingress_->request_ended(match_id, sample.observer_id);
        } else if (info.valid_data && accept(match, Topic::observer_request, sample, observer_request_)) {
            ingress_->receive(observer_request_);
            cancel_forget(match_id);
        }
    });
}

}  // namespace camdir::dds
