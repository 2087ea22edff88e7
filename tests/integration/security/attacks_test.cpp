// Strangers, forgers and those that were dismissed, each with an access control of its own that allows
// everything: a director refuses them, and goes on with its game server.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <memory>

#include "support/authority.hpp"
#include "support/child_process.hpp"
#include "support/eventually.hpp"
#include "support/secure_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

namespace fs = std::filesystem;
using wire::Topic;

constexpr auto permissive = SecurePeer::Access::permissive;
const std::vector<std::string> cup{"match/cup-1"};
const std::vector<std::string> league{"match/league-1"};

int run(const std::string& shell_command) {
    return ChildProcess({"/bin/bash", "-ec", shell_command}).wait();
}

class AttackTest : public testing::Test {
  protected:
    static constexpr std::uint32_t of_games = 5;  // topics that game servers write

    // With the identity as it is now.
    std::unique_ptr<SecurePeer> make_director(const std::vector<std::string>& partitions = cup) {
        if (!fs::exists(director_identity())) authority_.issue("director", "director", "*");
        auto director = std::make_unique<SecurePeer>(domain_.id(), true, director_identity());
        director->do_everything(partitions);
        return director;
    }
    fs::path director_identity() const { return authority_.folder() / "identities" / "director"; }

    // The director has said so.
    [[nodiscard]] bool refused(const std::vector<std::string>& why) const {
        return eventually([&] { return log_.has(why); });
    }
    // None of its endpoints is matched, and those of a game server that joins now are.
    void expect_left_out(const SecurePeer& attacker, const SecurePeer& director) {
        SecurePeer game(domain_.id(), false, authority_.issue("game", "game-server", "cup-*"));
        game.do_everything(cup);
        EXPECT_TRUE(eventually([&] { return director.matches() == of_games && game.matches() == of_games; }))
            << log_.text();
        EXPECT_EQ(attacker.matches(), 0U);
    }

    TestDomain domain_;
    Authority authority_;
    DdsLog log_;
};

TEST_F(AttackTest, WithoutAnIdentity) {
    const auto director = make_director();
    SecurePeer plain(domain_.id(), false, "");
    plain.do_everything(cup);
    expect_left_out(plain, *director);
}

TEST_F(AttackTest, WithAnIdentityOfAnotherAuthority) {
    const auto director = make_director();
    const Authority other;
    SecurePeer foreign(domain_.id(), false, other.issue("director", "director", "*"), permissive);
    foreign.do_everything(cup);
    EXPECT_TRUE(refused({"Certificate not valid", "unable to get local issuer certificate"})) << log_.text();
    expect_left_out(foreign, *director);
}

TEST_F(AttackTest, WithPermissionsSignedByItself) {
    const auto director = make_director();
    const fs::path own = authority_.issue("anna", "observer", "cup-*");
    const Authority other;
    const fs::path forged = other.issue("anna", "director", "*");
    for (const char* name : {"permissions_ca.pem", "permissions.p7s", "governance.p7s"})
        fs::copy_file(forged / name, own / name, fs::copy_options::overwrite_existing);
    SecurePeer forger(domain_.id(), false, own, permissive);
    forger.do_everything(cup);
    EXPECT_TRUE(refused({"Could not get remote participant", "permissions", "self-signed certificate"}))
        << log_.text();
    expect_left_out(forger, *director);
}

// Not even its own plugin makes a participant of these.
TEST_F(AttackTest, WithPermissionsThatAreNotItsOwnOrWereChanged) {
    const fs::path own = authority_.issue("anna", "observer", "cup-*");
    const fs::path others = authority_.issue("berta", "director", "*");
    fs::copy_file(others / "permissions.p7s", own / "permissions.p7s", fs::copy_options::overwrite_existing);
    EXPECT_ANY_THROW(SecurePeer(domain_.id(), false, own, permissive));
    ASSERT_EQ(run("sed -i 's/ObserverRequest/CameraFrame/' " + (others / "permissions.p7s").string()), 0);
    EXPECT_ANY_THROW(SecurePeer(domain_.id(), false, others, permissive));
}

TEST_F(AttackTest, WithACertificateThatExpires) {
    const fs::path own = authority_.issue("carla", "director", "*");
    // Valid for long enough to begin with it.
    authority_.certify(own, "-enddate $(date -u -d '20 seconds' +%Y%m%d%H%M%SZ)");
    SecurePeer expired(domain_.id(), false, own, permissive);
    expired.do_everything(cup);
    ASSERT_TRUE(eventually([&] {
        return run("! openssl x509 -checkend 0 -noout -in " + (own / "certificate.pem").string()) == 0;
    }));
    const auto director = make_director();
    EXPECT_TRUE(refused({"Certificate not valid", "certificate has expired"})) << log_.text();
    expect_left_out(expired, *director);
}

TEST_F(AttackTest, AfterItWasRevoked) {
    authority_.issue("director", "director", "*");
    const fs::path own = authority_.issue("carla", "director", "*");
    fs::copy(own, authority_.folder() / "kept");  // without what follows
    authority_.run("revoke", {"carla"});
    const auto director = make_director();
    SecurePeer revoked(domain_.id(), false, authority_.folder() / "kept", permissive);
    revoked.do_everything(cup);
    EXPECT_TRUE(refused({"Certificate not valid", "certificate revoked"})) << log_.text();
    expect_left_out(revoked, *director);

    authority_.run("renew", {"carla"});
    SecurePeer renewed(domain_.id(), false, own);
    renewed.do_everything(cup);
    EXPECT_TRUE(eventually([&] { return renewed.matches() == 4; }))
        << "CameraFrame and DirectorSign, both ways";
}

TEST_F(AttackTest, OnMatchesOfOthers) {
    const auto director = make_director(league);
    const fs::path own = authority_.issue("cup-server", "game-server", "cup-*");
    SecurePeer intruder(domain_.id(), false, own, permissive);
    intruder.write(Topic::match_info, league);
    intruder.write(Topic::pose_frame, {"match/*"});
    intruder.write(Topic::match_event, {"match/cup-1", "match/league-1"});
    for (const char* topic : {"MatchInfo", "PoseFrame", "MatchEvent"})
        EXPECT_TRUE(refused({"does not allow remote writer", std::string(": ") + topic + " denied"}))
            << log_.text();
    EXPECT_EQ(director->matches(), 0U);
    SecurePeer game(domain_.id(), false, authority_.issue("league-server", "game-server", "league-?"));
    game.do_everything(league);
    EXPECT_TRUE(eventually([&] { return director->matches() == of_games; }));
}

TEST_F(AttackTest, WithMorePartitionsThanItMay) {
    const fs::path own = authority_.issue("cup-server", "game-server", "cup-*");
    SecurePeer honest(domain_.id(), true, own);
    for (const std::vector<std::string>& partitions :
         {league, std::vector<std::string>{"match/*"}, {"match/cup-1", "match/league-1"}, {""}, {}}) {
        honest.do_everything(partitions);
        EXPECT_FALSE(honest.writes(Topic::pose_frame)) << testing::PrintToString(partitions);
    }
    honest.do_everything({"match/cup-1", "match/cup-*"});
    EXPECT_TRUE(honest.writes(Topic::pose_frame));
}

}  // namespace
}  // namespace camdir::test
