#include "connection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camdir::qtv {
namespace {

TEST(Address, IsAHostAndAPort) {
    for (const char* text : {"127.0.0.1:28000", "qtv.example.org:1", "[::1]:65535"}) {
        const auto address = parse_address(text);
        ASSERT_TRUE(address) << address.error().message;
        EXPECT_EQ(text_of(*address), text);
    }
    EXPECT_EQ(parse_address("[::1]:2")->host, "::1");
    for (const char* text :
         {"", "host", ":1", "host:", "host:0", "host:65536", "host:1x", "::1:28000", "[]:1"}) {
        const auto address = parse_address(text);
        ASSERT_FALSE(address) << text;
        EXPECT_EQ(address.error().message, "'" + std::string(text) + "': expected HOST:PORT");
    }
}

TEST(Stop, EndsAWaitAtOnceAndForEver) {
    std::stop_source source;
    const StopEvent stop(source.get_token());
    EXPECT_FALSE(stop.wait(std::chrono::milliseconds(0)));
    source.request_stop();
    EXPECT_TRUE(stop.wait(std::chrono::hours(1)));
    EXPECT_TRUE(stop.wait(std::chrono::hours(1)));
}

}  // namespace
}  // namespace camdir::qtv
