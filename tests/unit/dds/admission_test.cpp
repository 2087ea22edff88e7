#include "dds/admission.hpp"

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <utility>
#include <vector>

namespace camdir::dds {
namespace {

using namespace std::chrono_literals;
using Refused = std::vector<std::pair<std::string, ValidationError>>;

// Matches that begin are served until the test takes them away.
class AdmissionTest : public testing::Test, protected Admission::Host {
  protected:
    static Admission::Claim described(const SenderId& sender, const std::string& match_id,
                                      std::uint64_t epoch = 1) {
        Admission::Claim claim{.sender = sender, .writer = sender[0], .info = {}};
        claim.info.match_id = match_id;
        claim.info.epoch = epoch;
        return claim;
    }
    [[nodiscard]] std::size_t owned_by(const SenderId& participant) const override {
        std::size_t owned = 0;
        for (const auto& [match_id, owner] : served_)
            owned += owner == participant ? 1 : 0;
        return owned;
    }
    [[nodiscard]] bool has_room_for(const std::string& match_id) const override {
        return served_.size() < places_ && !ending_.contains(match_id);
    }
    [[nodiscard]] bool admits(const std::string& match_id) override { return has_room_for(match_id); }
    void refuse(const std::string& match_id, ValidationError limit) override {
        refused_.emplace_back(match_id, limit);
    }

    bool begins(const Admission::Claim& claim) {
        if (!admission_.begins(claim, now_)) return false;
        served_.emplace(claim.info.match_id, claim.sender);
        return true;
    }
    // The match that waited and begins next, with its epoch.
    std::string next() {
        const auto claim = admission_.next(now_);
        if (!claim || !begins(*claim)) return "none";
        return claim->info.match_id + " " + std::to_string(claim->info.epoch);
    }
    // A match of this shard, "a", or the other.
    std::string match_of(const std::string& shard) {
        const Shards shards(shard, {"a", "b"});
        std::string match_id;
        do
            match_id = "match " + std::to_string(++last_match_);
        while (!shards.serves(match_id));
        return match_id;
    }

