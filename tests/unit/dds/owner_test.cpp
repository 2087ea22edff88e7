// Whose a match and an observer's request are, with participants that write what is not theirs.
#include <array>
#include <limits>

#include "gateway_test.hpp"

namespace camdir::dds {
namespace {

constexpr std::uint64_t far_epoch = std::numeric_limits<std::uint64_t>::max();

using Standing = Ownership::Standing;

constexpr SenderId first_server{1}, second_server{2};
constexpr std::chrono::milliseconds limit{500};

Ownership::Claim claim_of(const SenderId& sender) {
    return {.sender = sender, .writer = sender[0], .info = {}};
}

// Seconds after the first server has opened the match, which the second describes too.
class OwnershipTest : public testing::Test {
  protected:
    void SetUp() override {
        EXPECT_EQ(ownership_.describe(claim_of(first_server), at(0)), Standing::owner);
        EXPECT_EQ(ownership_.describe(claim_of(second_server), at(0)), Standing::stranger);
    }
    static Ownership::Time at(double seconds) {
        return Ownership::Time{} + std::chrono::milliseconds(static_cast<int>(1e3 * (100 + seconds)));
    }
    Standing sends(const SenderId& sender, double seconds) {
        return ownership_.send(sender, limit, at(seconds));
    }

    Ownership ownership_;
};

TEST_F(OwnershipTest, PassesToWhoSendsWhenTheOwnerHasNotForLongerThanTheLimit) {
    EXPECT_EQ(sends(second_server, 0.5), Standing::stranger);
    EXPECT_EQ(sends(first_server, 0.5), Standing::owner);
    EXPECT_EQ(sends(second_server, 1.0), Standing::stranger);
    EXPECT_EQ(sends(second_server, 1.1), Standing::successor);
    EXPECT_EQ(sends(second_server, 1.2), Standing::owner);
    EXPECT_EQ(sends(SenderId{3}, 9.0), Standing::stranger) << "describes no match";
}

TEST_F(OwnershipTest, WhoWasOnlySilentGetsItsMatchBackAndKeepsItFromWhoHadTakenIt) {
    EXPECT_EQ(sends(second_server, 0.6), Standing::successor);
    EXPECT_EQ(sends(first_server, 0.7), Standing::successor);
    EXPECT_EQ(sends(second_server, 0.8), Standing::stranger);
    EXPECT_EQ(sends(first_server, 0.9), Standing::owner);
    EXPECT_EQ(sends(second_server, 5.0), Standing::stranger) << "it does not change hands to and fro";

    const SenderId next{3};
    EXPECT_EQ(ownership_.describe(claim_of(next), at(5.0)), Standing::stranger);
    EXPECT_EQ(sends(next, 5.0), Standing::successor) << "the first server, killed, is started again";
    EXPECT_EQ(sends(second_server, 9.0), Standing::stranger);
    EXPECT_EQ(ownership_.dispose(next[0], true, at(9.0)), Ownership::Change::succeeded);
    EXPECT_TRUE(ownership_.owns(first_server));
}

TEST_F(OwnershipTest, WhoHasGivenTheMatchBackServesOnWhenItsOwnerHangs) {
    EXPECT_EQ(sends(second_server, 0.6), Standing::successor);
    EXPECT_EQ(sends(first_server, 0.7), Standing::successor);
    EXPECT_EQ(sends(second_server, 5.7), Standing::stranger);
    EXPECT_EQ(sends(second_server, 5.8), Standing::successor);
    EXPECT_EQ(sends(second_server, 5.9), Standing::owner);
    EXPECT_EQ(sends(first_server, 6.0), Standing::successor) << "it was only silent, again";
    EXPECT_EQ(sends(second_server, 10.9), Standing::stranger);
}

TEST_F(OwnershipTest, WhoHasGivenTheMatchBackIsRememberedUntilItIsGone) {
    EXPECT_EQ(sends(second_server, 0.6), Standing::successor);
    EXPECT_EQ(sends(first_server, 0.7), Standing::successor);
    EXPECT_EQ(ownership_.dispose(second_server[0], true, at(0.8)), Ownership::Change::none);
    EXPECT_EQ(ownership_.describe(claim_of(second_server), at(0.8)), Standing::stranger);
    EXPECT_EQ(sends(second_server, 1.4), Standing::stranger);
    const std::array<WriterHandle, 1> first{first_server[0]};
    EXPECT_EQ(ownership_.retain(first, at(1.4)), Ownership::Change::none);
    EXPECT_EQ(ownership_.describe(claim_of(second_server), at(1.4)), Standing::stranger);
    EXPECT_EQ(sends(second_server, 1.4), Standing::successor) << "it may be another one";
}

TEST_F(OwnershipTest, TheFirstOfThoseWhoWereSilentGetsTheMatchBack) {
    const SenderId third{3};
    EXPECT_EQ(ownership_.describe(claim_of(third), at(0)), Standing::stranger);
    EXPECT_EQ(sends(second_server, 0.6), Standing::successor);
    EXPECT_EQ(sends(third, 1.2), Standing::successor);
    EXPECT_EQ(sends(second_server, 1.3), Standing::stranger);
    EXPECT_EQ(sends(first_server, 1.4), Standing::successor);
}

TEST_F(OwnershipTest, NothingIsGivenBackToWhoIsGone) {
    EXPECT_EQ(sends(second_server, 0.6), Standing::successor);
    const std::array<WriterHandle, 1> second{second_server[0]};
    EXPECT_EQ(ownership_.retain(second, at(1)), Ownership::Change::none);
    EXPECT_EQ(ownership_.describe(claim_of(first_server), at(2)), Standing::stranger) << "it is another one";
    EXPECT_EQ(sends(second_server, 2.0), Standing::owner);
    EXPECT_EQ(sends(first_server, 2.1), Standing::stranger);
}

TEST(Ownership, AnOwnerThatIsGoneLeavesNothingToItsSuccessor) {
    using Change = Ownership::Change;
    Ownership ownership;
    const Ownership::Time now{};
    const std::array<WriterHandle, 1> second{second_server[0]};
    EXPECT_EQ(ownership.describe(claim_of(first_server), now), Standing::owner);
    EXPECT_EQ(ownership.retain({}, now), Change::lost);
    EXPECT_EQ(ownership.retain(second, now), Change::none);
    EXPECT_EQ(ownership.describe(claim_of(second_server), now), Standing::successor);
    EXPECT_FALSE(ownership.knows(first_server));
    EXPECT_EQ(ownership.dispose(second[0], true, now), Change::ended);
}

TEST_F(OwnershipTest, NobodyWasSilentWhileNobodyListened) {
    ownership_.resume(at(5.0));
    EXPECT_EQ(sends(second_server, 5.1), Standing::stranger);
    EXPECT_EQ(sends(first_server, 5.1), Standing::owner);
    EXPECT_EQ(sends(second_server, 5.6), Standing::stranger);
}

TEST_F(OwnershipTest, KeepsNoMoreThanMaxClaims) {
    for (unsigned char i = 3; i < 100; ++i)
        EXPECT_EQ(ownership_.describe(claim_of({i}), at(0)), Standing::stranger);
    EXPECT_EQ(sends({Ownership::max_claims}, 9.0), Standing::successor);
    EXPECT_EQ(sends({Ownership::max_claims + 1}, 18.0), Standing::stranger);
}

TEST_F(OwnershipTest, AnUncertainDisposalCountsOnlyWhereNobodyElseMayHaveMadeIt) {
    EXPECT_EQ(ownership_.dispose(1, false, at(1)), Ownership::Change::none);
    EXPECT_EQ(ownership_.dispose(1, true, at(1)), Ownership::Change::succeeded);
    EXPECT_EQ(ownership_.dispose(2, false, at(2)), Ownership::Change::none) << "contested since";
    EXPECT_EQ(ownership_.retain({}, at(3)), Ownership::Change::ended);
}

class OwnerTest : public GatewayTest {
  protected:
    // Another participant describes "cup", which has a game server.
    RawPeer& claimant(std::uint64_t epoch) {
        const std::uint64_t before = dropped(Topic::match_info, ValidationError::not_owner);
        RawPeer& raw = peer("cup");
        raw.write(test::raw_match_info("cup", epoch));
        EXPECT_TRUE(
            eventually([&] { return dropped(Topic::match_info, ValidationError::not_owner) > before; }));
        return raw;
    }
    bool has_info(std::uint64_t epoch, std::ptrdiff_t times = 1) {
        return eventually([&] { return recorder_.count("info cup " + std::to_string(epoch)) == times; });
    }
    bool ignores(RawPeer& raw, RawPoseFrame frame) {
        const std::uint64_t before = dropped(Topic::pose_frame, ValidationError::not_owner);
        return eventually([&] {
            raw.write(frame.sample());
            return dropped(Topic::pose_frame, ValidationError::not_owner) > before;
        });
    }
    bool accepts(RawPeer& raw, std::uint64_t epoch, std::uint32_t frame_number) {
        RawPoseFrame frame("cup", epoch, frame_number, 1);
        return arrives(raw, frame, "pose cup " + std::to_string(frame_number));
    }
    void leaves(RawPeer& raw) {
        std::erase_if(peers_, [&](const auto& known) { return known.get() == &raw; });
    }
};

TEST_F(OwnerTest, AStrangerCannotTakeAMatchFromAGameServerThatSends) {
    RawPeer& owner = game("cup");
    ASSERT_TRUE(accepts(owner, 1, 5));
    RawPeer& stranger = claimant(far_epoch);
    EXPECT_TRUE(ignores(stranger, RawPoseFrame("cup", 1, 900, 1)));
    camera_director_MatchEvent event{};
    std::snprintf(event.match_id, sizeof event.match_id, "cup");
    event.kind = 3;
    EXPECT_TRUE(eventually([&] {
        stranger.write(event);
        return dropped(Topic::match_event, ValidationError::not_owner) > 0;
    }));
    stranger.dispose(test::raw_match_info("cup", far_epoch));
    EXPECT_TRUE(accepts(owner, 1, 6));
    leaves(stranger);
    EXPECT_TRUE(accepts(owner, 1, 7));
    owner.write(test::raw_match_info("cup", 2));
    EXPECT_TRUE(has_info(2));
    EXPECT_FALSE(recorder_.has("over cup") || recorder_.has("silent cup") || recorder_.has("pose cup 900") ||
                 recorder_.has("event cup 3 "));
}

TEST_F(OwnerTest, AStrangersPosesDoNotReplaceThoseThatWaitToBeRead) {
    RawPeer& owner = game("cup");
    RawPeer& stranger = peer("cup");
    ASSERT_TRUE(eventually([&] { return stranger.directors() == 1; }));
    recorder_.hangs = true;
    owner.write(test::raw_match_info("cup", 2));
    const bool hangs = eventually([&] { return recorder_.has("info cup 2"); });
    owner.write(RawPoseFrame("cup", 2, 10, 1).sample());
    stranger.write(RawPoseFrame("cup", 2, 20, 1).sample());
    recorder_.hangs = false;
    ASSERT_TRUE(hangs);
    EXPECT_TRUE(eventually([&] { return dropped(Topic::pose_frame, ValidationError::not_owner) == 1; }));
    EXPECT_TRUE(eventually([&] { return recorder_.has("pose cup 10"); }));
}

TEST_F(OwnerTest, AStrangerWhoDescribesNothingIsNotHeard) {
    RawPeer& owner = game("cup");
    recorder_.silence = std::chrono::nanoseconds(0);
    RawPeer& stranger = peer("cup");
    EXPECT_TRUE(ignores(stranger, RawPoseFrame("cup", 1, 900, 1)));
    EXPECT_TRUE(accepts(owner, 1, 5));
}

TEST_F(OwnerTest, AGameServerThatSendsInPlaceOfASilentOneBeginsAnewWhateverItsEpoch) {
    RawPeer& first = game("cup", 9);
    ASSERT_TRUE(accepts(first, 9, 500));
    RawPeer& second = claimant(4);
    EXPECT_TRUE(ignores(second, RawPoseFrame("cup", 4, 1, 1)));
    recorder_.silence = std::chrono::milliseconds(1);
    EXPECT_TRUE(accepts(second, 4, 2));
    EXPECT_TRUE(recorder_.has("over cup") && recorder_.has("info cup 4"));

    // The first one was only silent.
    EXPECT_TRUE(accepts(first, 9, 501));
    EXPECT_TRUE(has_info(9, 2));
    EXPECT_TRUE(ignores(second, RawPoseFrame("cup", 4, 3, 1)));
    leaves(first);
    EXPECT_TRUE(has_info(4, 2));
    EXPECT_TRUE(accepts(second, 4, 4));
}

TEST_F(OwnerTest, WhoWaitsIsTakenWhenTheGameServerEndsTheMatch) {
    RawPeer& first = game("cup", 9);
    RawPeer& second = claimant(4);
    first.dispose(test::raw_match_info("cup", 9));
    EXPECT_TRUE(has_info(4));
    EXPECT_TRUE(accepts(second, 4, 1));
    leaves(first);
    second.dispose(test::raw_match_info("cup", 4));
    leaves(second);
    EXPECT_TRUE(eventually([&] { return recorder_.count("over cup") == 2; }));
}

TEST_F(OwnerTest, WhoWaitsIsTakenWhenTheGameServerLeaves) {
    RawPeer& first = game("cup", 9);
    RawPeer& second = claimant(4);
    leaves(first);
    EXPECT_TRUE(has_info(4));
    EXPECT_TRUE(accepts(second, 4, 1));
}

TEST_F(OwnerTest, AGameServerThatLeavesAloneIsSilentAndTheNextOneIsTakenAtOnce) {
    leaves(game("cup", 9));
    EXPECT_TRUE(eventually([&] { return recorder_.has("silent cup"); }));
    RawPeer& second = peer("cup");
    second.write(test::raw_match_info("cup", 4));
    EXPECT_TRUE(has_info(4));
    EXPECT_TRUE(accepts(second, 4, 1));
}

class RequestOwnerTest : public OwnerTest {
  protected:
    bool ignores(RawPeer& raw, std::uint32_t target) {
        const std::uint64_t before = dropped(Topic::observer_request, ValidationError::not_owner);
        raw.write(test::raw_request("cup", "anna", target));
        return eventually(
            [&] { return dropped(Topic::observer_request, ValidationError::not_owner) > before; });
    }
    bool accepts(RawPeer& raw, std::uint32_t target) {
        raw.write(test::raw_request("cup", "anna", target));
        return has_request(target);
    }
    bool has_request(std::uint32_t target) {
        return eventually([&] { return recorder_.has("request anna " + std::to_string(target)); });
    }
    bool is_gone() {
        return eventually([&] { return recorder_.has("gone anna"); });
    }
};

TEST_F(RequestOwnerTest, AStrangerCannotChangeOrEndAnObserversRequest) {
    game("cup");
    RawPeer& anna = peer("cup");
    RawPeer& stranger = peer("cup");
    ASSERT_TRUE(accepts(anna, 3));
    EXPECT_TRUE(ignores(stranger, 7));
    stranger.dispose(test::raw_request("cup", "anna", 7));
    EXPECT_TRUE(accepts(anna, 4));
    EXPECT_TRUE(ignores(stranger, 8));
    leaves(stranger);
    EXPECT_TRUE(accepts(anna, 5));
    EXPECT_FALSE(recorder_.has("gone anna") || recorder_.has("request anna 7") ||
                 recorder_.has("request anna 8"));
    leaves(anna);
    EXPECT_TRUE(is_gone());
}

TEST_F(RequestOwnerTest, ARequestEndsWithItsWriterThoughAStrangerHasDisposedIt) {
    game("cup");
    RawPeer& anna = peer("cup");
    RawPeer& stranger = peer("cup");
    ASSERT_TRUE(accepts(anna, 3));
    stranger.dispose(test::raw_request("cup", "anna", 7));
    stranger.write(test::raw_request("cup", "berta", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("request berta 1"); }));
    leaves(anna);
    EXPECT_TRUE(is_gone());
}

TEST_F(RequestOwnerTest, WhoAsksForATakenObserverIsHeardWhenItsOwnerIsGone) {
    game("cup");
    RawPeer& first = peer("cup");
    RawPeer& second = peer("cup");
    RawPeer& third = peer("cup");
    ASSERT_TRUE(accepts(first, 3));
    EXPECT_TRUE(ignores(second, 7));
    leaves(first);
    EXPECT_TRUE(has_request(7));
    EXPECT_TRUE(ignores(third, 8));
    second.dispose(test::raw_request("cup", "anna", 7));
    EXPECT_TRUE(has_request(8));
    EXPECT_FALSE(recorder_.has("gone anna"));
}

class LimitsTest : public GatewayTest {
  protected:
    LimitsTest() {
        limits_.matches = 8;  // two of a participant may wait
        limits_.participant_matches = 2;
        limits_.participant_observers = 3;
    }
};

TEST_F(LimitsTest, AParticipantHasSoManyObserversAndNoMore) {
    game("cup");
    RawPeer& greedy = peer("cup");
    for (int i = 0; i < 100; ++i)
        greedy.write(test::raw_request("cup", "greedy " + std::to_string(i), 1));
    const auto refused = [&] { return dropped(Topic::observer_request, ValidationError::participant_limit); };
    EXPECT_TRUE(eventually([&] { return refused() == 97; })) << refused();
    peer("cup").write(test::raw_request("cup", "anna", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("request anna 1"); }));

