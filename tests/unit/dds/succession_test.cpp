#include "dds/succession.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <tuple>
#include <vector>

namespace camdir::dds {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds lease{200};
constexpr milliseconds beat{50};

// Directors of one match whose signs reach the others at once, on a clock of their own.
class Directors : public testing::Test {
  protected:
    struct Member {
        Succession succession;
        bool runs = true;
        bool has_cameras = false;
        bool hears = true, hears_game = true, is_heard = true;  // over the network
    };

    std::size_t add(std::uint32_t rank) {
        members_.push_back({Succession(members_.size() + 1, rank, lease, now_)});
        return members_.size() - 1;
    }
    void pass(milliseconds time) {
        for (const auto end = now_ + time; now_ < end;) {
            now_ += beat;
            for (Member& member : members_) {
                if (!member.runs) continue;
                const bool has_poses = plays_ && member.hears_game;
                if (has_poses) std::ignore = member.succession.hear(now_);
                if (member.has_cameras || has_poses) member.succession.produce(now_);
                member.succession.live(now_);
            }
            if (connected_) tell();
        }
    }
    void tell() {
        for (const Member& from : members_)
            for (Member& to : members_)
                if (from.runs && to.runs && from.is_heard && to.hears)
                    to.succession.see(from.succession.own(), now_);
    }
    [[nodiscard]] bool leads(std::size_t member) const { return members_[member].succession.own().leads; }
    [[nodiscard]] std::size_t leaders() const {
        return static_cast<std::size_t>(std::ranges::count_if(
            members_, [](const Member& member) { return member.runs && member.succession.own().leads; }));
    }
    Succession& leader() {
        return std::ranges::find_if(members_,
                                    [](const Member& member) { return member.succession.own().leads; })
            ->succession;
    }
    Succession& of(std::size_t member) { return members_[member].succession; }

    // From and to the network.
    void cut_off(std::size_t member, bool cut) {
        members_[member].hears = members_[member].hears_game = members_[member].is_heard = !cut;
    }

    bool connected_ = true;
    bool plays_ = false;  // the game server, whose poses all can hear
    Succession::Time now_{};
    std::vector<Member> members_;
};

TEST_F(Directors, OneAloneLeadsAfterLookingForOthers) {
    const auto only = add(100);
    pass(milliseconds(200));
    EXPECT_EQ(of(only).next_change(now_), now_ + milliseconds(50));
    EXPECT_FALSE(leads(only));
    pass(milliseconds(50));
    EXPECT_TRUE(leads(only));
}

TEST_F(Directors, TheStrongestOfThoseThatBeginTogetherLeads) {
    const auto weak = add(100);
    const auto strong = add(200);
    pass(milliseconds(1000));
    EXPECT_TRUE(leads(strong));
    EXPECT_FALSE(leads(weak));
    EXPECT_GT(of(weak).own().term, of(strong).own().term) << "what it writes must count when it takes over";
}

TEST_F(Directors, OneWithCamerasLeadsBeforeAStrongerOneWithout) {
    const auto weak = add(100);
    const auto strong = add(200);
    members_[weak].has_cameras = true;
    pass(milliseconds(1000));
    EXPECT_TRUE(leads(weak));
    EXPECT_FALSE(leads(strong));
}

TEST_F(Directors, WhoeverServesServesOn) {
    const auto first = add(100);
    pass(milliseconds(1000));
    const auto stronger = add(200);
    pass(milliseconds(5000));
    EXPECT_TRUE(leads(first));
    EXPECT_FALSE(leads(stronger));
}

TEST_F(Directors, AStandbyTakesOverWhenTheLeaderIsSilentForALeaseOrLeaves) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[leader].runs = false;
    EXPECT_EQ(of(standby).next_change(now_), now_ + lease + milliseconds(1));
    pass(milliseconds(200));
    EXPECT_FALSE(leads(standby));
    now_ += milliseconds(1);
    of(standby).decide(now_);
    EXPECT_TRUE(leads(standby));

    const auto next = add(100);
    pass(milliseconds(1000));
    members_[standby].runs = false;
    of(next).leave(of(standby).own().director_id, now_);
    EXPECT_TRUE(leads(next));
}

