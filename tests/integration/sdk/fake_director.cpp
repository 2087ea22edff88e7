#include "fake_director.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <stdexcept>

#include "support/descriptions.hpp"

namespace camdir::test {

namespace {

dds_entity_t created(dds_entity_t entity) {
    if (entity < 0) throw std::runtime_error(dds_strretcode(entity));
    return entity;
}

struct Qos {
    Qos(dds_reliability_kind_t reliability, std::int32_t depth) {
        dds_qset_reliability(qos, reliability, DDS_SECS(1));
        if (depth > 0) {
            dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, depth);
        } else {
            dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
        }
    }
    Qos(const Qos&) = delete;
    Qos& operator=(const Qos&) = delete;
    ~Qos() { dds_delete_qos(qos); }

    Qos& transient_local() {
        dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
        return *this;
    }
    Qos& exclusive(std::int32_t strength) {
        dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
        dds_qset_ownership_strength(qos, strength);
        return *this;
    }

    dds_qos_t* qos = dds_create_qos();
};

template <class Sequence>
auto copied(const Sequence& sequence) {
    using Element = std::remove_reference_t<decltype(*sequence._buffer)>;
    return std::vector<Element>(sequence._buffer, sequence._buffer + sequence._length);
}

template <class Sequence>
std::vector<std::string> copied_strings(const Sequence& sequence) {
    return {sequence._buffer, sequence._buffer + sequence._length};
}

// Returns use(sample) of the next sample with data.
template <class Wire, class Use>
auto take(dds_entity_t reader, const dds_topic_descriptor_t& type, const Use& use)
    -> std::optional<decltype(use(std::declval<const Wire&>()))> {
    while (true) {
        Wire sample{};
        void* buffer = &sample;
        dds_sample_info_t info{};
        if (dds_take(reader, &buffer, &info, 1, 1) != 1) return std::nullopt;
        if (!info.valid_data) {
            dds_sample_free(&sample, &type, DDS_FREE_CONTENTS);
            continue;
        }
        auto result = use(sample);
        dds_sample_free(&sample, &type, DDS_FREE_CONTENTS);
        return result;
    }
}

}  // namespace

FakeDirector::FakeDirector(std::uint32_t domain, const std::string& match_id, std::int32_t strength)
    : match_id_(match_id), participant_(created(dds_create_participant(domain, nullptr, nullptr))) {
    dds_qos_t* partition = dds_create_qos();
    dds_qset_partition1(partition, ("match/" + match_id).c_str());
    const dds_entity_t subscriber = created(dds_create_subscriber(participant_, partition, nullptr));
    const dds_entity_t publisher = created(dds_create_publisher(participant_, partition, nullptr));
    dds_delete_qos(partition);

    Qos newest(DDS_RELIABILITY_RELIABLE, 1);
    newest.transient_local();
    const Qos best_effort(DDS_RELIABILITY_BEST_EFFORT, 1);
    const Qos all(DDS_RELIABILITY_RELIABLE, 0);
    const auto reader = [&](const dds_topic_descriptor_t& type, const char* name, const Qos& qos) {
        return created(dds_create_reader(subscriber, topic(type, name), qos.qos, nullptr));
    };
    info_reader_ = reader(camera_director_MatchInfo_desc, "MatchInfo", newest);
    pose_reader_ = reader(camera_director_PoseFrame_desc, "PoseFrame", best_effort);
    event_reader_ = reader(camera_director_MatchEvent_desc, "MatchEvent", all);
    request_reader_ = reader(camera_director_ObserverRequest_desc, "ObserverRequest", newest);
    mover_info_reader_ = reader(camera_director_MoverInfo_desc, "MoverInfo", newest);
    mover_frame_reader_ = reader(camera_director_MoverFrame_desc, "MoverFrame", newest);

    Qos cameras(DDS_RELIABILITY_RELIABLE, 32);
    cameras.exclusive(strength);
    // A lease for slow machines: how ownership ends is tested with the director.
    dds_qset_liveliness(cameras.qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_SECS(60));
    dds_qset_lifespan(cameras.qos, DDS_SECS(60));
    dds_qset_writer_data_lifecycle(cameras.qos, false);
    camera_writer_ = created(dds_create_writer(
        publisher, topic(camera_director_CameraFrame_desc, "CameraFrame"), cameras.qos, nullptr));
    Qos answers(DDS_RELIABILITY_RELIABLE, 1);
    answers.transient_local().exclusive(strength);
    dds_qset_writer_data_lifecycle(answers.qos, false);
    status_writer_ = created(dds_create_writer(
        publisher, topic(camera_director_ObserverStatusBucket_desc, "ObserverStatus"), answers.qos, nullptr));
    shown_writer_ = created(dds_create_writer(publisher, topic(camera_director_ShownMatch_desc, "ShownMatch"),
                                              answers.qos, nullptr));
}