    greedy.dispose(test::raw_request("cup", "greedy 0", 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("gone greedy 0"); }));
    greedy.write(test::raw_request("cup", "greedy 100", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("request greedy 100 1"); }));
    greedy.write(test::raw_request("cup", "greedy 101", 1));
    EXPECT_TRUE(eventually([&] { return refused() == 98; }));
}

TEST_F(LimitsTest, AParticipantHasSoManyMatchesAndNoMore) {
    RawPeer& greedy = peer("a", {"match/a", "match/b", "match/c"});
    for (const char* match_id : {"a", "b", "c"})
        greedy.write(test::raw_match_info(match_id, 1));
    EXPECT_TRUE(
        eventually([&] { return dropped(Topic::match_info, ValidationError::participant_limit) > 0; }));
    EXPECT_EQ(gateway_->counters().matches, 2U);
    game("cup");
    EXPECT_FALSE(recorder_.has("info c 1"));
    greedy.dispose(test::raw_match_info("a", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("info c 1"); })) << "it has waited";
}

TEST_F(LimitsTest, AMatchThatWaitsKeepsItsPlaceWhenItIsDescribedAgain) {
    RawPeer& greedy = peer("a", {"match/a", "match/b", "match/c", "match/d"});
    const auto refused = [&] { return dropped(Topic::match_info, ValidationError::participant_limit); };
    for (const char* match_id : {"a", "b", "c", "d"})
        greedy.write(test::raw_match_info(match_id, 1));
    ASSERT_TRUE(eventually([&] { return refused() == 2; }));
    greedy.write(test::raw_match_info("c", 2));
    ASSERT_TRUE(eventually([&] { return refused() == 3; }));
    greedy.dispose(test::raw_match_info("a", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("info c 2"); }));
    EXPECT_FALSE(recorder_.has("info d 1"));
}