    const SenderId host_{1}, other_{2};
    std::size_t places_ = 8;
    std::map<std::string, SenderId> served_;
    std::set<std::string> ending_;
    Refused refused_;
    Admission::Time now_{1h};
    int last_match_ = 0;
    Admission admission_{*this, {}, {.matches = 8, .participant_matches = 3, .participant_match_rate = 1.0}};
};

TEST_F(AdmissionTest, WhatIsBeyondAParticipantsMatchesWaitsForTheEndOfOneAndOthersDoNot) {
    for (const char* match_id : {"a", "b", "c"})
        EXPECT_TRUE(begins(described(host_, match_id)));
    EXPECT_FALSE(begins(described(host_, "d")));
    EXPECT_EQ(refused_, (Refused{{"d", ValidationError::participant_limit}}));
    EXPECT_TRUE(begins(described(other_, "e")));
    now_ += 1s;
    EXPECT_EQ(next(), "none");
    served_.erase("a");
    EXPECT_EQ(next(), "d 1");
    EXPECT_EQ(next(), "none");
}

TEST_F(AdmissionTest, WhoBeginsTooManyWaitsForItsTime) {
    for (const char* match_id : {"a", "b", "c"}) {
        EXPECT_TRUE(begins(described(host_, match_id)));
        served_.clear();
    }
    EXPECT_FALSE(begins(described(host_, "d")));
    EXPECT_EQ(refused_, (Refused{{"d", ValidationError::participant_rate}}));
    EXPECT_EQ(next(), "none");
    now_ += 1s;
    EXPECT_EQ(next(), "d 1");
}

TEST_F(AdmissionTest, WhatTheHostRefusesWaitsAndCostsNoTime) {
    places_ = 0;
    for (int i = 0; i < 10; ++i)
        EXPECT_FALSE(begins(described(host_, "a")));
    EXPECT_TRUE(refused_.empty()) << "the host counts it";
    EXPECT_EQ(next(), "none");
    places_ = 8;
    ending_ = {"a"};
    EXPECT_EQ(next(), "none");
    ending_.clear();
    EXPECT_EQ(next(), "a 1");
}

TEST_F(AdmissionTest, WhatBeginsWaitsNoLonger) {
    places_ = 0;
    EXPECT_FALSE(begins(described(host_, "a")));
    places_ = 8;
    EXPECT_TRUE(begins(described(host_, "a", 2)));
    served_.clear();
    EXPECT_EQ(next(), "none");
}

TEST_F(AdmissionTest, OnlyAFewOfAParticipantWait) {
    places_ = 0;
    for (const char* match_id : {"a", "b", "c"})
        EXPECT_FALSE(begins(described(host_, match_id)));
    EXPECT_EQ(refused_, (Refused{{"c", ValidationError::waiting_limit}})) << "a quarter of all";
}

TEST_F(AdmissionTest, TheNewestDescriptionWaitsUntilItIsWithdrawnOrItsWriterIsGone) {
    places_ = 0;
    for (const std::uint64_t epoch : {1, 2})
        EXPECT_FALSE(begins(described(host_, "a", epoch)));
    EXPECT_FALSE(begins(described(host_, "b")));
    EXPECT_FALSE(begins(described(other_, "c")));
    admission_.withdraw("b", host_[0]);
    const std::array<WriterHandle, 1> matched{host_[0]};
    admission_.retain(matched);
    places_ = 8;
    EXPECT_EQ(next(), "a 2");
    EXPECT_EQ(next(), "none");
}

class ShardedAdmissionTest : public AdmissionTest {
  protected:
    ShardedAdmissionTest() { admission_.reshard({"a", {"a", "b"}}); }
};

TEST_F(ShardedAdmissionTest, MatchesOfAnotherShardWaitUntilTheyAreThisOnes) {
    const std::string own = match_of("a"), others = match_of("b");
    EXPECT_TRUE(begins(described(host_, own)));
    EXPECT_FALSE(begins(described(host_, others)));
    EXPECT_EQ(next(), "none");
    admission_.reshard({"a", {"a"}});
    EXPECT_EQ(next(), others + " 1");
    EXPECT_TRUE(refused_.empty());
}

TEST_F(ShardedAdmissionTest, MatchesThatWaitForRoomWaitElsewhereOnceTheyAreAnotherShards) {
    admission_.reshard({"a", {"a"}});
    places_ = 0;
    const std::string others = match_of("b"), own = match_of("a");
    for (const std::string& match_id : {others, match_of("b"), own})
        EXPECT_EQ(begins(described(match_id == own ? other_ : host_, match_id)), false);
    admission_.reshard({"a", {"a", "b"}});
    for (const std::string& match_id : {match_of("a"), match_of("a")})
        EXPECT_FALSE(begins(described(host_, match_id)));
    EXPECT_TRUE(refused_.empty()) << "they have taken the places of the others";
    places_ = 1;
    EXPECT_EQ(next(), own + " 1");
    places_ = 8;
    admission_.reshard({"a", {"a"}});
    EXPECT_EQ(next(), others + " 1");
}

TEST_F(ShardedAdmissionTest, AMatchThatIsLeftToAnotherShardMayComeBackBeforeThoseThatHaveNotBegun) {
    const std::string left = match_of("b"), late = match_of("a");
    admission_.leave(described(host_, left));
    places_ = 0;
    EXPECT_FALSE(begins(described(other_, late)));
    places_ = 8;
    admission_.reshard({"a", {"a"}});
    EXPECT_EQ(next(), left + " 1");
    EXPECT_EQ(next(), late + " 1");
}

TEST_F(ShardedAdmissionTest, MovingMatchesKeepTheirPlacesWhenTheyAreDescribedAgain) {
    const std::string moving = match_of("b");
    EXPECT_FALSE(begins(described(host_, moving)));
    places_ = 0;
    admission_.reshard({"a", {"a"}});
    for (const char* match_id : {"x", "y"})
        EXPECT_FALSE(begins(described(host_, match_id)));
    EXPECT_FALSE(begins(described(host_, moving, 2)));
    EXPECT_TRUE(refused_.empty()) << "two may wait beside it";
    places_ = 8;
    EXPECT_EQ(next(), moving + " 2");
}

}  // namespace
}  // namespace camdir::dds
