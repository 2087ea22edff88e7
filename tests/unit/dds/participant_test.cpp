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
    EXPECT_THAT(xml, HasSubstr("<Peer address=\"10.0.0.5\"/><Peer address=\"10.0.0.6:7412\"/>"));
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

// The devices that the UDP sockets of this process are bound to which receive from any address.
std::vector<std::string> devices_received_from() {
    std::vector<std::string> devices;
    for (int file = 0; file < FD_SETSIZE; ++file) {
        sockaddr_in address{};
        socklen_t size = sizeof address;
        int type = 0;
        socklen_t type_size = sizeof type;
        if (::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
            address.sin_family != AF_INET || address.sin_addr.s_addr != INADDR_ANY)
            continue;
        if (::getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &type_size) != 0 || type != SOCK_DGRAM) continue;
        std::array<char, IFNAMSIZ> device{};
        size = device.size();
        EXPECT_EQ(::getsockopt(file, SOL_SOCKET, SO_BINDTODEVICE, device.data(), &size), 0);
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

// In bytes, of the UDP sockets of this process.
std::vector<int> send_buffers() {
    std::vector<int> sizes;
    for (int file = 0; file < FD_SETSIZE; ++file) {
        int type = 0;
        socklen_t size = sizeof type;
        if (::getsockopt(file, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) continue;
        sockaddr_in address{};
        size = sizeof address;
        if (::getsockname(file, reinterpret_cast<sockaddr*>(&address), &size) != 0 ||
            address.sin_family != AF_INET)
            continue;
        size = sizeof(int);
        EXPECT_EQ(::getsockopt(file, SOL_SOCKET, SO_SNDBUF, &sizes.emplace_back(), &size), 0);
    }
    return sizes;
}

// In bytes, as much as the kernel grants of what is wanted.
int granted_send_buffer(int wanted) {
    const int file = ::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
    int granted = 0;
    socklen_t size = sizeof granted;
    EXPECT_EQ(::setsockopt(file, SOL_SOCKET, SO_SNDBUF, &wanted, sizeof wanted), 0);
    EXPECT_EQ(::getsockopt(file, SOL_SOCKET, SO_SNDBUF, &granted, &size), 0);
    EXPECT_EQ(::close(file), 0);
    return granted;
}

TEST(Participant, HasRoomForWhatWaitsForHostsThatAreGone) {
    const test::TestDomain domain;
    config::Dds config;
    config.domain = domain.id();
    const auto participant = Participant::open(config);
    ASSERT_TRUE(participant) << participant.error().message;
    EXPECT_THAT(send_buffers(), AllOf(Not(IsEmpty()), Each(granted_send_buffer(4 << 20))));
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
