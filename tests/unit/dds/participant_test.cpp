#include "dds/participant.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/select.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <vector>

#include "support/test_domain.hpp"

namespace camdir::dds {
namespace {

using testing::AllOf;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

TEST(DomainXml, ContainsTheConfiguration) {
    config::Dds config;
    config.interface = "eth<1>&\"x\"";
    config.multicast = true;
    config.participant_index = 3;
    config.port = 8000;
    config.peers = {"10.0.0.5", "10.0.0.6:7412"};
    const std::string xml = domain_xml(config);
    EXPECT_THAT(xml, HasSubstr("<NetworkInterface name=\"eth&lt;1&gt;&amp;&quot;x&quot;\"/>"));
    EXPECT_THAT(xml, HasSubstr("<AllowMulticast>true<"));
    EXPECT_THAT(xml, HasSubstr("<ParticipantIndex>3<"));
    EXPECT_THAT(xml, HasSubstr("<Base>8000<"));
    EXPECT_THAT(xml, HasSubstr("<Peer Address=\"10.0.0.5\"/><Peer Address=\"10.0.0.6:7412\"/>"));
    config.participant_index = -1;
    EXPECT_THAT(domain_xml(config), HasSubstr("<ParticipantIndex>none<"));
}

TEST(DomainXml, IsReplacedByTheOperatorsXml) {
    config::Dds config;
    config.xml = "<CycloneDDS/>";
    EXPECT_EQ(domain_xml(config), "<CycloneDDS/>");
}

TEST(Participant, CycloneAcceptsTheDefaultConfiguration) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    config.peers = {"127.0.0.1"};
    for (int round = 0; round < 2; ++round) {
        const auto participant = Participant::open(config);
        ASSERT_TRUE(participant) << participant.error().message;
        EXPECT_GT(participant->handle(), 0);
        EXPECT_GT(participant->topic(Topic::observer_status), 0);
    }
}

TEST(Participant, TheInterfaceMayBeGivenByAddress) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    config.interface = "127.0.0.1";
    const auto participant = Participant::open(config);
    EXPECT_TRUE(participant) << participant.error().message;
}

TEST(Participant, IgnoresTheEnvironmentsConfiguration) {
    const test::TestDomain domain;
    ASSERT_EQ(::setenv("CYCLONEDDS_URI", "<CycloneDDS><NoSuchElement/></CycloneDDS>", 1), 0);
    config::Dds config;
    config.domain = domain.id();
    const auto participant = Participant::open(config);
    EXPECT_TRUE(participant) << participant.error().message;
    ::unsetenv("CYCLONEDDS_URI");
}

TEST(Participant, IsNotOpenedWithoutProtection) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    config.interface = "";
    const auto participant = Participant::open(config);
    ASSERT_FALSE(participant);
    EXPECT_THAT(participant.error().message, HasSubstr("DDS: /dds/interface: "));
}

struct UdpSocket {
    int file;
    in_addr_t address;  // that it is bound to
};

// Of this process.
std::vector<UdpSocket> udp_sockets() {
    std::vector<UdpSocket> sockets;
    for (int file = 0; file < FD_SETSIZE; ++file) {
        sockaddr_in address{};
        socklen_t size = sizeof address;
        int type = 0;
        socklen_t type_size = sizeof type;
        if (::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
            address.sin_family != AF_INET)
            continue;
        if (::getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || type != SOCK_DGRAM) continue;
        sockets.push_back({file, address.sin_addr.s_addr});
    }
    return sockets;
}

// The devices that the sockets are bound to which receive from any address.
std::vector<std::string> devices_received_from() {
    std::vector<std::string> devices;
    for (const UdpSocket& socket : udp_sockets()) {
        if (socket.address != INADDR_ANY) continue;
        std::array<char, IFNAMSIZ> device{};
        socklen_t size = device.size();
        EXPECT_EQ(::getsockopt(socket.file, SOL_SOCKET, SO_BINDTODEVICE, device.data(), &size), 0);
        devices.emplace_back(device.data());
    }
    return devices;
}

TEST(Participant, ReceivesFromOtherHostsOnlyWhenItMay) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    {
        const auto participant = Participant::open(config);
        ASSERT_TRUE(participant) << participant.error().message;
        EXPECT_THAT(devices_received_from(), AllOf(Not(IsEmpty()), Each("lo")));
    }
    config.insecure = true;
    const auto participant = Participant::open(config);
    ASSERT_TRUE(participant) << participant.error().message;
    EXPECT_THAT(devices_received_from(), AllOf(Not(IsEmpty()), Each("")));
}

// In bytes.
int send_buffer(int file) {
    int bytes = 0;
    socklen_t size = sizeof bytes;
    EXPECT_EQ(::getsockopt(file, SOL_SOCKET, SO_SNDBUF, &bytes, &size), 0);
    return bytes;
}

// As much as the kernel grants of what is wanted.
int granted_send_buffer(int wanted) {
    const int file = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::setsockopt(file, SOL_SOCKET, SO_SNDBUF, &wanted, sizeof wanted), 0);
    const int granted = send_buffer(file);
    EXPECT_EQ(::close(file), 0);
    return granted;
}

TEST(Participant, HasRoomForWhatWaitsForHostsThatAreGone) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    const auto participant = Participant::open(config);
    ASSERT_TRUE(participant) << participant.error().message;
    const std::vector<UdpSocket> sockets = udp_sockets();
    ASSERT_FALSE(sockets.empty());
    const int granted = granted_send_buffer(4 << 20);
    for (const UdpSocket& socket : sockets)
        EXPECT_EQ(send_buffer(socket.file), granted);
}

// Cyclone DDS would go on without it.
TEST(Participant, NamesThePeerWhosePortIsNone) {
    const test::TestDomain domain;
    for (const char* port : {"0", "", "65536", "-1", "74a", "7410:1"}) {
        config::Dds config;
        config.domain = domain.id();
        config.peers = {"127.0.0.1", std::string("127.0.0.1:") + port};
        const auto participant = Participant::open(config);
        ASSERT_FALSE(participant) << port;
        EXPECT_THAT(participant.error().message,
                    AllOf(HasSubstr("/dds/peers/1: \"127.0.0.1:"), HasSubstr("a port from 1 to 65535")));
    }
}

TEST(Participant, NamesThePeerThatCannotBeResolved) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    config.peers = {"127.0.0.1", "127.0.0.1:7410", "director-b.invalid:7410"};
    const auto participant = Participant::open(config);
    ASSERT_FALSE(participant);
    EXPECT_THAT(participant.error().message, AllOf(HasSubstr("/dds/peers/2: \"director-b.invalid:7410\": "),
                                                   HasSubstr("expected an IPv4 address")));
}

TEST(Participant, NamesTheDomainThatItCouldNotJoin) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    config.interface = "no-such-interface";
    config.insecure = true;
    const auto participant = Participant::open(config);
    ASSERT_FALSE(participant);
    EXPECT_THAT(participant.error().message, HasSubstr("DDS domain " + std::to_string(domain.id())));
    EXPECT_THAT(participant.error().message, HasSubstr("no-such-interface"));

    config.xml = "<CycloneDDS><Domain><NoSuchElement/></Domain></CycloneDDS>";
    EXPECT_FALSE(Participant::open(config));
}

}  // namespace
}  // namespace camdir::dds
