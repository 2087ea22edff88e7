#include "dds/qos.hpp"

#include <camera_director.h>

#include <array>
#include <vector>

namespace camdir::dds {
namespace {

struct Contract {
    const char* name;
    const dds_topic_descriptor_t* type;
    dds_reliability_kind_t reliability;
    dds_durability_kind_t durability;
    std::int32_t keep_last;    // 0: keep all
    std::int32_t max_samples;  // with keep all
    dds_liveliness_kind_t liveliness;
    dds_duration_t lease;  // offered by writers; 0: the director's own choice
    dds_ownership_kind_t ownership;
    dds_duration_t lifespan;
};

constexpr dds_duration_t forever = DDS_INFINITY;
constexpr dds_duration_t director_lease = 0;

const std::array<Contract, topic_count> contracts = {{
    {"MatchInfo", &camera_director_MatchInfo_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL,
     1, 0, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2), DDS_OWNERSHIP_SHARED, forever},
    {"PoseFrame", &camera_director_PoseFrame_desc, DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, 1, 0,
     DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED, forever},
    {"MatchEvent", &camera_director_MatchEvent_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 0,
     256, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED, forever},
    {"CameraFrame", &camera_director_CameraFrame_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 32,
     0, DDS_LIVELINESS_MANUAL_BY_TOPIC, director_lease, DDS_OWNERSHIP_EXCLUSIVE, DDS_SECS(1)},
    {"ObserverRequest", &camera_director_ObserverRequest_desc, DDS_RELIABILITY_RELIABLE,
     DDS_DURABILITY_TRANSIENT_LOCAL, 1, 0, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(10), DDS_OWNERSHIP_SHARED,
     forever},
    {"ObserverStatus", &camera_director_ObserverStatus_desc, DDS_RELIABILITY_RELIABLE,
     DDS_DURABILITY_TRANSIENT_LOCAL, 1, 0, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_EXCLUSIVE,
     forever},
}};

const Contract& contract(Topic topic) {
    return contracts[static_cast<std::size_t>(topic)];
}

// What readers and writers of a topic have in common.
Qos endpoint_qos(const Contract& topic) {
    Qos qos(dds_create_qos());
    // A full reader is emptied within milliseconds by a live peer; a dead one must not hold a worker up.
    dds_qset_reliability(qos.get(), topic.reliability, DDS_MSECS(100));
    dds_qset_durability(qos.get(), topic.durability);
    if (topic.keep_last > 0) {
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, topic.keep_last);
    } else {
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
        dds_qset_resource_limits(qos.get(), topic.max_samples, DDS_LENGTH_UNLIMITED, topic.max_samples);
    }
    dds_qset_ownership(qos.get(), topic.ownership);
    return qos;
}

}  // namespace

const char* topic_name(Topic topic) {
    return contract(topic).name;
}

const dds_topic_descriptor_t& topic_type(Topic topic) {
    return *contract(topic).type;
}

Qos reader_qos(Topic topic) {
    Qos qos = endpoint_qos(contract(topic));
    dds_qset_liveliness(qos.get(), contract(topic).liveliness, DDS_INFINITY);
    // A director never answers itself.
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    return qos;
}

Qos writer_qos(Topic topic, const Leadership& leadership) {
    const Contract& terms = contract(topic);
    Qos qos = endpoint_qos(terms);
    const dds_duration_t lease =
        terms.lease == director_lease ? DDS_MSECS(leadership.lease.count()) : terms.lease;
    dds_qset_liveliness(qos.get(), terms.liveliness, lease);
    dds_qset_lifespan(qos.get(), terms.lifespan);
    if (terms.ownership == DDS_OWNERSHIP_EXCLUSIVE) {
        dds_qset_ownership_strength(qos.get(), leadership.strength);
        // Whoever leaves hands over to the next director instead of ending the instance for all.
        dds_qset_writer_data_lifecycle(qos.get(), false);
    }
    return qos;
}

Qos partition_qos(std::span<const std::string> partitions) {
    std::vector<const char*> names;
    for (const std::string& partition : partitions)
        names.push_back(partition.c_str());
    Qos qos(dds_create_qos());
    dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
    return qos;
}

std::string match_partition(const std::string& match_id) {
    return "match/" + match_id;
}

}  // namespace camdir::dds
