// deploy/security/authority.sh, as operators use it. What its identities may do is tested beside.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "support/authority.hpp"
#include "support/child_process.hpp"

namespace camdir::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;
using testing::UnorderedElementsAre;

std::string content(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
}

std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename());
    return names;
}

class AuthorityTest : public testing::Test {
  protected:
    // Its message when it fails, with its exit code.
    [[nodiscard]] std::string refusal(const std::string& command,
                                      const std::vector<std::string>& arguments) const {
        try {
            authority_.run(command, arguments);
            return "none";
        } catch (const std::runtime_error& error) {
            return error.what();
        }
    }

    Authority authority_;
    const fs::path folder_ = authority_.folder();
    const fs::path identities_ = folder_ / "identities";
};

TEST_F(AuthorityTest, NobodyElseCanReadItsFiles) {
    authority_.issue("game", "game-server", "cup-*");
    for (const auto& entry : fs::recursive_directory_iterator(folder_))
        EXPECT_EQ(entry.status().permissions(), fs::perms(entry.is_directory() ? 0700 : 0600)) << entry;
    EXPECT_EQ(fs::status(folder_).permissions(), fs::perms(0700));
    EXPECT_THAT(names_in(identities_ / "game"),
                UnorderedElementsAre("certificate.pem", "governance.p7s", "identity_ca.pem", "key.pem",
                                     "permissions.p7s", "permissions_ca.pem", "revoked.pem"));
}

TEST_F(AuthorityTest, OverwritesNothing) {
    authority_.issue("game", "game-server", "cup-*");
    const std::string ca = content(folder_ / "identity_ca.pem");
    const std::string key = content(identities_ / "game" / "key.pem");
    EXPECT_THAT(refusal("create", {}), HasSubstr("is there already, and nothing is overwritten"));
    EXPECT_THAT(refusal("issue", {"game", "director", "*"}),
                AllOf(HasSubstr("'game' already"), HasSubstr("renew")));
    EXPECT_EQ(content(folder_ / "identity_ca.pem"), ca);
    EXPECT_EQ(content(identities_ / "game" / "key.pem"), key);
}

TEST_F(AuthorityTest, RejectsWhatItDoesNotUnderstandAndLeavesNothingBehind) {
    EXPECT_THAT(refusal("issue", {"../x", "director", "*"}), HasSubstr("NAME '../x': expected"));
    EXPECT_THAT(refusal("issue", {".x", "director", "*"}), HasSubstr("NAME '.x': expected"));
    EXPECT_THAT(refusal("issue", {"x,O=y", "director", "*"}), HasSubstr("NAME 'x,O=y': expected"));
    EXPECT_THAT(refusal("issue", {"x", "referee", "*"}), HasSubstr("ROLE 'referee': expected game-server"));
    for (const char* matches : {"", "a/b", "<topic>", "a b", "[a-z]"})
        EXPECT_THAT(refusal("issue", {"x", "director", matches}),
                    AllOf(HasSubstr("MATCHES '"), HasSubstr("? stands for any other character")))
            << matches;
    for (const char* days : {"0", "-1", "3651", "x", ""})
        EXPECT_THAT(refusal("issue", {"x", "director", "*", "--days", days}), HasSubstr("--days")) << days;
    EXPECT_THAT(refusal("issue", {"x", "director"}), HasSubstr("expected FOLDER NAME ROLE MATCHES"));
    EXPECT_THAT(refusal("renew", {"x"}), HasSubstr("no identity 'x' here"));
    EXPECT_THAT(refusal("revoke", {"x"}), HasSubstr("no identity 'x' here"));
    EXPECT_THAT(names_in(identities_), ElementsAre());
    EXPECT_THAT(names_in(folder_ / "grants"), ElementsAre());

    ChildProcess elsewhere({CAMDIR_AUTHORITY, "list", "/nowhere"});
    EXPECT_EQ(elsewhere.wait(), 1);
    EXPECT_THAT(elsewhere.errors(), HasSubstr("/nowhere: is no authority"));
    ChildProcess unknown({CAMDIR_AUTHORITY, "destroy"});
    EXPECT_EQ(unknown.wait(), 2);
}

TEST_F(AuthorityTest, WhatItSignsIsValidForClocksThatAreBehind) {
    authority_.issue("anna", "observer", "*");
    authority_.run("revoke", {"anna"});
    const fs::path anna = identities_ / "anna";
    ChildProcess openssl(
        {"/bin/bash", "-c",
         "cd " + anna.string() +
             " && cat identity_ca.pem revoked.pem >both && yesterday=$(date -d '23 hours ago' +%s) && "
             "openssl verify -attime $yesterday -CAfile permissions_ca.pem permissions_ca.pem && "
             "openssl verify -attime $yesterday -crl_check -CAfile both certificate.pem"});
    EXPECT_NE(openssl.wait(), 0);
    EXPECT_THAT(openssl.output(), HasSubstr("permissions_ca.pem: OK"));
    EXPECT_THAT(openssl.errors(), AllOf(HasSubstr("certificate revoked"), Not(HasSubstr("not yet valid"))));
}

TEST_F(AuthorityTest, RenewsWithTheSameGrantsAndAnotherKey) {
    const fs::path game = authority_.issue("game", "game-server", "cup-*");
    const std::string key = content(game / "key.pem");
    authority_.run("renew", {"game", "--days", "10"});
    EXPECT_NE(content(game / "key.pem"), key);
    EXPECT_THAT(content(game / "permissions.p7s"),
                AllOf(HasSubstr("<topic>PoseFrame</topic>"), HasSubstr("<partition>match/cup-*</partition>"),
                      HasSubstr("CN=game"), Not(HasSubstr("CameraFrame"))));
    EXPECT_THAT(names_in(identities_), ElementsAre("game"));
}

TEST_F(AuthorityTest, TellsEveryIdentityWhoIsRevoked) {
    authority_.issue("game", "game-server", "cup-*");
    authority_.issue("anna", "observer", "cup-*");
    const std::string nobody = content(folder_ / "revoked.pem");
    authority_.run("revoke", {"anna"});
    const std::string anna = content(folder_ / "revoked.pem");
    EXPECT_NE(anna, nobody);
    for (const char* name : {"game", "anna"})
        EXPECT_EQ(content(identities_ / name / "revoked.pem"), anna);
    EXPECT_EQ(content(authority_.issue("berta", "observer", "cup-*") / "revoked.pem"), anna);
    // As where the call was interrupted before it wrote the lists.
    std::ofstream(folder_ / "revoked.pem") << nobody;
    std::ofstream(identities_ / "game" / "revoked.pem") << nobody;
    authority_.run("revoke", {"anna"});
    EXPECT_NE(content(folder_ / "revoked.pem"), nobody);
    EXPECT_EQ(content(identities_ / "game" / "revoked.pem"), content(folder_ / "revoked.pem"));

    ChildProcess list({CAMDIR_AUTHORITY, "list", folder_.string()});
    EXPECT_EQ(list.wait(), 0);
    EXPECT_THAT(list.output(), testing::ContainsRegex("anna +observer +20[0-9-]+ +revoked +cup-\\*"));
    EXPECT_THAT(list.output(), testing::ContainsRegex("game +game-server +20[0-9-]+ +valid +cup-\\*"));
}

}  // namespace
}  // namespace camdir::test
