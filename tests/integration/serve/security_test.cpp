// A match under DDS Security, with a real server and identities of a real authority.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "hall.hpp"
#include "support/authority.hpp"
#include "support/eventually.hpp"
#include "support/secure_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Context;
using camera_director::Match;
using camera_director::Observer;
using testing::AllOf;
using testing::HasSubstr;

class SecureMatchTest : public testing::Test {
  protected:
    void SetUp() override { ASSERT_TRUE(leader_.ready()) << leader_.log(); }

    // Each as in a process of its own.
    camera_director::Result<Context> open(const std::string& identity) {
        return Context::open({.domain = next_domain_apart(),
                              .cyclone_xml = apart_xml(domain_.id(), "none"),
                              .security = identity});
    }

    TestDomain domain_;
    Authority authority_;
    std::string leader_identity_ = authority_.issue("director-1", "director", "*");
    std::string standby_identity_ = authority_.issue("director-2", "director", "*");
    Server leader_{domain_.id(), {.participant_index = 0, .director_id = 1, .security = leader_identity_}};
    std::string game_identity_ = authority_.issue("cup-server", "game-server", "cup-*");
    std::string observer_identity_ = authority_.issue("anna", "observer", "cup-*");
};

TEST_F(SecureMatchTest, IsServedAndHandedOver) {
    const Context game_context = open(game_identity_).value();
    const Context observer_context = open(observer_identity_).value();
    const Game game(game_context, "cup-1", "hall");
    Observer anna = Observer::open(observer_context, "cup-1", "anna").value();
    anna.request({.target = 1}).value();
    EXPECT_TRUE(sees_own_camera(anna)) << leader_.log();
    EXPECT_TRUE(eventually([&] {
        anna.poll().value();
        const auto info = anna.match_info().value();
        return info && info->map_name == "hall";
    })) << leader_.log();

    Server standby(domain_.id(), {.participant_index = 1, .director_id = 2, .security = standby_identity_});
    ASSERT_TRUE(standby.ready()) << standby.log();
    ASSERT_TRUE(eventually([&] { return anna.counters().value().directors == 2; }));
    leader_.process().send_signal(SIGTERM);
    EXPECT_TRUE(sees(anna, [](const auto& frame, auto) { return frame.director_id == 2; })) << standby.log();
    EXPECT_TRUE(serves_on(anna, 2, 60));
    EXPECT_EQ(leader_.process().wait(), 0);

    // Who restarts agrees on new keys with everybody.
    ASSERT_TRUE(eventually([&] { return anna.counters().value().directors == 1; }));
    Server again(domain_.id(), {.participant_index = 0, .director_id = 1, .security = leader_identity_});
    ASSERT_TRUE(eventually([&] { return anna.counters().value().directors == 2; })) << again.log();
    EXPECT_TRUE(serves_on(anna, 2, 60)) << "whoever leads, leads on";
    standby.process().send_signal(SIGKILL);
    EXPECT_TRUE(sees(anna, [](const auto& frame, auto) { return frame.director_id == 1; })) << again.log();
    EXPECT_TRUE(serves_on(anna, 1, 60));
}

TEST_F(SecureMatchTest, TheSdkOpensOnlyWhatItsIdentityMay) {
    const Context game_context = open(game_identity_).value();
    const Context observer_context = open(observer_identity_).value();
    camera_director::MatchInfo info;
    info.map_name = "hall";
    const auto refusal = [&](const Context& context, const std::string& match) {
        info.match_id = match;
        const auto opened = Match::open(context, info);
        return opened ? "none" : std::string(opened.error().what());
    };
    EXPECT_EQ(refusal(game_context, "cup-1"), "none");
    EXPECT_THAT(refusal(game_context, "league-1"), HasSubstr("Not Allowed By Security"));
    EXPECT_THAT(refusal(observer_context, "cup-2"), HasSubstr("Not Allowed By Security"));
    EXPECT_TRUE(Observer::open(observer_context, "cup-1", "anna"));
    EXPECT_FALSE(Observer::open(observer_context, "league-1", "anna"));
    EXPECT_FALSE(Observer::open(game_context, "cup-1", "anna"));
}

TEST_F(SecureMatchTest, RenewedIdentitiesAreServed) {
    const Context before = open(observer_identity_).value();
    authority_.run("renew", {"cup-server"});
    authority_.run("renew", {"anna"});
    const Context game_context = open(game_identity_).value();
    const Context after = open(observer_identity_).value();
    const Game game(game_context, "cup-1", "hall");
    for (const Context* context : {&before, &after}) {
        Observer anna = Observer::open(*context, "cup-1", "anna").value();
        anna.request({.target = 1}).value();
        EXPECT_TRUE(sees_own_camera(anna)) << leader_.log();
    }
}

TEST_F(SecureMatchTest, AProcessHasOneIdentityInADomain) {
    auto options = connection(domain_.id());
    options.security = game_identity_;
    const Context context = Context::open(options).value();
    EXPECT_TRUE(Context::open(options));
    for (const std::optional<std::string>& other : {std::optional(observer_identity_), {}}) {
        options.security = other;
        const auto opened = Context::open(options);
        ASSERT_FALSE(opened);
        EXPECT_EQ(opened.error().status(), CDIR_CONFLICT);
        EXPECT_THAT(opened.error().what(), HasSubstr("another identity"));
    }
}

TEST_F(SecureMatchTest, IdentitiesThatAreNotCompleteAreRefusedAtOnce) {
    std::filesystem::remove(observer_identity_ + "/governance.p7s");
    const auto opened = open(observer_identity_);
    ASSERT_FALSE(opened);
    EXPECT_EQ(opened.error().status(), CDIR_INVALID_ARGUMENT);
    EXPECT_THAT(opened.error().what(), AllOf(HasSubstr("security: " + observer_identity_ + "/governance.p7s"),
                                             HasSubstr("cannot be read")));
    EXPECT_FALSE(open(""));
}

}  // namespace
}  // namespace camdir::test