TEST_F(Directors, ALeaderIsSilentForAsLongAsItSays) {
    const auto standby = add(100);
    const Sign patient{.director_id = 9, .term = 4, .lease = milliseconds(1000), .leads = true};
    of(standby).see(patient, now_);
    pass(milliseconds(1000));
    EXPECT_FALSE(leads(standby));
    pass(milliseconds(50));
    EXPECT_TRUE(leads(standby));
}

TEST_F(Directors, ALeaderResignsWhereAnotherLives) {
    const auto leader = add(200);
    pass(milliseconds(1000));
    of(leader).resign(now_);
    EXPECT_TRUE(leads(leader)) << "it is alone";
    const auto standby = add(100);
    pass(milliseconds(1000));
    of(leader).resign(now_);
    EXPECT_FALSE(leads(leader));
    members_[leader].runs = false;
    of(standby).leave(of(leader).own().director_id, now_);
    EXPECT_TRUE(leads(standby));
    of(leader).live(now_);
    EXPECT_FALSE(leads(leader)) << "although it has not heard yet that another leads";
    members_[leader].runs = true;
    pass(milliseconds(1000));
    EXPECT_TRUE(leads(standby));
    EXPECT_EQ(leaders(), 1U);
}

TEST_F(Directors, ALeaderHandsOverToOneThatServesAsWell) {
    const auto leader = add(200);
    members_[leader].has_cameras = true;
    pass(milliseconds(1000));
    EXPECT_FALSE(of(leader).has_successor(now_)) << "it is alone";
    const auto standby = add(100);
    pass(milliseconds(1000));
    EXPECT_FALSE(of(leader).has_successor(now_)) << "the other has no cameras";
    members_[standby].has_cameras = true;
    pass(milliseconds(1000));
    ASSERT_TRUE(of(leader).has_successor(now_));
    of(leader).resign(now_);
    of(standby).leave(of(leader).own().director_id, now_);
    EXPECT_TRUE(leads(standby));
    pass(milliseconds(5000));
    EXPECT_TRUE(leads(standby));
    EXPECT_EQ(leaders(), 1U);
}

TEST_F(Directors, ALeaderThatWasAbsentStandsByBeforeItWritesAnything) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[leader].runs = false;
    pass(milliseconds(6000));
    ASSERT_TRUE(leads(standby));
    of(leader).notice_absence(now_);
    EXPECT_FALSE(leads(leader));
    members_[leader].runs = true;
    pass(milliseconds(6000));
    EXPECT_TRUE(leads(standby));
    EXPECT_FALSE(leads(leader));
    EXPECT_GT(of(leader).own().term, of(standby).own().term);
    members_[standby].runs = false;
    pass(milliseconds(300));
    EXPECT_TRUE(leads(leader)) << "as the standby that it is now";
}

// Its workers go on, and find out that it was absent before the standby, which heard its last sign later,
// takes it for dead.
TEST_F(Directors, AStandbyTakesOverAtOnceFromALeaderWhoseReceptionHangs) {
    const auto leader = add(200);
    const auto standby = add(100);
    members_[leader].has_cameras = members_[standby].has_cameras = true;
    pass(milliseconds(3000));
    ASSERT_TRUE(leads(leader));
    members_[leader].runs = false;
    now_ += milliseconds(20);
    of(standby).see(of(leader).own(), now_);
    pass(milliseconds(150));
    now_ += milliseconds(31);
    of(leader).produce(now_);
    of(leader).notice_absence(now_);
    ASSERT_FALSE(leads(leader));
    ASSERT_FALSE(leads(standby));
    of(standby).see(of(leader).own(), now_);
    EXPECT_TRUE(leads(standby));
}