TEST_F(LimitsTest, CountsTheMatchesThatMayNotWait) {
    RawPeer& greedy = peer("a", {"match/a", "match/b", "match/c", "match/d", "match/e"});
    for (const char* match_id : {"a", "b", "c", "d", "e"})
        greedy.write(test::raw_match_info(match_id, 1));
    EXPECT_TRUE(eventually([&] { return dropped(Topic::match_info, ValidationError::waiting_limit) == 1; }));
    EXPECT_EQ(dropped(Topic::match_info, ValidationError::participant_limit), 3U);
}

class SharesTest : public GatewayTest {
  protected:
    SharesTest() {
        limits_.matches = 4;
        limits_.observers = 6;
    }
};

TEST_F(SharesTest, AParticipantLeavesHalfOfThePlacesToOthers) {
    RawPeer& greedy = peer("a", {"match/a", "match/b", "match/c", "match/d"});
    for (const char* match_id : {"a", "b", "c", "d"})
        greedy.write(test::raw_match_info(match_id, 1));
    EXPECT_TRUE(
        eventually([&] { return dropped(Topic::match_info, ValidationError::participant_limit) == 2; }));
    EXPECT_EQ(gateway_->counters().matches, 2U);

    game("cup");
    RawPeer& asking = peer("cup");
    for (int i = 0; i < 6; ++i)
        asking.write(test::raw_request("cup", "greedy " + std::to_string(i), 1));
    EXPECT_TRUE(eventually(
        [&] { return dropped(Topic::observer_request, ValidationError::participant_limit) == 3; }));
    peer("cup").write(test::raw_request("cup", "anna", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("request anna 1"); }));
}

