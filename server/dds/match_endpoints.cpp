#include "dds/match_endpoints.hpp"

#include <chrono>
#include <cstring>
#include <tuple>

namespace camdir::dds {
namespace {

// A quarter of the shortest lease: some may come late. Each is a packet for every observer.
constexpr std::chrono::milliseconds slow_assertion_interval{250};

std::int64_t now_realtime() {
    return std::chrono::duration_cast<std::chrono::nanoseconds>(
               std::chrono::system_clock::now().time_since_epoch())
        .count();
}

}  // namespace

Result<std::unique_ptr<MatchEndpoints>> MatchEndpoints::open(const Participant& participant,
                                                             const std::string& match_id,
                                                             const Leadership& leadership,
                                                             std::uint64_t director_id) {
    std::unique_ptr<MatchEndpoints> match(new MatchEndpoints(match_id, director_id));
    if (auto opened = match->open_readers(participant); !opened) return tl::unexpected(opened.error());
    if (auto opened = match->open_writers(participant, leadership); !opened) {
        return tl::unexpected(opened.error());
    }
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
          std::pair{Topic::observer_request, &request_reader_}}) {
        *reader = dds_create_reader(subscriber_.handle(), participant.topic(topic), reader_qos(topic).get(),
                                    nullptr);
        if (*reader < 0) {
            return dds_failure("creating the reader of " + partition + " " + topic_name(topic), *reader);
        }
    }
    return {};
}

Result<void> MatchEndpoints::open_writers(const Participant& participant, const Leadership& leadership) {
    const std::string partition = match_partition(match_id_);
    auto publisher =
        created(dds_create_publisher(participant.handle(), partition_qos({&partition, 1}).get(), nullptr),
                "creating the publisher of " + partition);
    if (!publisher) return tl::unexpected(publisher.error());
    publisher_ = std::move(*publisher);

    // Configured strengths are at least 0.
    const Leadership below_all{.strength = -1, .lease = leadership.lease};
    for (const auto& [topic, writer, rank] :
         {std::tuple{Topic::shown_match, &shown_writer_, &leadership},
          std::tuple{Topic::camera_frame, &camera_writer_, &leadership},
          std::tuple{Topic::observer_status, &status_writer_, &leadership},
          std::tuple{Topic::observer_status, &early_status_writer_, &below_all}}) {
        *writer = dds_create_writer(publisher_.handle(), participant.topic(topic),
                                    writer_qos(topic, *rank).get(), nullptr);
        if (*writer < 0) {
            return dds_failure("creating the writer of " + partition + " " + topic_name(topic), *writer);
        }
    }
    return {};
}

dds_return_t MatchEndpoints::write(const director::MatchInfo& shown) {
    const std::lock_guard lock(shown_mutex_);
    is_shown_ = true;
    return dds_write(shown_writer_, &shown_encoder_.encode(shown));
}

dds_return_t MatchEndpoints::end_shown() {
    const std::lock_guard lock(shown_mutex_);
    is_shown_ = false;
    const camera_director_MatchInfo key = shown_match_key(match_id_);
    return dds_dispose(shown_writer_, &key);
}

dds_return_t MatchEndpoints::write(const director::CameraFrame& frame) {
    wrote_frame_ = true;
    return dds_write(camera_writer_, &encoder_.encode(frame, now_realtime()));
}

dds_return_t MatchEndpoints::write(const director::ObserverStatus& status) {
    has_cameras_ = has_cameras_ || status.state == director::RequestState::accepted;
    const camera_director_ObserverStatus sample = encode(status);
    return dds_write(has_cameras_ ? status_writer_ : early_status_writer_, &sample);
}

dds_return_t MatchEndpoints::withdraw(const std::string& observer_id) {
    const camera_director_ObserverStatus key = observer_status_key(match_id_, observer_id);
    for (const dds_entity_t writer : {early_status_writer_, status_writer_}) {
        if (const dds_return_t disposed = dds_dispose(writer, &key); disposed < 0) return disposed;
        if (const dds_return_t ended = dds_unregister_instance(writer, &key); ended < 0) return ended;
    }
    return DDS_RETCODE_OK;
}

void MatchEndpoints::assert_liveliness() {
    if (!wrote_frame_.exchange(false)) dds_assert_liveliness(camera_writer_);
    const auto now = std::chrono::steady_clock::now();
    if (now < next_slow_assertion_) return;
    next_slow_assertion_ = now + slow_assertion_interval;
    dds_assert_liveliness(status_writer_);
    dds_assert_liveliness(early_status_writer_);
    // Readers drop what a standby writes until the lease of its leader ends.
    const std::lock_guard lock(shown_mutex_);
    if (is_shown_)
        dds_write(shown_writer_, &shown_encoder_.sample());
    else
        dds_assert_liveliness(shown_writer_);
}

void MatchEndpoints::release_ownership() {
    const camera_director_CameraFrame key = camera_frame_key(match_id_);
    dds_unregister_instance(camera_writer_, &key);
    // Deleting a writer unregisters its instances at the readers.
    dds_delete(early_status_writer_);
    dds_delete(status_writer_);
    dds_delete(shown_writer_);
}

}  // namespace camdir::dds
