#include "dds/protection.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/file.hpp"
#include "support/authority.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::dds {
namespace {

namespace fs = std::filesystem;
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

constexpr const char* identity_files[] = {"identity_ca.pem", "certificate.pem",    "key.pem",
                                          "revoked.pem",     "permissions_ca.pem", "governance.p7s",
                                          "permissions.p7s"};

class IdentityTest : public testing::Test {
  protected:
    IdentityTest() {
        config_.interface = "eth0";
        config_.security = folder_.string();
    }
    void write(const char* name, const std::string& content) {
        ASSERT_TRUE(write_file(folder_ / name, content));
    }
    void take(const std::vector<const char*>& names, const fs::path& from) {
        for (const char* name : names)
            fs::copy_file(from / name, folder_ / name, fs::copy_options::overwrite_existing);
    }

    test::Authority authority_;
    const fs::path folder_ = authority_.issue("director", "director", "*");
    config::Dds config_;
};

TEST_F(IdentityTest, LetsDdsLeaveLoopback) {
    EXPECT_EQ(problem(config_), "");
    config_.xml = "<CycloneDDS/>";
    EXPECT_EQ(problem(config_), "");
}

TEST_F(IdentityTest, TellsWhenItExpires) {
    const auto identity = check_protection(config_);
    ASSERT_TRUE(identity && *identity);
    const auto days = ((*identity)->expires - std::chrono::system_clock::now()) / std::chrono::hours(24);
    EXPECT_NEAR(static_cast<double>(days), 365.0, 1.0);
}

TEST_F(IdentityTest, NamesTheFileThatIsMissing) {
    for (const char* name : identity_files) {
        fs::rename(folder_ / name, folder_ / "moved");
        EXPECT_THAT(problem(config_),
                    AllOf(StartsWith("/dds/security: " + (folder_ / name).string() + ": "),
                          HasSubstr("cannot be read: No such file"), HasSubstr("authority.sh")));
        fs::rename(folder_ / "moved", folder_ / name);
    }
    write("revoked.pem", "");
    EXPECT_THAT(problem(config_), HasSubstr("revoked.pem: is empty"));
    config_.security = (folder_ / "key.pem").string();
    EXPECT_THAT(problem(config_), HasSubstr("cannot be read: Not a directory"));
}

TEST_F(IdentityTest, ItsKeyIsNotOpenToEveryone) {
    for (const unsigned mode : {0604U, 0602U, 0644U}) {
        fs::permissions(folder_ / "key.pem", fs::perms(mode));
        EXPECT_THAT(problem(config_),
                    AllOf(HasSubstr("key.pem: is open to everyone"), HasSubstr("chmod o-rwx")));
    }
}

TEST_F(IdentityTest, NamesTheFileThatSaysNothing) {
    for (const char* name : identity_files) {
        fs::copy_file(folder_ / name, folder_ / "kept");
        std::ofstream(folder_ / name) << "content";
        EXPECT_THAT(problem(config_),
                    AllOf(StartsWith("/dds/security: " + (folder_ / name).string() + ": is no "),
                          HasSubstr("renew the identity")));
        fs::rename(folder_ / "kept", folder_ / name);
    }
    EXPECT_EQ(problem(config_), "");
}

TEST_F(IdentityTest, NamesTheFileThatDoesNotFit) {
    const fs::path sibling = authority_.issue("sibling", "director", "*");
    const test::Authority others;
    const fs::path stranger = others.issue("director", "director", "*");
    const auto mixed = [&](const std::vector<const char*>& names, const fs::path& from) {
        const test::TemporaryFolder kept;
        for (const char* name : identity_files)
            fs::copy_file(folder_ / name, kept / name);
        take(names, from);
        std::string result = problem(config_);
        take({std::begin(identity_files), std::end(identity_files)}, kept.path());
        return result;
    };
    EXPECT_THAT(mixed({"key.pem"}, sibling), HasSubstr("key.pem: does not belong to "));
    EXPECT_THAT(mixed({"certificate.pem", "key.pem"}, stranger),
                HasSubstr("certificate.pem: is not signed by " + (folder_ / "identity_ca.pem").string()));
    EXPECT_THAT(mixed({"revoked.pem"}, stranger), HasSubstr("revoked.pem: "));
    EXPECT_THAT(mixed({"governance.p7s"}, stranger), HasSubstr("governance.p7s: is not signed by "));
    EXPECT_THAT(mixed({"permissions.p7s"}, stranger), HasSubstr("permissions.p7s: is not signed by "));
}

TEST_F(IdentityTest, NamesTheCertificateThatIsNotValidNow) {
    authority_.certify(folder_, "-startdate 20200101000000Z -enddate 20200201000000Z");
    EXPECT_THAT(problem(config_), HasSubstr("certificate.pem: has expired"));
    authority_.certify(folder_, "-startdate $(date -u -d '2 days' +%Y%m%d%H%M%SZ)");
    EXPECT_THAT(problem(config_), AllOf(HasSubstr("certificate.pem: is not valid yet"), HasSubstr("clock")));
}

TEST_F(IdentityTest, NamesTheCertificateThatIsRevoked) {
    authority_.run("revoke", {"director"});
    EXPECT_THAT(problem(config_), HasSubstr("certificate.pem: is revoked"));
}

}  // namespace
}  // namespace camdir::dds
