#include "director/requests.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
    std::size_t reconcile(std::int64_t now) {
        const std::size_t before = publisher_.statuses_published();
        requests_.reconcile({config_, roster_, 1, "", "", "", now});
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

}  // namespace
}  // namespace camdir::director
