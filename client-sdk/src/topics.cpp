#include "topics.hpp"

#include <new>

namespace camdir::sdk {

namespace {

// A writer with a full queue fails at once: a game's frame must not wait for the network.
constexpr dds_duration_t max_blocking_time = 0;

std::string failed_to_create(const char* what, Topic topic) {
    return std::string("cannot create the ") + what + " " + wire::topic_name(topic);
}

wire::Qos partition_of(const std::string& match_id) {
    wire::Qos qos(dds_create_qos());
    if (!qos) throw std::bad_alloc();
    dds_qset_partition1(qos.get(), wire::match_partition(match_id).c_str());
    return qos;
}

}  // namespace

dds_entity_t Topics::handle(Topic topic) const {
    const std::lock_guard lock(mutex_);
    Entity& entity = topics_[static_cast<std::size_t>(topic)];
    if (entity.get() == 0) {
        entity = Entity(failed_to_create("topic", topic),
                        dds_create_topic(participant_, &wire::topic_type(topic), wire::topic_name(topic),
                                         nullptr, nullptr));
    }
    return entity.get();
}

Entity Topics::make_writer(dds_entity_t group, Topic topic) const {
    const wire::Qos qos = wire::topic_qos(topic, max_blocking_time);
    // A match whose writer is only silent has not ended: its end is disposed by hand.
    if (topic == Topic::match_info) dds_qset_writer_data_lifecycle(qos.get(), false);
    return Entity(failed_to_create("writer of", topic),
                  dds_create_writer(group, handle(topic), qos.get(), nullptr));
}

Entity Topics::make_reader(dds_entity_t group, Topic topic) const {
    return Entity(
        failed_to_create("reader of", topic),
        dds_create_reader(group, handle(topic), wire::topic_qos(topic, max_blocking_time).get(), nullptr));
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
