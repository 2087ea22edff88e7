#include "network.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "failure.hpp"

namespace camdir::sdk {
namespace {

using testing::HasSubstr;

std::string configuration(const char* network_interface, const char* directors) {
    cdir_context_options options = cdir_context_options_default();
    options.network_interface = network_interface;
    options.directors = directors;
    return network_configuration(options);
}

TEST(NetworkConfiguration, DefaultStaysOnThisHost) {
    const std::string xml = network_configuration(cdir_context_options_default());
    for (const char* part :
         {"<NetworkInterface name=\"lo\"/>", "<AllowMulticast>false<", "<ParticipantIndex>none<",
          "<MaxAutoParticipantIndex>0<", "<SPDPInterval>1s<", "<Peers><Peer Address=\"127.0.0.1\"/></Peers>",
          "<MaxMessageSize>65500B<", "<SocketSendBufferSize max=\"4MB\"/>", "<WriterLingerDuration>50ms<"}) {
        EXPECT_THAT(xml, HasSubstr(part));
    }
}

TEST(NetworkConfiguration, InterfaceByNameByAddressOrBySystem) {
    EXPECT_THAT(configuration("eth0.7", "a"), HasSubstr("<NetworkInterface name=\"eth0.7\"/>"));
    EXPECT_THAT(configuration("10.0.0.4", "a"), HasSubstr("<NetworkInterface address=\"10.0.0.4\"/>"));
    EXPECT_THAT(configuration("", "a"), HasSubstr("<NetworkInterface autodetermine=\"true\"/>"));
}

TEST(NetworkConfiguration, EachDirectorIsAPeer) {
    EXPECT_THAT(configuration("lo", "10.0.0.5:7412, director-1.example"),
                HasSubstr("<Peer Address=\"10.0.0.5:7412\"/><Peer Address=\"director-1.example\"/>"));
}

TEST(NetworkConfiguration, InvalidAddressesAreRefused) {
    for (const char* wrong : {"", ",", "a,,b", "a\"/><x", "a<b", "a&b", "a\nb"}) {
        EXPECT_THROW((void)configuration("lo", wrong), Failure) << wrong;
    }
    EXPECT_THROW((void)configuration("e\"th", "a"), Failure);
}

TEST(NetworkConfiguration, OneDirectorAtLeastIsKnown) {
    cdir_context_options options = cdir_context_options_default();
    for (const char* known : {"127.0.0.1", "127.0.0.1:7412", "nobody.invalid, 127.0.0.1", "[::1]:7412"}) {
        options.directors = known;
        EXPECT_NO_THROW(require_known_director(options)) << known;
    }
    options.directors = "nobody.invalid, 300.1.1.1:7412";
    try {
        require_known_director(options);
        ADD_FAILURE() << "no failure";
    } catch (const Failure& failure) {
        EXPECT_EQ(failure.status, CDIR_NETWORK);
        EXPECT_THAT(failure.text, HasSubstr("nobody.invalid, 300.1.1.1:7412"));
    }
}

TEST(NetworkConfiguration, GivenXmlReplacesEverything) {
    cdir_context_options options = cdir_context_options_default();
    options.cyclone_xml = "<CycloneDDS/>";
    EXPECT_EQ(network_configuration(options), "<CycloneDDS/>");
}

}  // namespace
}  // namespace camdir::sdk
