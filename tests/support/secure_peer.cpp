#include "support/secure_peer.hpp"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <stdexcept>

#include "idl/security.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

dds_entity_t checked(dds_entity_t created, const char* doing) {
    if (created < 0) throw std::runtime_error(std::string(doing) + ": " + dds_strretcode(created));
    return created;
}

wire::Qos participant_qos(const std::string& identity, SecurePeer::Access access) {
    wire::Qos qos = wire::participant_qos(identity);
    if (access == SecurePeer::Access::permissive) {
        dds_qset_prop(qos.get(), "dds.sec.access.library.path", CAMDIR_PERMISSIVE_PLUGINS);
        dds_qset_prop(qos.get(), "dds.sec.access.library.init", "init_permissive_access_control");
        dds_qset_prop(qos.get(), "dds.sec.access.library.finalize", "finalize_permissive_access_control");
        dds_qset_prop(qos.get(), "dds.sec.auth.library.path", CAMDIR_PERMISSIVE_PLUGINS);
        dds_qset_prop(qos.get(), "dds.sec.auth.library.init", "init_permissive_authentication");
        dds_qset_prop(qos.get(), "dds.sec.auth.library.finalize", "finalize_permissive_authentication");
    }
    return qos;
}

wire::Qos endpoint_qos(wire::Topic topic, const std::vector<std::string>& partitions) {
    std::vector<const char*> names;
    for (const std::string& partition : partitions)
        names.push_back(partition.c_str());
    wire::Qos qos = wire::topic_qos(topic, 0);
    dds_qset_ignorelocal(qos.get(), DDS_IGNORELOCAL_PARTICIPANT);
    dds_qset_partition(qos.get(), static_cast<std::uint32_t>(names.size()), names.data());
    return qos;
}

std::mutex log_mutex;
std::vector<std::string> log_lines;

void keep_line(void* /*unused*/, const dds_log_data_t* message) {
    const std::lock_guard lock(log_mutex);
    log_lines.emplace_back(message->message, message->size);
}

}  // namespace

std::string apart_xml(std::uint32_t domain, const std::string& participant_index) {
    return "<CycloneDDS><Domain Id=\"any\"><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
           "<AllowMulticast>false</AllowMulticast></General><Discovery><ExternalDomainId>" +
           std::to_string(domain) + "</ExternalDomainId><ParticipantIndex>" + participant_index +
           "</ParticipantIndex><SPDPInterval>1s</SPDPInterval><Peers><Peer address=\"" +
           director_address(domain, 0) + "\"/><Peer address=\"" + director_address(domain, 1) +
           "\"/></Peers></Discovery></Domain></CycloneDDS>";
}

std::uint32_t next_domain_apart() {
    static std::atomic<std::uint32_t> next{100};
    return next++;
}

SecurePeer::SecurePeer(std::uint32_t domain, bool first, const std::string& identity, Access access) {
    const dds_domainid_t local = next_domain_apart();
    domain_ = checked(dds_create_domain(local, apart_xml(domain, first ? "0" : "none").c_str()),
                      "joining the domain");
    participant_ = dds_create_participant(local, participant_qos(identity, access).get(), nullptr);
    if (participant_ < 0) dds_delete(domain_);
    checked(participant_, "creating a participant");
}

SecurePeer::~SecurePeer() {
    dds_delete(domain_);
}

dds_entity_t SecurePeer::create_topic(wire::Topic topic) const {
    return dds_create_topic(participant_, &wire::topic_type(topic), wire::topic_name(topic), nullptr,
                            nullptr);
}

void SecurePeer::write(wire::Topic topic, const std::vector<std::string>& partitions) {
    const dds_entity_t handle = create_topic(topic);
    if (handle < 0) return;
    writers_[index(topic)] =
        dds_create_writer(participant_, handle, endpoint_qos(topic, partitions).get(), nullptr);
}

void SecurePeer::read(wire::Topic topic, const std::vector<std::string>& partitions) {
    const dds_entity_t handle = create_topic(topic);
    if (handle < 0) return;
    readers_[index(topic)] =
        dds_create_reader(participant_, handle, endpoint_qos(topic, partitions).get(), nullptr);
}

void SecurePeer::do_everything(const std::vector<std::string>& partitions) {
    for (const wire::Topic topic : all_topics) {
        write(topic, partitions);
        read(topic, partitions);
    }
}

std::uint32_t SecurePeer::matched_readers(wire::Topic topic) const {
    dds_publication_matched_status_t status{};
    if (writes(topic))
        checked(dds_get_publication_matched_status(writers_[index(topic)], &status), "counting readers");
    return status.current_count;
}

std::uint32_t SecurePeer::matched_writers(wire::Topic topic) const {
    dds_subscription_matched_status_t status{};
    if (reads(topic))
        checked(dds_get_subscription_matched_status(readers_[index(topic)], &status), "counting writers");
    return status.current_count;
}

std::uint32_t SecurePeer::matches() const {
    std::uint32_t sum = 0;
    for (const wire::Topic topic : all_topics)
        sum += matched_readers(topic) + matched_writers(topic);
    return sum;
}

DdsLog::DdsLog() {
    const std::lock_guard lock(log_mutex);
    log_lines.clear();
    dds_set_log_sink(keep_line, nullptr);
}

DdsLog::~DdsLog() {
    dds_set_log_sink(nullptr, nullptr);
}

bool DdsLog::has(const std::vector<std::string>& parts) const {
    const std::lock_guard lock(log_mutex);
    return std::ranges::any_of(log_lines, [&](const std::string& line) {
        return std::ranges::all_of(
            parts, [&](const std::string& part) { return line.find(part) != std::string::npos; });
    });
}

std::string DdsLog::text() const {
    const std::lock_guard lock(log_mutex);
    std::string all;
    for (const std::string& line : log_lines)
        all += line;
    return all;
}

}  // namespace camdir::test