FakeDirector::~FakeDirector() {
    dds_delete(participant_);
}

dds_entity_t FakeDirector::topic(const dds_topic_descriptor_t& type, const char* name) {
    return created(dds_create_topic(participant_, &type, name, nullptr, nullptr));
}

std::optional<ReceivedPoses> FakeDirector::take_poses() {
    const auto use = [](const camera_director_PoseFrame& sample) {
        return ReceivedPoses{sample.match_id,
                             sample.epoch,
                             sample.frame_number,
                             sample.frame_time,
                             sample.source_time,
                             copied(sample.player_id),
                             copied(sample.eye),
                             copied(sample.orientation),
                             copied(sample.velocity),
                             copied(sample.flags),
                             copied(sample.discontinuities)};
    };
    return take<camera_director_PoseFrame>(pose_reader_, camera_director_PoseFrame_desc, use);
}

std::optional<ReceivedInfo> FakeDirector::take_info() {
    const auto use = [](const camera_director_MatchInfo& sample) {
        return ReceivedInfo{sample.epoch,
                            sample.map_name,
                            sample.map_hash,
                            sample.metres_per_unit,
                            sample.rate_hz,
                            sample.spectator_delay_s,
                            copied(sample.player_id),
                            copied_strings(sample.player_name),
                            copied_strings(sample.player_class),
                            copied(sample.player_team)};
    };
    return take<camera_director_MatchInfo>(info_reader_, camera_director_MatchInfo_desc, use);
}

std::optional<camera_director_MatchEvent> FakeDirector::take_event() {
    const auto use = [](const camera_director_MatchEvent& sample) { return sample; };
    return take<camera_director_MatchEvent>(event_reader_, camera_director_MatchEvent_desc, use);
}

std::optional<ReceivedMovers> FakeDirector::take_movers() {
    const auto use = [](const camera_director_MoverInfo& sample) {
        return ReceivedMovers{sample.epoch,
                              copied(sample.mover_id),
                              copied_strings(sample.model),
                              copied_strings(sample.kind),
                              copied(sample.hulls),
                              copied(sample.half_spaces),
                              copied(sample.balls),
                              copied(sample.planes),
                              copied(sample.spheres)};
    };
    return take<camera_director_MoverInfo>(mover_info_reader_, camera_director_MoverInfo_desc, use);
}

std::optional<ReceivedMoverFrame> FakeDirector::take_mover_frame() {
    const auto use = [](const camera_director_MoverFrame& sample) {
        return ReceivedMoverFrame{sample.epoch,
                                  sample.frame_time,
                                  sample.source_time,
                                  copied(sample.mover_id),
                                  copied(sample.position),
                                  copied(sample.orientation)};
    };
    return take<camera_director_MoverFrame>(mover_frame_reader_, camera_director_MoverFrame_desc, use);
}

