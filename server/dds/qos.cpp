#include "dds/qos.hpp"

#include <algorithm>
#include <vector>

namespace camdir::dds {
namespace {

// A live peer empties a full queue within milliseconds; a dead one must not delay a worker for longer than
// this.
constexpr dds_duration_t max_blocking_time = DDS_MSECS(100);

// For so long readers drop the answers of a dead director's successor; shorter, and every observer would ask
// again when a busy machine delays the director.
constexpr dds_duration_t min_slow_lease = DDS_SECS(1);

}  // namespace

Qos reader_qos(Topic topic) {
    Qos qos = wire::topic_qos(topic, max_blocking_time);
    dds_liveliness_kind_t kind = DDS_LIVELINESS_AUTOMATIC;
    dds_qget_liveliness(qos.get(), &kind, nullptr);
    dds_qset_liveliness(qos.get(), kind, DDS_INFINITY);
    // A director does not receive its own samples.
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    return qos;
}

Qos writer_qos(Topic topic, const Leadership& leadership) {
    Qos qos = wire::topic_qos(topic, max_blocking_time);
    dds_duration_t lease = DDS_MSECS(leadership.lease.count());
    if (topic == Topic::camera_frame) {
        dds_qset_lifespan(qos.get(), DDS_SECS(1));
    } else {
        lease = std::max(lease, min_slow_lease);
    }
    dds_qset_liveliness(qos.get(), DDS_LIVELINESS_MANUAL_BY_TOPIC, lease);
    dds_qset_ownership_strength(qos.get(), leadership.strength);
    // A director that leaves must hand its instances over to the next one, not dispose them.
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
