#include "director/requests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "stage.hpp"

namespace camdir::director {
namespace {

// Refuses statuses while it is told to.
class FullPublisher final : public MemoryPublisher {
  public:
    using MemoryPublisher::publish;
    bool publish(const ObserverStatus& status) override {
        return MemoryPublisher::publish(status) && !is_full;
    }
    bool is_full = false;
};

class RequestsTest : public testing::Test {
  protected:
    bool put(const ObserverRequest& request) { return requests_.put(request, config_, 1); }

    // Returns the number of statuses that it publishes.
    std::size_t reconcile(std::int64_t now, std::uint64_t epoch = 1) {
        const std::size_t before = publisher_.statuses_published();
        requests_.reconcile({config_, roster_, epoch, "", "", "", now});
        return publisher_.statuses_published() - before;
    }

    FullPublisher publisher_;
    MatchCounters counters_;
    Roster roster_;
    config::Config config_ = Stage::default_config();
    Requests requests_{"m", publisher_, counters_};
};

TEST_F(RequestsTest, TheSameRequestIsAnsweredAgainAtMostOnceASecond) {
    EXPECT_TRUE(put(Stage::request("anna")));
    EXPECT_EQ(reconcile(0), 1U);
    EXPECT_EQ(requests_.next_answers(), Requests::never);
    for (int i = 1; i < 1000; ++i) {
        EXPECT_FALSE(put(Stage::request("anna")));
        ASSERT_EQ(reconcile(i * ms), 0U);
        ASSERT_EQ(requests_.next_answers(), 1000 * ms);
    }
    EXPECT_EQ(reconcile(1000 * ms), 1U);
    EXPECT_EQ(requests_.next_answers(), Requests::never);
    EXPECT_EQ(reconcile(9000 * ms), 0U);
    put(Stage::request("anna"));
    EXPECT_EQ(reconcile(9000 * ms), 1U) << "who asks once is answered at once";
}

TEST_F(RequestsTest, AChangedRequestIsAnsweredAtOnce) {
    put(Stage::request("anna", 1));
    EXPECT_EQ(reconcile(0), 1U);
    EXPECT_TRUE(put(Stage::request("anna", 2)));
    EXPECT_EQ(reconcile(1 * ms), 1U);
    EXPECT_EQ(publisher_.status("anna").reason, "player 2 is not in the match");
}

TEST_F(RequestsTest, TheSameRequestIsNotReadAgain) {
    put(Stage::request("anna"));
    reconcile(0);
    requests_.put(Stage::request("anna"), {}, 1);  // a configuration without profiles
    EXPECT_EQ(reconcile(5000 * ms), 1U);
    EXPECT_EQ(publisher_.status("anna").state, RequestState::waiting_for_player);
}

TEST_F(RequestsTest, AStatusThatIsNotPublishedIsTriedAgainEverySecond) {
    publisher_.is_full = true;
    put(Stage::request("anna"));
    EXPECT_EQ(reconcile(0), 1U);
    EXPECT_EQ(requests_.next_answers(), 1000 * ms);
    EXPECT_EQ(reconcile(999 * ms), 0U);
    EXPECT_EQ(requests_.next_answers(), 1000 * ms);
    EXPECT_EQ(reconcile(1000 * ms), 1U);
    EXPECT_EQ(requests_.next_answers(), 2000 * ms);
    publisher_.is_full = false;
    EXPECT_EQ(reconcile(2000 * ms), 1U);
    EXPECT_EQ(requests_.next_answers(), Requests::never);
    EXPECT_EQ(reconcile(9000 * ms), 0U);
}

TEST_F(RequestsTest, SoIsTheRefusalOfOneWhoWaitsForAPlace) {
    config_.limits.observers = 1;
    put(Stage::request("anna"));
    reconcile(0);
    publisher_.is_full = true;
    EXPECT_TRUE(put(Stage::request("ben")));
    EXPECT_EQ(reconcile(0), 1U);
    EXPECT_EQ(reconcile(999 * ms), 0U);
    publisher_.is_full = false;
    EXPECT_EQ(reconcile(1000 * ms), 1U);
    EXPECT_EQ(publisher_.status("ben").reason, "1 observers watch this match already");
    EXPECT_FALSE(put(Stage::request("ben")));
    EXPECT_EQ(reconcile(1500 * ms), 0U);
    EXPECT_EQ(reconcile(2000 * ms), 1U);
    EXPECT_EQ(requests_.next_answers(), Requests::never);
}

TEST_F(RequestsTest, OneWhoCannotEvenWaitIsNewOnce) {
    config_.limits.observers = 1;
    put(Stage::request("anna"));
    put(Stage::request("ben"));
    EXPECT_TRUE(put(Stage::request("carl")));
    EXPECT_FALSE(put(Stage::request("carl")));
    EXPECT_EQ(publisher_.statuses_published(), 2U) << "the answer may have been lost";
    requests_.remove("carl", config_);
    EXPECT_TRUE(put(Stage::request("carl")));
    requests_.remove("ben", config_);
    EXPECT_TRUE(put(Stage::request("carl"))) << "now carl waits";
    Statistics sum;
    counters_.add_to(sum);
    EXPECT_EQ(sum[Counter::refused_observers], 2U);
}

TEST_F(RequestsTest, RefusalsAreCountedWhenTheyChange) {
    ObserverRequest request = Stage::request("anna");
    request.profile = "unknown";
    for (int i = 0; i < 3; ++i) {
        put(request);
        EXPECT_EQ(reconcile(i * 1000 * ms), 1U);
    }
    Statistics sum;
    counters_.add_to(sum);
    EXPECT_EQ(sum[Counter::refused_invalid], 1U);
    EXPECT_EQ(sum[Counter::refused_observers], 0U);
}

// Observers who ask for group shots in a match of 64 players.
class GroupRequestsTest : public RequestsTest {
  protected:
    void SetUp() override {
        std::vector<Player> players;
        for (std::uint32_t player = 1; player <= 64; ++player)
            players.push_back({.id = player, .name = {}, .player_class = {}});
        roster_.set_listed(players);
    }
    void ask(const std::string& observer_id, std::uint32_t first) {
        ObserverRequest request = Stage::request(observer_id, whole_group);
        request.group = {first, first + 1};
        put(request);
    }
    // The group shot that begins with this player.
    const Shot* shot_of(std::uint32_t first) {
        const auto found = std::ranges::find_if(requests_.shots(), [&](const Shot& shot) {
            return shot.key.group == std::vector{first, first + 1};
        });
        return found == requests_.shots().end() ? nullptr : &*found;
    }
    std::size_t group_shots() {
        return static_cast<std::size_t>(std::ranges::count_if(requests_.shots(), &Shot::is_of_group));
    }
};

TEST_F(GroupRequestsTest, EightBeginAtOnceAndFiveASecondAfterThat) {
    for (std::uint32_t i = 0; i < 20; ++i)
        ask("o" + std::to_string(i), 2 * i + 1);
    EXPECT_EQ(reconcile(0), 20U);
    for (std::int64_t begun = 8; begun < 20; ++begun) {
        EXPECT_EQ(group_shots(), static_cast<std::size_t>(begun));
        const std::int64_t next = requests_.next_answers();
        EXPECT_EQ(next, (begun - 7) * 200 * ms);
        EXPECT_EQ(reconcile(next - 1), 0U);
        EXPECT_EQ(reconcile(next), 1U);
    }
    EXPECT_EQ(group_shots(), 20U);
    EXPECT_EQ(requests_.next_answers(), Requests::never);
}

TEST_F(GroupRequestsTest, WhoeverWaitsForAFirstShotIsToldSo) {
    for (std::uint32_t i = 0; i < 8; ++i)
        ask("a" + std::to_string(i), 2 * i + 1);
    ask("zoe", 31);
    reconcile(0);
    const ObserverStatus waits = publisher_.status("zoe");
    EXPECT_EQ(waits.state, RequestState::accepted);
    EXPECT_NE(waits.reason, "");
    EXPECT_EQ(shot_of(31), nullptr);
    reconcile(200 * ms);
    ASSERT_NE(shot_of(31), nullptr);
    EXPECT_EQ(publisher_.status("zoe").camera_id, shot_of(31)->camera_id);
    EXPECT_EQ(publisher_.status("zoe").reason, "");
    EXPECT_EQ(waits.camera_id, shot_of(31)->camera_id);
}

TEST_F(GroupRequestsTest, WhoAskForTheSamePayOnce) {
    for (int i = 0; i < 12; ++i)
        ask("a" + std::to_string(i), 1);
    for (std::uint32_t i = 0; i < 7; ++i)
        ask("b" + std::to_string(i), 2 * i + 3);
    for (int i = 0; i < 3; ++i)
        ask("c" + std::to_string(i), 41);
    reconcile(0);
    EXPECT_EQ(group_shots(), 8U);
    ASSERT_NE(shot_of(1), nullptr);
    EXPECT_EQ(shot_of(1)->observers, 12U);
    EXPECT_EQ(shot_of(41), nullptr);
    reconcile(200 * ms);
    ASSERT_NE(shot_of(41), nullptr);
    EXPECT_EQ(shot_of(41)->observers, 3U);
}

// Observers take no answer of an epoch before.
TEST_F(GroupRequestsTest, WhoeverWaitsIsAnsweredAgainInANewEpoch) {
    ask("anna", 1);
    reconcile(0);
    for (std::uint32_t i = 0; i < 7; ++i)
        ask("o" + std::to_string(i), 2 * i + 11);
    reconcile(0);
    ask("anna", 31);
    reconcile(1 * ms, 2);
    ASSERT_NE(shot_of(1), nullptr);
    EXPECT_EQ(publisher_.status("anna").epoch, 2U);
    EXPECT_EQ(publisher_.status("anna").camera_id, shot_of(1)->camera_id);
}

TEST_F(GroupRequestsTest, WhereThereIsNoRoomNobodyWaitsOrPays) {
    config_.limits.shots = 2;
    ask("anna", 1);
    ask("bert", 3);
    reconcile(0);
    for (std::uint32_t i = 0; i < 20; ++i)
        ask("o" + std::to_string(i), 2 * i + 11);
    for (std::int64_t time = 10; time < 100; time += 10)
        reconcile(time * ms);
    EXPECT_EQ(requests_.next_answers(), Requests::never);
    for (std::uint32_t i = 0; i < 20; ++i)
        EXPECT_EQ(publisher_.status("o" + std::to_string(i)).state, RequestState::refused);
    for (const std::uint32_t first : {5U, 7U, 9U}) {  // each makes room for itself
        ask("bert", first);
        reconcile(200 * ms);
        EXPECT_NE(shot_of(first), nullptr);
    }
}

TEST_F(GroupRequestsTest, UntilTheNewOneBeginsTheShotAndItsAnswerStay) {
    ask("anna", 1);
    reconcile(0);
    const std::uint32_t camera = publisher_.status("anna").camera_id;
    for (std::uint32_t i = 0; i < 7; ++i)
        ask("o" + std::to_string(i), 2 * i + 11);
    reconcile(0);
    for (std::int64_t i = 1; i < 20; ++i) {  // a hundred times a second
        ask("anna", static_cast<std::uint32_t>(30 + i));
        EXPECT_EQ(reconcile(i * 10 * ms), 0U);
        ASSERT_NE(shot_of(1), nullptr);
        EXPECT_EQ(shot_of(1)->observers, 1U);
        EXPECT_EQ(publisher_.status("anna").camera_id, camera);
    }
    EXPECT_EQ(reconcile(200 * ms), 1U);
    EXPECT_EQ(shot_of(1), nullptr);
    ASSERT_NE(shot_of(49), nullptr) << "the one that was asked for last";
    EXPECT_EQ(publisher_.status("anna").camera_id, shot_of(49)->camera_id);
    put(Stage::request("anna", 2));
    reconcile(201 * ms);
    EXPECT_EQ(shot_of(49), nullptr);
}

TEST_F(GroupRequestsTest, WhoChangesOrLeavesAndReturnsAllTheTimeStarvesNobody) {
    std::uint32_t next = 1;
    const auto everybody_changes = [&] {
        for (int i = 0; i < 20; ++i) {
            const std::string id = "a" + std::to_string(i);
            if (i % 2 == 0) requests_.remove(id, config_);
            ask(id, next);
            next = next % 60 + 1;
        }
    };
    for (const std::uint32_t first : {63U, 61U}) {  // a first shot, then another
        const std::int64_t asked = first == 63 ? 10'000 : 20'000;
        for (std::int64_t time = asked - 10'000; time < asked; time += 10) {
            everybody_changes();
            reconcile(time * ms);
        }
        ask("zoe", first);
        for (std::int64_t time = asked; time <= asked + 21 * 200 && shot_of(first) == nullptr; time += 10) {
            everybody_changes();
            reconcile(time * ms);
        }
        EXPECT_NE(shot_of(first), nullptr);
    }
}

}  // namespace
}  // namespace camdir::director
