#include "dds/protection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::dds {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string problem(const config::Dds& config) {
    const auto checked = check_protection(config);
    return checked ? "" : checked.error().message;
}

TEST(Protection, PlainDdsStaysOnLoopback) {
    for (const char* loopback : {"lo", "127.0.0.1", "127.1.2.3", "::1"}) {
        config::Dds config;
        config.interface = loopback;
        EXPECT_EQ(problem(config), "") << loopback;
    }
    for (const char* other : {"", "0.0.0.0", "10.0.0.5", "::", "fe80::1", "no-such-interface", "128.0.0.1"}) {
        config::Dds config;
        config.interface = other;
        EXPECT_THAT(problem(config), AllOf(StartsWith("/dds/interface: \"" + std::string(other) + "\""),
                                           HasSubstr("is not loopback"), HasSubstr("/dds/security"),
                                           HasSubstr("\"insecure\": true")));
        config.insecure = true;
        EXPECT_EQ(problem(config), "") << other;
    }
}

TEST(Protection, TheOperatorsXmlCountsAsLeavingLoopback) {
    config::Dds config;
    config.xml = "<CycloneDDS/>";
    EXPECT_THAT(problem(config), AllOf(StartsWith("/dds/xml: "), HasSubstr("\"insecure\": true")));
    config.insecure = true;
    EXPECT_EQ(problem(config), "");
}

class IdentityTest : public testing::Test {
  protected:
    IdentityTest() {
        for (const char* name : {"identity_ca.pem", "certificate.pem", "key.pem", "revoked.pem",
                                 "permissions_ca.pem", "governance.p7s", "permissions.p7s"})
            write(name, "content");
        std::filesystem::permissions(folder_ / "key.pem", std::filesystem::perms(0640));
        config_.interface = "eth0";
        config_.security = folder_.path().string();
    }
    void write(const char* name, const std::string& content) {
        ASSERT_TRUE(write_file(folder_ / name, content));
    }

    test::TemporaryFolder folder_;
    config::Dds config_;
};

TEST_F(IdentityTest, LetsDdsLeaveLoopback) {
    EXPECT_EQ(problem(config_), "");
    config_.xml = "<CycloneDDS/>";
    EXPECT_EQ(problem(config_), "");
}

TEST_F(IdentityTest, NamesTheFileThatIsMissing) {
    for (const char* name : {"identity_ca.pem", "certificate.pem", "key.pem", "revoked.pem",
                             "permissions_ca.pem", "governance.p7s", "permissions.p7s"}) {
        std::filesystem::rename(folder_ / name, folder_ / "moved");
        EXPECT_THAT(problem(config_),
                    AllOf(StartsWith("/dds/security: " + (folder_ / name).string() + ": "),
                          HasSubstr("cannot be read: No such file"), HasSubstr("authority.sh")));
        std::filesystem::rename(folder_ / "moved", folder_ / name);
    }
    write("revoked.pem", "");
    EXPECT_THAT(problem(config_), HasSubstr("revoked.pem: is empty"));
    config_.security = (folder_ / "key.pem").string();
    EXPECT_THAT(problem(config_), HasSubstr("cannot be read: Not a directory"));
}

TEST_F(IdentityTest, ItsKeyIsNotOpenToEveryone) {
    for (const unsigned mode : {0604U, 0602U, 0644U}) {
        std::filesystem::permissions(folder_ / "key.pem", std::filesystem::perms(mode));
        EXPECT_THAT(problem(config_),
                    AllOf(HasSubstr("key.pem: is open to everyone"), HasSubstr("chmod o-rwx")));
    }
}

}  // namespace
}  // namespace camdir::dds