class OnePlaceTest : public GatewayTest {
  protected:
    OnePlaceTest() { limits_.matches = limits_.observers = 1; }
};

TEST_F(OnePlaceTest, IsAParticipants) {
    game("cup");
    peer("cup").write(test::raw_request("cup", "anna", 1));
    EXPECT_TRUE(eventually([&] { return recorder_.has("request anna 1"); }));
}

class RateTest : public LimitsTest {
  protected:
    RateTest() { limits_.participant_match_rate = 0.1; }  // the first two matches take less than 10 s
};

TEST_F(RateTest, AParticipantThatBeginsMatchesTooFastWaits) {
    RawPeer& restless = peer("a", {"match/a", "match/b", "match/c"});
    for (const std::string match_id : {"a", "b"}) {
        restless.write(test::raw_match_info(match_id, 1));
        ASSERT_TRUE(eventually([&] { return recorder_.has("info " + match_id + " 1"); }));
        restless.dispose(test::raw_match_info(match_id, 1));
        ASSERT_TRUE(eventually([&] { return recorder_.has("over " + match_id); }));
    }
    restless.write(test::raw_match_info("c", 1));
    EXPECT_TRUE(
        eventually([&] { return dropped(Topic::match_info, ValidationError::participant_rate) == 1; }));
    game("cup");
    EXPECT_TRUE(eventually([&] { return recorder_.has("info c 1"); })) << "it has waited";
}

