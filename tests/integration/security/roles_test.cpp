// Who may do what: every role meets every other role that tries everything.
#include <gtest/gtest.h>

#include <algorithm>
#include <tuple>

#include "support/authority.hpp"
#include "support/eventually.hpp"
#include "support/secure_peer.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using wire::Topic;

struct Role {
    const char* name;
    std::vector<Topic> writes, reads;
};

const Role game_server{
    "game-server",
    {Topic::match_info, Topic::pose_frame, Topic::match_event, Topic::mover_info, Topic::mover_frame},
    {}};
const Role director{"director",
                    {Topic::shown_match, Topic::camera_frame, Topic::observer_status, Topic::director_sign},
                    {Topic::match_info, Topic::pose_frame, Topic::match_event, Topic::observer_request,
                     Topic::camera_frame, Topic::director_sign, Topic::mover_info, Topic::mover_frame}};
const Role observer{
    "observer", {Topic::observer_request}, {Topic::shown_match, Topic::camera_frame, Topic::observer_status}};

bool contains(const std::vector<Topic>& topics, Topic topic) {
    return std::ranges::find(topics, topic) != topics.end();
}

void PrintTo(const Role& role, std::ostream* out) {
    *out << role.name;
}

class RolesTest : public testing::TestWithParam<std::tuple<Role, Role>> {
  protected:
    static void SetUpTestSuite() {
        authority_ = std::make_unique<Authority>();
        for (const Role* role : {&game_server, &director, &observer}) {
            authority_->issue(role->name, role->name, "cup-*");
            authority_->issue(std::string("other-") + role->name, role->name, "cup-*");
        }
    }
    static void TearDownTestSuite() { authority_.reset(); }

    static std::string identity(const std::string& name) {
        return authority_->folder() / "identities" / name;
    }

    // The other's endpoint was accepted, or refused by access control.
    [[nodiscard]] bool is_decided(const SecurePeer& peer, Topic topic) const {
        const std::string end = std::string(": ") + wire::topic_name(topic) + " denied";
        const bool writer = !peer.reads(topic) || peer.matched_writers(topic) > 0 ||
                            log_.has({"does not allow remote writer", end});
        const bool reader = !peer.writes(topic) || peer.matched_readers(topic) > 0 ||
                            log_.has({"does not allow remote reader", end});
        return writer && reader;
    }

    TestDomain domain_;
    DdsLog log_;
    const std::vector<std::string> cup_{"match/cup-1"};

  private:
    static inline std::unique_ptr<Authority> authority_;
};

TEST_P(RolesTest, EndpointsBeyondARoleAreRefused) {
    const auto& [own, other] = GetParam();
    SecurePeer peer(domain_.id(), true, identity(own.name));
    peer.do_everything(cup_);
    for (const Topic topic : all_topics) {
        EXPECT_EQ(peer.writes(topic), contains(own.writes, topic)) << wire::topic_name(topic);
        EXPECT_EQ(peer.reads(topic), contains(own.reads, topic)) << wire::topic_name(topic);
    }
    SecurePeer intruder(domain_.id(), false, identity(std::string("other-") + other.name),
                        SecurePeer::Access::permissive);
    intruder.do_everything(cup_);
    for (const Topic topic : all_topics) {
        ASSERT_TRUE(intruder.writes(topic) && intruder.reads(topic)) << wire::topic_name(topic);
        EXPECT_TRUE(eventually([&] { return is_decided(peer, topic); })) << wire::topic_name(topic) << '\n'
                                                                         << log_.text();
    }
    for (const Topic topic : all_topics) {
        const auto may = [&](const std::vector<Topic>& ours, const std::vector<Topic>& theirs) {
            return contains(ours, topic) && contains(theirs, topic) ? 1U : 0U;
        };
        EXPECT_EQ(peer.matched_writers(topic), may(own.reads, other.writes)) << wire::topic_name(topic);
        EXPECT_EQ(peer.matched_readers(topic), may(own.writes, other.reads)) << wire::topic_name(topic);
    }
}

INSTANTIATE_TEST_SUITE_P(Each, RolesTest,
                         testing::Combine(testing::Values(game_server, director, observer),
                                          testing::Values(game_server, director, observer)),
                         [](const auto& pair) {
                             std::string name = std::string(std::get<0>(pair.param).name) + "_and_" +
                                                std::get<1>(pair.param).name;
                             std::ranges::replace(name, '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace camdir::test
