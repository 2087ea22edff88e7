#include "idl/topics.hpp"

#include <camera_director.h>

#include <array>
#include <new>

namespace camdir::wire {
namespace {

struct Contract {
    const char* name;
    const dds_topic_descriptor_t* type;
    dds_reliability_kind_t reliability;
    dds_durability_kind_t durability;
    std::int32_t keep_last;    // 0: keep all
    std::int32_t max_samples;  // with keep all
    dds_liveliness_kind_t liveliness;
    dds_duration_t lease;  // a director's writers offer shorter ones
    dds_ownership_kind_t ownership;
};

constexpr dds_duration_t forever = DDS_INFINITY;

// In the order of Topic.
const std::array<Contract, topic_count> contracts = {{
    {"MatchInfo", &camera_director_MatchInfo_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL,
     1, 0, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(2), DDS_OWNERSHIP_SHARED},
    {"PoseFrame", &camera_director_PoseFrame_desc, DDS_RELIABILITY_BEST_EFFORT, DDS_DURABILITY_VOLATILE, 1, 0,
     DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED},
    {"MatchEvent", &camera_director_MatchEvent_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 0,
     256, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED},
    {"CameraFrame", &camera_director_CameraFrame_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_VOLATILE, 32,
     0, DDS_LIVELINESS_MANUAL_BY_TOPIC, forever, DDS_OWNERSHIP_EXCLUSIVE},
    {"ObserverRequest", &camera_director_ObserverRequest_desc, DDS_RELIABILITY_RELIABLE,
     DDS_DURABILITY_TRANSIENT_LOCAL, 1, 0, DDS_LIVELINESS_AUTOMATIC, DDS_SECS(10), DDS_OWNERSHIP_SHARED},
    {"ObserverStatus", &camera_director_ObserverStatusBucket_desc, DDS_RELIABILITY_RELIABLE,
     DDS_DURABILITY_TRANSIENT_LOCAL, 1, 0, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_EXCLUSIVE},
    {"ShownMatch", &camera_director_ShownMatch_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL,
     1, 0, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_EXCLUSIVE},
    {"DirectorSign", &camera_director_DirectorSign_desc, DDS_RELIABILITY_RELIABLE,
     DDS_DURABILITY_TRANSIENT_LOCAL, 1, 0, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED},
    {"MoverInfo", &camera_director_MoverInfo_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL,
     1, 0, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED},
    {"MoverFrame", &camera_director_MoverFrame_desc, DDS_RELIABILITY_RELIABLE, DDS_DURABILITY_TRANSIENT_LOCAL,
     1, 0, DDS_LIVELINESS_AUTOMATIC, forever, DDS_OWNERSHIP_SHARED},
}};

const Contract& contract(Topic topic) {
    return contracts[static_cast<std::size_t>(topic)];
}

}  // namespace

const char* topic_name(Topic topic) {
    return contract(topic).name;
}

const dds_topic_descriptor_t& topic_type(Topic topic) {
    return *contract(topic).type;
}

Qos topic_qos(Topic topic, dds_duration_t max_blocking_time) {
    const Contract& terms = contract(topic);
    Qos qos(dds_create_qos());
    if (!qos) throw std::bad_alloc();
    dds_qset_reliability(qos.get(), terms.reliability, max_blocking_time);
    dds_qset_durability(qos.get(), terms.durability);
    if (terms.keep_last > 0) {
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, terms.keep_last);
    } else {
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_ALL, 0);
        dds_qset_resource_limits(qos.get(), terms.max_samples, DDS_LENGTH_UNLIMITED, terms.max_samples);
    }
    dds_qset_liveliness(qos.get(), terms.liveliness, terms.lease);
    dds_qset_ownership(qos.get(), terms.ownership);
    return qos;
}

std::string match_partition(const std::string& match_id) {
    return "match/" + match_id;
}

}  // namespace camdir::wire