class ReshardTest : public GatewayTest {
  protected:
    ReshardTest() {
        limits_.matches = limits_.participant_matches = 8;  // two of a participant may wait
        config_.shards = {"a", "b"};
        config_.shard = "b";
    }
};

TEST_F(ReshardTest, EveryMatchOfAParticipantMovesToTheShardThatIsLeft) {
    const Shards a("a", config_.shards);
    std::vector<std::string> moving, partitions;
    std::string staying;
    for (int i = 0; moving.size() < 6 || staying.empty(); ++i) {
        const std::string match_id = "match " + std::to_string(i);
        if (!a.serves(match_id))
            staying = match_id;
        else if (moving.size() < 6)
            moving.push_back(match_id);
    }
    for (const std::string& match_id : moving)
        partitions.push_back(match_partition(match_id));
    partitions.push_back(match_partition(staying));
    RawPeer& host = peer(staying, partitions);
    for (const std::string& match_id : moving)
        host.write(test::raw_match_info(match_id, 1));
    host.write(test::raw_match_info(staying, 1));
    ASSERT_TRUE(eventually([&] { return recorder_.has("info " + staying + " 1"); }));
    EXPECT_EQ(gateway_->counters().matches, 1U);

    config_.shards = {"b"};
    gateway_->reshard(config_);
    for (const std::string& match_id : moving)
        ASSERT_TRUE(eventually([&] { return recorder_.has("info " + match_id + " 1"); })) << match_id;
    EXPECT_EQ(dropped(Topic::match_info, ValidationError::waiting_limit), 0U);
}