TEST_F(Directors, ALeaderThatWasAwayForLongWaitsUntilItHasMetTheOthersAgain) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[leader].runs = false;
    pass(milliseconds(15'000));
    ASSERT_TRUE(leads(standby));
    of(leader).see(of(standby).own(), now_);  // what it still had in its buffers
    members_[leader].runs = true;
    connected_ = false;
    pass(milliseconds(2000));
    EXPECT_FALSE(leads(leader));
    connected_ = true;
    pass(milliseconds(5000));
    EXPECT_TRUE(leads(standby));
    EXPECT_FALSE(leads(leader));
}

TEST_F(Directors, OnlyTheOthersThatLivedKeepALeaderFromServingOnAfterAnAbsence) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[standby].runs = false;
    pass(Succession::apart + milliseconds(100));
    now_ += milliseconds(300);
    of(leader).notice_absence(now_);
    EXPECT_TRUE(leads(leader));
}

// Whenever it stops listening between two signs of the leader, and for however long.
TEST_F(Directors, AStandbyDoesNotTakeALeaderForDeadThatItDidNotListenTo) {
    const Sign leads{.director_id = 9, .term = 4, .lease = lease, .leads = true, .has_cameras = true};
    for (milliseconds offset{0}; offset < beat; ++offset)
        for (milliseconds stall{1}; stall < 3 * lease; ++stall) {
            Succession standby(1, 100, lease, now_);
            for (int i = 0; i < 20; ++i) {
                now_ += beat;
                standby.see(leads, now_);
                standby.live(now_ + offset);
            }
            standby.produce(now_ + offset);
            standby.decide(now_ + offset + stall);
            ASSERT_FALSE(standby.own().leads) << offset.count() << " ms after a sign, for " << stall.count();
        }
}

TEST_F(Directors, AStandbyThatStallsAgainAndAgainTakesOverWhenItHasListenedForALease) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[leader].runs = false;
    for (int i = 0; i < 4; ++i) {
        ASSERT_FALSE(leads(standby));
        now_ += milliseconds(140);
        of(standby).live(now_);
        now_ += milliseconds(60);
        of(standby).live(now_);
    }
    EXPECT_TRUE(leads(standby));
}

TEST_F(Directors, OneThatIsNotAllowedToLeadYetKeepsNobodyFromIt) {
    const auto leader = add(200);
    const auto second = add(150);
    const auto third = add(100);
    for (Member& member : members_)
        member.has_cameras = true;
    pass(milliseconds(1000));
    members_[second].runs = false;
    pass(milliseconds(6000));
    members_[second].runs = true;
    pass(milliseconds(100));
    members_[leader].runs = false;
    pass(milliseconds(300));
    EXPECT_TRUE(leads(third));
}

TEST_F(Directors, AStrongerOneThatDidNotFindALeaderAtFirstStandsByWhenItDoes) {
    const auto leader = add(100);
    pass(milliseconds(2000));
    connected_ = false;
    const auto stronger = add(200);
    pass(milliseconds(500));
    ASSERT_TRUE(leads(stronger));
    connected_ = true;
    pass(milliseconds(500));
    EXPECT_TRUE(leads(leader));
    EXPECT_FALSE(leads(stronger));
}

TEST_F(Directors, NobodyTakesOverWhileItIsAskedWhetherItMayWrite) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[leader].runs = false;
    for (int i = 0; i < 50; ++i) {
        now_ += milliseconds(16);
        of(standby).produce(now_);
        of(standby).notice_absence(now_);
        ASSERT_FALSE(leads(standby));
    }
}

TEST_F(Directors, StrangersBeyondTheLimitCountForNothing) {
    const auto only = add(0);
    for (std::uint64_t id = 100; id < 100 + 2 * Succession::max_others; ++id)
        of(only).see({.director_id = id, .lease = lease, .leads = id == 100 + Succession::max_others}, now_);
    EXPECT_EQ(of(only).own().term, 0U);
    pass(milliseconds(1000));
    EXPECT_TRUE(leads(only)) << "they are dead";
    const auto other = add(100);
    pass(milliseconds(1000));
    EXPECT_GT(of(other).own().term, of(only).own().term) << "they know of each other";
}

TEST_F(Directors, AStandbyThatWasAbsentDoesNotTakeTheOthersForDead) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[standby].runs = false;
    pass(milliseconds(6000));
    of(standby).live(now_);
    EXPECT_FALSE(leads(standby));
    members_[standby].runs = true;
    pass(milliseconds(1000));
    EXPECT_TRUE(leads(leader));
    EXPECT_FALSE(leads(standby));
}