std::optional<ReceivedRequest> FakeDirector::take_request() {
    const auto use = [](const camera_director_ObserverRequest& sample) {
        return ReceivedRequest{sample.observer_id, sample.target,    copied(sample.group),
                               sample.profile,     sample.overrides, sample.team};
    };
    return take<camera_director_ObserverRequest>(request_reader_, camera_director_ObserverRequest_desc, use);
}

bool FakeDirector::has_ended(dds_entity_t reader) {
    // A read condition finds instances by state without taking samples.
    const dds_entity_t ended = created(dds_create_readcondition(
        reader, DDS_ANY_SAMPLE_STATE | DDS_ANY_VIEW_STATE | DDS_NOT_ALIVE_DISPOSED_INSTANCE_STATE |
                    DDS_NOT_ALIVE_NO_WRITERS_INSTANCE_STATE));
    const bool triggered = dds_triggered(ended) > 0;
    dds_delete(ended);
    return triggered;
}

bool FakeDirector::show_match() {
    const auto pass_on = [&](const camera_director_MatchInfo& sample) {
        const auto shown = described_as<camera_director_ShownMatch>(sample);
        return dds_write(shown_writer_, &shown) == DDS_RETCODE_OK;
    };
    return take<camera_director_MatchInfo>(info_reader_, camera_director_MatchInfo_desc, pass_on)
        .value_or(false);
}

void FakeDirector::end_shown_match() {
    const camera_director_ShownMatch any{};
    ASSERT_EQ(dds_dispose(shown_writer_, &any), DDS_RETCODE_OK);
}

void FakeDirector::write(CameraFrameArrays& frame) {
    const camera_director_CameraFrame sample = frame.sample();
    ASSERT_EQ(dds_write(camera_writer_, &sample), DDS_RETCODE_OK);
}

void FakeDirector::write_status(const std::string& observer_id, std::uint64_t epoch, std::uint32_t state,
                                std::uint32_t camera_id, const std::string& reason) {
    camera_director_ObserverStatus status{};
    observer_id.copy(status.observer_id, sizeof status.observer_id - 1);
    reason.copy(status.reason, sizeof status.reason - 1);
    status.epoch = epoch;
    status.state = state;
    status.camera_id = camera_id;
    statuses_[observer_id] = status;
    write_statuses();
}

void FakeDirector::withdraw_status(const std::string& observer_id) {
    statuses_.erase(observer_id);
    write_statuses();
}

void FakeDirector::write_statuses() {
    std::vector<camera_director_ObserverStatus> statuses;
    for (const auto& [observer_id, status] : statuses_)
        statuses.push_back(status);
    camera_director_ObserverStatusBucket sample{};
    match_id_.copy(sample.match_id, sizeof sample.match_id - 1);
    sample.statuses._buffer = statuses.data();
    sample.statuses._length = sample.statuses._maximum = static_cast<std::uint32_t>(statuses.size());
    ASSERT_EQ(dds_write(status_writer_, &sample), DDS_RETCODE_OK);
}

std::uint32_t FakeDirector::observer_count() const {
    dds_publication_matched_status_t matched{};
    dds_get_publication_matched_status(camera_writer_, &matched);
    return matched.current_count;
}

void FakeDirector::with_offered_qos(const char* topic,
                                    const std::function<void(const dds_qos_t*)>& look) const {
    for (const dds_entity_t reader : {info_reader_, pose_reader_, event_reader_, request_reader_,
                                      mover_info_reader_, mover_frame_reader_}) {
        dds_instance_handle_t writer = 0;
        if (dds_get_matched_publications(reader, &writer, 1) < 1) continue;
        dds_builtintopic_endpoint_t* endpoint = dds_get_matched_publication_data(reader, writer);
        ASSERT_NE(endpoint, nullptr);
        if (std::strcmp(endpoint->topic_name, topic) == 0) look(endpoint->qos);
        dds_builtintopic_free_endpoint(endpoint);
    }
}

}  // namespace camdir::test
