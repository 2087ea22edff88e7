#include "dds/participant.hpp"

#include <netdb.h>
#include <spdlog/spdlog.h>

#include <charconv>
#include <chrono>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/log_limit.hpp"
#include "dds/protection.hpp"
#include "idl/network.hpp"
#include "idl/security.hpp"

namespace camdir::dds {
namespace {

bool is_port(std::string_view text) {
    std::uint16_t port = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), port);
    return error == std::errc() && end == text.data() + text.size() && port > 0;
}

Result<void> check_peer(const std::string& peer) {
    const std::size_t colon = peer.find(':');
    if (colon != std::string::npos && !is_port(std::string_view(peer).substr(colon + 1)))
        return fail("\"" + peer + "\": expected a host, or host:port with a port from 1 to 65535");
    addrinfo ipv4{};  // as Cyclone DDS
    ipv4.ai_family = AF_INET;
    addrinfo* found = nullptr;
    const int error = ::getaddrinfo(peer.substr(0, colon).c_str(), nullptr, &ipv4, &found);
    if (error != 0)
        return fail("\"" + peer + "\": " + ::gai_strerror(error) +
                    ": expected an IPv4 address, or a name that has one");
    ::freeaddrinfo(found);
    return {};
}

// Cyclone DDS resolves names once, and goes on without those that it cannot: two directors that do not know
// each other would both lead.
Result<void> check_peers(const config::Dds& config) {
    if (!config.xml.empty()) return {};
    for (std::size_t i = 0; i < config.peers.size(); ++i) {
        const auto checked = check_peer(config.peers[i]);
        if (!checked) return fail("/dds/peers/" + std::to_string(i) + ": " + checked.error().message);
    }
    return {};
}

// Strangers can provoke messages: each attempt to join a secure domain without a right to is one.
constexpr std::uint64_t max_messages_per_second = 20;

void log_message(void* /*unused*/, const dds_log_data_t* message) {
    static LogBudget budget(max_messages_per_second);
    const bool is_last = (message->priority & DDS_LC_FATAL) != 0;
    const auto left_out = budget.take(std::chrono::steady_clock::now(), is_last);
    if (!left_out) return;
    if (*left_out > 0) spdlog::warn("Cyclone DDS: {} messages left out", *left_out);
    const bool error = (message->priority & DDS_LC_ERROR) != 0;
    std::string text(message->message, message->size);
    while (!text.empty() && text.back() == '\n')
        text.pop_back();
    const auto level = is_last ? spdlog::level::critical : error ? spdlog::level::err : spdlog::level::warn;
    spdlog::log(level, "Cyclone DDS: {}", text);
}

}  // namespace

std::string domain_xml(const config::Dds& config) {
    if (!config.xml.empty()) return config.xml;
    const bool indexed = config.participant_index >= 0;
    const std::string index = indexed ? std::to_string(config.participant_index) : "none";
    return wire::network_xml(
        {.interface = config.interface,
         .multicast = config.multicast,
         .peers = config.peers,
         .writer_linger = std::chrono::milliseconds(0),
         .discovery = wire::element("ParticipantIndex", index) +
                      wire::element("Ports", wire::element("Base", std::to_string(config.port))),
         // Hundreds of clients can announce themselves at once.
         .internal = "<SocketReceiveBufferSize max=\"4MB\"/>"});
}

Participant::Participant(Participant&& other) noexcept
    : open_(std::exchange(other.open_, false)),
      identity_(other.identity_),
      domain_(std::move(other.domain_)),
      participant_(std::move(other.participant_)),
      topics_(std::move(other.topics_)) {}

Participant::~Participant() {
    if (open_) dds_delete(DDS_CYCLONEDDS_HANDLE);
}

Result<Participant> Participant::open(const config::Dds& config) {
    const auto identity = check_protection(config);
    if (!identity) return fail("DDS: " + identity.error().message);
    const auto peers_known = check_peers(config);
    if (!peers_known) return fail("DDS: " + peers_known.error().message);
    dds_set_log_sink(log_message, nullptr);
    Participant participant;
    participant.identity_ = *identity;
    const auto id = static_cast<dds_domainid_t>(config.domain);
    const std::string where = "DDS domain " + std::to_string(id);

    auto domain = created(
        dds_create_domain(id, domain_xml(config).c_str()),
        where + ": joining as participant index " + std::to_string(config.participant_index) +
            " on interface '" + config.interface +
            "' (another process of this host may have this index: set /dds/participant_index to another "
            "one, or to -1; or the interface or /dds/xml is wrong)");
    if (!domain) return tl::unexpected(domain.error());
    participant.domain_ = std::move(*domain);
    if (config.security.empty() && !config.insecure) {
        const auto confined = confine_to_loopback();
        if (!confined) return fail(where + ": " + confined.error().message);
    }

    const std::string as =
        config.security.empty()
            ? ""
            : " with the identity in /dds/security, " + config.security + " (Cyclone DDS has logged why not)";
    auto handle = created(dds_create_participant(id, wire::participant_qos(config.security).get(), nullptr),
                          where + ": creating the participant" + as);
    if (!handle) return tl::unexpected(handle.error());
    participant.participant_ = std::move(*handle);

    for (std::size_t i = 0; i < topic_count; ++i)
        if (auto made = participant.create_topic(static_cast<Topic>(i), where); !made)
            return tl::unexpected(made.error());
    if (!participant.has_movers())
        spdlog::warn(
            "DDS: the identity in {} may not read MoverInfo and MoverFrame: cameras do not know doors and "
            "lifts. Renew it with the authority.sh of this version",
            config.security);
    return participant;
}

Result<void> Participant::create_topic(Topic topic, const std::string& where) {
    const dds_entity_t entity =
        dds_create_topic(handle(), &topic_type(topic), topic_name(topic), nullptr, nullptr);
    const bool of_movers = topic == Topic::mover_info || topic == Topic::mover_frame;
    if (of_movers && entity == DDS_RETCODE_NOT_ALLOWED_BY_SECURITY) return {};
    auto made = created(entity, where + ": creating the topic " + topic_name(topic));
    if (!made) return tl::unexpected(made.error());
    topics_[static_cast<std::size_t>(topic)] = std::move(*made);
    return {};
}

}  // namespace camdir::dds