TEST_F(Directors, OneAloneServesOnAfterAnAbsence) {
    const auto only = add(100);
    pass(milliseconds(1000));
    now_ += milliseconds(6000);
    of(only).decide(now_);
    EXPECT_TRUE(leads(only));
}

TEST_F(Directors, ALeaderOfAMuchLongerLeaseIsSilentForNoLongerThanTenOwnOnes) {
    const auto only = add(100);
    pass(milliseconds(2000));
    ASSERT_TRUE(leads(only));
    of(only).see({.director_id = 9, .term = 1000, .lease = max_lease, .leads = true, .has_cameras = true},
                 now_);
    EXPECT_FALSE(leads(only)) << "whatever the term: it may be another's that has gone on";
    pass(Succession::max_other_lease * lease);
    EXPECT_FALSE(leads(only));
    pass(beat);
    EXPECT_TRUE(leads(only));
}

TEST_F(Directors, OfTwoLeadersTheOneOfTheLaterTermServesOn) {
    const auto left = add(100);
    const auto right = add(200);
    connected_ = false;
    pass(milliseconds(1000));
    ASSERT_EQ(leaders(), 2U) << "they do not know of each other";
    connected_ = true;
    pass(milliseconds(1000));
    EXPECT_EQ(leaders(), 1U);
    EXPECT_TRUE(leads(right)) << "of the same term the stronger one";
    members_[right].runs = false;
    pass(milliseconds(500));
    ASSERT_TRUE(leads(left));
    connected_ = false;
    members_[right].runs = true;
    pass(milliseconds(1000));
    ASSERT_EQ(leaders(), 2U) << "they do not hear of each other";
    connected_ = true;
    pass(milliseconds(1000));
    EXPECT_EQ(leaders(), 1U);
}

TEST_F(Directors, ALeaderWithoutCamerasGivesWayToAStandbyThatHasThem) {
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(1000));
    members_[standby].has_cameras = true;
    pass(milliseconds(250));
    members_[leader].has_cameras = true;
    pass(milliseconds(5000));
    EXPECT_TRUE(leads(leader)) << "it had them soon";
    members_[leader].has_cameras = false;
    pass(milliseconds(750));
    EXPECT_TRUE(leads(standby));
    EXPECT_EQ(leaders(), 1U);
}

