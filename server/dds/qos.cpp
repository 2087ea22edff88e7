#include "dds/qos.hpp"

#include <algorithm>
#include <vector>

namespace camdir::dds {
namespace {

// Of writers that must not lose a sample. Those of a director keep the last ones and do not wait for readers:
// what a slow one has not acknowledged is replaced.
constexpr dds_duration_t max_blocking_time = DDS_MSECS(100);

// Whoever takes over is stronger and need not wait for it; shorter, and every observer would ask again when a
// busy machine delays the director.
constexpr dds_duration_t min_slow_lease = DDS_SECS(1);

constexpr std::int32_t events_kept_until_taken = 256;

}  // namespace

Qos reader_qos(Topic topic) {
    Qos qos = wire::topic_qos(topic, max_blocking_time);
    dds_liveliness_kind_t kind = DDS_LIVELINESS_AUTOMATIC;
    dds_qget_liveliness(qos.get(), &kind, nullptr);
    dds_qset_liveliness(qos.get(), kind, DDS_INFINITY);
    if (topic == Topic::match_info || topic == Topic::pose_frame || topic == Topic::observer_request ||
        topic == Topic::mover_info || topic == Topic::mover_frame)
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, kept_until_taken);
    // A reader that refuses a sample puts DDS's receive thread to sleep: the oldest one leaves instead.
    if (topic == Topic::match_event) {
        dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, events_kept_until_taken);
        dds_qset_resource_limits(qos.get(), DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED, DDS_LENGTH_UNLIMITED);
    }
    // A director does not receive its own samples.
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    return qos;
}

Qos writer_qos(Topic topic, std::chrono::milliseconds shortest_lease) {
    Qos qos = wire::topic_qos(topic, max_blocking_time);
    dds_duration_t lease = DDS_MSECS(shortest_lease.count());
    if (topic == Topic::camera_frame) {
        dds_qset_lifespan(qos.get(), DDS_SECS(1));
    } else {
        lease = std::max(lease, min_slow_lease);
    }
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, lease);
    // A director that leaves must hand its instances over to the next one, not dispose them.
    dds_qset_writer_data_lifecycle(qos.get(), false);
    return qos;
}

Qos sign_qos() {
    Qos qos = wire::topic_qos(Topic::director_sign, max_blocking_time);
    // Only who leaves disposes its sign, not whoever cannot be reached.
    dds_qset_writer_data_lifecycle(qos.get(), false);
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

}  // namespace camdir::dds