TEST(WaitingMatches, KeepsTheNewestDescriptionOfEachWithinItsBoundsUntilItIsGone) {
    WaitingMatches waiting(4, 2);
    const auto claim = [](unsigned char sender, const std::string& match_id, std::uint64_t epoch = 1) {
        Ownership::Claim made = claim_of({sender});
        made.info.match_id = match_id;
        made.info.epoch = epoch;
        return made;
    };
    EXPECT_TRUE(waiting.keep(claim(1, "a")));
    EXPECT_TRUE(waiting.keep(claim(1, "b")));
    EXPECT_FALSE(waiting.keep(claim(1, "c"))) << "of one participant";
    EXPECT_TRUE(waiting.keep(claim(1, "a", 2)));
    EXPECT_TRUE(waiting.keep(claim(2, "a")));
    EXPECT_TRUE(waiting.keep(claim(3, "d")));
    EXPECT_FALSE(waiting.keep(claim(4, "e"))) << "of all";
    waiting.remove("a", 2);
    waiting.remove("b", 3);
    const std::array<WriterHandle, 1> matched{1};
    const auto of = [&](unsigned char sender) {
        return waiting.take([&](const Ownership::Claim& kept) { return kept.sender == SenderId{sender}; });
    };
    EXPECT_FALSE(of(4));
    EXPECT_EQ(of(3)->info.match_id, "d");
    waiting.retain(matched);
    EXPECT_EQ(of(1)->info.epoch, 2U);
    EXPECT_EQ(of(1)->info.match_id, "b");
    EXPECT_FALSE(waiting.take([](const Ownership::Claim&) { return true; }));
}

}  // namespace
}  // namespace camdir::dds