TEST_F(Directors, OneThatWasCutOffDoesNotTakeTheMatchFromTheOneThatServes) {
    for (const milliseconds absence : {milliseconds(300), milliseconds(6000), milliseconds(15'000)})
        for (const bool strong : {false, true}) {
            SCOPED_TRACE(absence.count());
            members_.clear();
            plays_ = true;
            const auto leader = add(strong ? 100 : 200);
            pass(milliseconds(2000));
            const auto standby = add(strong ? 200 : 100);
            pass(milliseconds(2000));
            ASSERT_TRUE(leads(leader));
            cut_off(standby, true);
            pass(absence);
            EXPECT_FALSE(leads(standby)) << "nobody would see what it shows";
            cut_off(standby, false);
            pass(milliseconds(5000));
            EXPECT_TRUE(leads(leader));
            EXPECT_FALSE(leads(standby));
        }
}

TEST_F(Directors, OneThatHearsTheGameTakesOverFromALeaderThatIsCutOff) {
    plays_ = true;
    const auto leader = add(200);
    pass(milliseconds(1000));
    const auto standby = add(100);
    pass(milliseconds(2000));
    cut_off(leader, true);
    pass(lease + 2 * beat);
    EXPECT_TRUE(leads(standby));
    EXPECT_FALSE(leads(leader));
    cut_off(leader, false);
    pass(milliseconds(5000));
    EXPECT_TRUE(leads(standby));
    EXPECT_EQ(leaders(), 1U);
}

TEST_F(Directors, AStandbyWaitsForTheGameBeforeItTakesALeaderForDead) {
    plays_ = true;
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(2000));
    members_[leader].runs = false;
    pass(lease);
    const auto dead = now_ + milliseconds(1);
    of(standby).decide(dead);
    EXPECT_FALSE(leads(standby));
    EXPECT_TRUE(of(standby).hear(dead + milliseconds(2)));
    of(standby).decide(dead + milliseconds(2));
    EXPECT_TRUE(leads(standby));
}

TEST_F(Directors, ALeaderThatHearsNothingLeavesTheMatchToTheOthers) {
    plays_ = true;
    const auto leader = add(200);
    pass(milliseconds(1000));
    const auto standby = add(100);
    pass(milliseconds(2000));
    members_[leader].hears = members_[leader].hears_game = false;
    EXPECT_LE(of(leader).next_change(now_), now_ + lease + milliseconds(1));
    pass(lease + 2 * beat);
    EXPECT_FALSE(leads(leader));
    EXPECT_TRUE(leads(standby));
}

TEST_F(Directors, ALeaderServesOnWhenOnlyTheGameOrOnlyTheOthersAreSilent) {
    plays_ = true;
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(2000));
    plays_ = false;
    pass(milliseconds(6000));
    EXPECT_TRUE(leads(leader)) << "the game pauses";
    members_[standby].runs = false;
    pass(milliseconds(1000));
    EXPECT_TRUE(leads(leader)) << "the standby dies meanwhile";
    plays_ = true;
    pass(milliseconds(1000));
    members_[standby].runs = true;
    pass(milliseconds(5000));
    ASSERT_TRUE(leads(leader));
    members_[standby].runs = false;
    pass(Succession::together + milliseconds(500));
    EXPECT_TRUE(leads(leader)) << "the standby dies alone";
    plays_ = false;
    pass(milliseconds(6000));
    EXPECT_TRUE(leads(leader)) << "the game pauses later";
}

// The others forget one that only hears them after 10 s, each at its own time.
TEST_F(Directors, OneThatIsNotHeardDoesNotTakeTheMatchWhenItIsHeardAgain) {
    for (const milliseconds offset : {milliseconds(-1000), milliseconds(-300), milliseconds(300)}) {
        SCOPED_TRACE(offset.count());
        members_.clear();
        plays_ = true;
        const auto leader = add(200);
        pass(milliseconds(2000));
        const auto standby = add(100);
        pass(milliseconds(2000));
        members_[leader].is_heard = false;
        pass(milliseconds(10'000));
        ASSERT_TRUE(leads(standby));
        (offset.count() < 0 ? members_[leader].hears_game : members_[leader].hears) = false;
        pass(std::max(offset, -offset));
        members_[leader].hears = members_[leader].hears_game = false;
        pass(milliseconds(5000));
        EXPECT_FALSE(leads(leader));
        members_[leader].hears = members_[leader].hears_game = members_[leader].is_heard = true;
        pass(milliseconds(5000));
        EXPECT_TRUE(leads(standby));
        EXPECT_EQ(leaders(), 1U);
    }
}

TEST_F(Directors, AStandbyTakesOverWhileTheGamePauses) {
    plays_ = true;
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(2000));
    plays_ = false;
    pass(Succession::together + milliseconds(500));
    members_[leader].runs = false;
    pass(milliseconds(300));
    EXPECT_TRUE(leads(standby));
}

TEST_F(Directors, OneLeadsAgainAsSoonAsAllThatWereCutOffHaveMet) {
    plays_ = true;
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(2000));
    for (const auto member : {leader, standby})
        cut_off(member, true);
    pass(milliseconds(6000));
    EXPECT_EQ(leaders(), 0U);
    for (const auto member : {leader, standby})
        cut_off(member, false);
    pass(3 * beat);
    EXPECT_EQ(leaders(), 1U);
}

TEST_F(Directors, OneThatWasCutOffAloneLeadsAgainWhenNobodyElseComesBack) {
    plays_ = true;
    const auto leader = add(200);
    const auto standby = add(100);
    pass(milliseconds(2000));
    cut_off(leader, true);
    members_[standby].runs = false;
    pass(milliseconds(6000));
    EXPECT_FALSE(leads(leader));
    cut_off(leader, false);
    pass(Succession::meeting + milliseconds(100));
    EXPECT_TRUE(leads(leader));
}

TEST_F(Directors, ALeaderServesOnBesideADeadStandbyHoweverSlowlyTheGameSends) {
    const auto leader = add(200);
    const auto standby = add(100);
    const auto play = [&](int frames) {
        bool always = true;
        for (int frame = 0; frame < frames; ++frame) {
            plays_ = true;
            pass(beat);
            always = always && leads(leader);
            plays_ = false;
            pass(milliseconds(250));
            always = always && leads(leader);
        }
        return always;
    };
    pass(milliseconds(1000));
    EXPECT_TRUE(play(10));
    members_[standby].runs = false;
    EXPECT_TRUE(play(40));
}

TEST_F(Directors, ALeaderMayTakeItselfForCutOffOnceForEachOtherThatDies) {
    const auto leader = add(200);
    const auto standby = add(100);
    plays_ = true;
    pass(milliseconds(1000));
    members_[standby].runs = false;
    pass(milliseconds(1000));
    plays_ = false;
    pass(milliseconds(4000));
    EXPECT_FALSE(leads(leader));
    plays_ = true;
    pass(milliseconds(4000));
    EXPECT_TRUE(leads(leader));
    for (int pause = 0; pause < 5; ++pause) {
        plays_ = !plays_;
        pass(milliseconds(1500));
        EXPECT_TRUE(leads(leader));
    }
}

TEST_F(Directors, ALeaderThatComputesCamerasOfADelayShowsThemBesideADeadStandby) {
    const auto leader = add(200);
    const auto standby = add(100);
    members_[leader].has_cameras = plays_ = true;
    pass(milliseconds(1000));
    members_[standby].runs = plays_ = false;
    pass(milliseconds(5000));
    EXPECT_TRUE(leads(leader));
}

TEST_F(Directors, OneOfAnotherShardHandsOverToOneOfTheMatchs) {
    const auto leader = add(300);
    const auto spare = add(200);
    const auto of_shard = add(100);
    for (Member& member : members_)
        member.has_cameras = true;
    pass(milliseconds(1000));
    ASSERT_TRUE(leads(leader));
    of(leader).set_shards(1, 2);
    of(spare).set_shards(1, 2);
    of(of_shard).set_shards(2, 2);
    pass(beat);
    EXPECT_FALSE(of(spare).follows(now_)) << "who leads is of another shard too";
    ASSERT_TRUE(of(leader).has_successor(now_));
    of(leader).resign(now_);
    pass(milliseconds(500));
    EXPECT_TRUE(leads(of_shard));
    EXPECT_TRUE(of(leader).follows(now_) && of(spare).follows(now_));
}

TEST_F(Directors, OneLeadsWhateverHappened) {
    EXPECT_TRUE(rc::check([this] {
        members_.clear();
        plays_ = false;
        for (int i = 0; i < 3; ++i)
            add(*rc::gen::inRange(0U, 3U));
        using Happening = std::tuple<std::size_t, int, int>;  // what to whom, and for how many beats
        for (const auto& [member, what, time] : *rc::gen::container<std::vector<Happening>>(rc::gen::tuple(
                 rc::gen::inRange<std::size_t>(0, 3), rc::gen::inRange(0, 5), rc::gen::inRange(0, 20)))) {
            Member& whose = members_[member];
            bool& flag =
                *std::array{&whose.runs, &whose.hears, &whose.hears_game, &whose.is_heard, &plays_}.at(what);
            flag = !flag;
            pass(time * beat);
        }
        for (Member& member : members_)
            member.runs = member.hears = member.hears_game = member.is_heard = true;
        pass(Succession::meeting + Succession::establishing + milliseconds(1000));
        RC_ASSERT(leaders() == 1U);
        const std::uint32_t term = leader().own().term;
        pass(milliseconds(3000));
        RC_ASSERT(leaders() == 1U);
        RC_ASSERT(leader().own().term == term);
    }));
}

}  // namespace
}  // namespace camdir::dds
