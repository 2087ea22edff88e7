#include "topics.hpp"

#include <camera_director.h>

namespace camdir::sdk {

namespace {

// A writer with a full queue fails at once: a game's frame must not wait for the network.
constexpr dds_duration_t max_blocking_time = 0;

void set_reliable(dds_qos_t* qos) {
    dds_qset_reliability(qos, DDS_RELIABILITY_RELIABLE, max_blocking_time);
}

void set_newest_for_late_joiners(dds_qos_t* qos) {
    set_reliable(qos);
    dds_qset_durability(qos, DDS_DURABILITY_TRANSIENT_LOCAL);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
}

void set_match_info(dds_qos_t* qos) {
    set_newest_for_late_joiners(qos);
    dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2));
}

void set_pose_frame(dds_qos_t* qos) {
    dds_qset_reliability(qos, DDS_RELIABILITY_BEST_EFFORT, 0);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 1);
}

void set_match_event(dds_qos_t* qos) {
    set_reliable(qos);
    dds_qset_history(qos, DDS_HISTORY_KEEP_ALL, 0);
    dds_qset_resource_limits(qos, 256, DDS_LENGTH_UNLIMITED, 256);
}

// Only read here. Matches any lease, because the director's configuration sets it.
void set_camera_frame(dds_qos_t* qos) {
    set_reliable(qos);
    dds_qset_history(qos, DDS_HISTORY_KEEP_LAST, 32);
    dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
    dds_qset_liveliness(qos, DDS_LIVELINESS_MANUAL_BY_TOPIC, DDS_INFINITY);
}

void set_observer_request(dds_qos_t* qos) {
    set_newest_for_late_joiners(qos);
    dds_qset_liveliness(qos, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(10));
}

void set_observer_status(dds_qos_t* qos) {
    set_newest_for_late_joiners(qos);
    dds_qset_ownership(qos, DDS_OWNERSHIP_EXCLUSIVE);
}

struct TopicDefinition {
    const char* name;
    const dds_topic_descriptor_t* type;
    void (*set_qos)(dds_qos_t*);
};

// In the order of enum Topic.
const std::array<TopicDefinition, topic_count> definitions{{
    {"MatchInfo", &camera_director_MatchInfo_desc, set_match_info},
    {"PoseFrame", &camera_director_PoseFrame_desc, set_pose_frame},
    {"MatchEvent", &camera_director_MatchEvent_desc, set_match_event},
    {"CameraFrame", &camera_director_CameraFrame_desc, set_camera_frame},
    {"ObserverRequest", &camera_director_ObserverRequest_desc, set_observer_request},
    {"ObserverStatus", &camera_director_ObserverStatus_desc, set_observer_status},
}};

Qos new_qos() {
    Qos qos(dds_create_qos());
    if (!qos) throw std::bad_alloc();
    return qos;
}

Qos partition_of(const std::string& match_id) {
    Qos qos = new_qos();
    dds_qset_partition1(qos.get(), ("match/" + match_id).c_str());
    return qos;
}

}  // namespace

Topics::Topics(dds_entity_t participant) {
    for (std::size_t i = 0; i < topic_count; ++i) {
        const TopicDefinition& definition = definitions[i];
        topics_[i] =
            Entity(std::string("cannot create the topic ") + definition.name,
                   dds_create_topic(participant, definition.type, definition.name, nullptr, nullptr));
    }
}

Entity Topics::make_writer(dds_entity_t group, Topic topic) const {
    const auto index = static_cast<std::size_t>(topic);
    const Qos qos = new_qos();
    definitions[index].set_qos(qos.get());
    return Entity(std::string("cannot create the writer of ") + definitions[index].name,
                  dds_create_writer(group, topics_[index].get(), qos.get(), nullptr));
}

Entity Topics::make_reader(dds_entity_t group, Topic topic) const {
    const auto index = static_cast<std::size_t>(topic);
    const Qos qos = new_qos();
    definitions[index].set_qos(qos.get());
    return Entity(std::string("cannot create the reader of ") + definitions[index].name,
                  dds_create_reader(group, topics_[index].get(), qos.get(), nullptr));
}

Entity make_publisher(dds_entity_t participant, const std::string& match_id) {
    return Entity("cannot create the publisher of match " + match_id,
                  dds_create_publisher(participant, partition_of(match_id).get(), nullptr));
}

Entity make_subscriber(dds_entity_t participant, const std::string& match_id) {
    return Entity("cannot create the subscriber of match " + match_id,
                  dds_create_subscriber(participant, partition_of(match_id).get(), nullptr));
}

}  // namespace camdir::sdk
