#include "dds/sent_movers.hpp"

#include <gtest/gtest.h>

#include <array>
#include <chrono>

namespace camdir::dds {
namespace {

constexpr SenderId owner{1}, other{2};

std::shared_ptr<director::MoverInfo> movers_in(std::uint64_t epoch) {
    auto info = std::make_shared<director::MoverInfo>();
    info->epoch = epoch;
    return info;
}

std::shared_ptr<const director::MoverFrame> places_in(std::uint64_t epoch, std::int64_t time) {
    auto frame = std::make_shared<director::MoverFrame>();
    frame->epoch = epoch;
    frame->frame_time = time;
    return frame;
}

// Of one mover with one hull, a cube of edge 2; with so many half spaces alone it is none.
std::shared_ptr<director::MoverInfo> with_hull(std::uint64_t epoch, std::size_t half_spaces = 6) {
    auto info = movers_in(epoch);
    director::Mover mover{7, {"*7", "func_door", {}, {}}};
    freespace::ConvexHull& hull = mover.shape.hulls.emplace_back();
    for (const float side : {-1.0F, 1.0F})
        for (int axis = 0; axis < 3; ++axis)
            hull.half_spaces.push_back({side * Vec3f::Unit(axis), 1.0F});
    hull.half_spaces.resize(half_spaces);
    info->movers.push_back(mover);
    return info;
}

class SentMoversTest : public testing::Test {
  protected:
    SentMoversTest() { describes_match(owner); }

    void describes_match(const SenderId& sender) {
        director::MatchInfo info;
        info.match_id = "cup";
        (void)ownership_.describe({sender, writer_of(sender), info}, {});
    }
    static WriterHandle writer_of(const SenderId& sender) { return sender[0]; }
    bool admits(const SenderId& sender) { return movers_.admit(sender, writer_of(sender), ownership_); }

    void sends(const SenderId& sender, std::shared_ptr<const director::MoverFrame> frame) {
        if (admits(sender)) movers_.put(sender, std::move(frame));
    }
    // Of which no hull has bounds yet.
    void describes(const SenderId& sender, std::shared_ptr<director::MoverInfo> info) {
        ASSERT_TRUE(admits(sender));
        movers_.put(sender, std::move(info), sender != owner);
    }
    void sends(const SenderId& sender, std::shared_ptr<director::MoverInfo> info) {
        describes(sender, std::move(info));
        bound_all();
    }
    // Returns in how many steps.
    int bound_all() {
        int steps = 0;
        while (movers_.bound_next(ownership_))
            ++steps;
        return steps;
    }
    // Of the mover frame that the owner's poses of this time are seen with; -1: none.
    std::int64_t time_at(std::int64_t time, std::uint64_t epoch = 1) {
        const auto movers = movers_.at(owner, epoch, time);
        return movers ? movers->frame->frame_time : -1;
    }

    Ownership ownership_;
    SentMovers movers_;
};

TEST_F(SentMoversTest, PosesAreSeenAmongTheMoversOfTheNewestFrameUpToTheirs) {
    sends(owner, movers_in(1));
    EXPECT_EQ(time_at(10), -1) << "no frame yet";
    sends(owner, places_in(1, 20));
    EXPECT_EQ(time_at(10), -1);
    sends(owner, places_in(1, 30));
    EXPECT_EQ(time_at(29), 20);
    EXPECT_EQ(time_at(30), 30);
    EXPECT_EQ(time_at(90), 30) << "nothing has moved since";
}

TEST_F(SentMoversTest, WhatHasNotChangedIsTheSameObject) {
    sends(owner, movers_in(1));
    sends(owner, places_in(1, 20));
    const auto first = movers_.at(owner, 1, 20);
    ASSERT_TRUE(first);
    EXPECT_EQ(movers_.at(owner, 1, 21), first);
    sends(owner, movers_in(1));
    EXPECT_EQ(movers_.at(owner, 1, 22), first) << "described again, and the same";
    const auto others = movers_in(1);
    others->movers.push_back({7, {"*7", "func_door", {}, {}}});
    sends(owner, others);
    const auto second = movers_.at(owner, 1, 23);
    EXPECT_NE(second, first);
    EXPECT_EQ(second->info->movers.size(), 1U);
    EXPECT_EQ(second->frame, first->frame);
}

TEST_F(SentMoversTest, AnotherEpochForgetsThem) {
    sends(owner, movers_in(1));
    sends(owner, places_in(1, 20));
    EXPECT_EQ(time_at(30), 20);
    EXPECT_EQ(time_at(30, 2), -1);
    sends(owner, places_in(2, 5));
    EXPECT_EQ(time_at(30, 2), -1) << "of unknown shapes";
    sends(owner, movers_in(2));
    EXPECT_EQ(time_at(30, 2), 5);
}

TEST_F(SentMoversTest, EachOfThePosesThatAStallHeldUpHasItsOwn) {
    sends(owner, movers_in(1));
    for (std::int64_t i = 1; i <= kept_until_taken; ++i)
        sends(owner, places_in(1, 20 * i));
    for (std::int64_t i = 1; i <= kept_until_taken; ++i)
        EXPECT_EQ(time_at(20 * i), 20 * i);
}

TEST_F(SentMoversTest, FramesOfAClockThatPosesNeverReachWaitInABoundedQueue) {
    sends(owner, movers_in(1));
    for (std::int64_t i = 0; i < 20; ++i)
        sends(owner, places_in(1, 1000 + i));
    EXPECT_EQ(time_at(1), 1000 + 20 - static_cast<std::int64_t>(SentMovers::max_waiting) - 1);
}

TEST_F(SentMoversTest, WhoDoesNotOwnTheMatchIsKeptForLater) {
    sends(owner, movers_in(1));
    sends(owner, places_in(1, 20));
    describes_match(other);
    sends(other, movers_in(1));
    sends(other, places_in(1, 7));
    EXPECT_EQ(time_at(30), 20);
    EXPECT_EQ(movers_.at(other, 1, 30)->frame->frame_time, 7);
    EXPECT_EQ(movers_.at(SenderId{3}, 1, 30), nullptr);
}

TEST_F(SentMoversTest, ACrowdOfStrangersTakesNoOwnersPlace) {
    sends(owner, movers_in(1));
    sends(owner, places_in(1, 20));
    for (unsigned char i = 2; i < 100; ++i)
        describes(SenderId{i}, movers_in(1));
    EXPECT_EQ(time_at(30), 20);
    for (const SenderId& late : {SenderId{2}, SenderId{99}}) {
        sends(late, places_in(1, 8));
        describes_match(late);
    }
    bound_all();
    EXPECT_TRUE(movers_.at(SenderId{99}, 1, 30)) << "the last ones are kept";
    EXPECT_FALSE(movers_.at(SenderId{2}, 1, 30)) << "the first are not";
}

TEST_F(SentMoversTest, ACrowdOfStrangersTakesNoPlaceOfWhoMayOwnTheMatch) {
    describes_match(other);
    sends(other, places_in(1, 7));
    sends(other, movers_in(1));
    for (unsigned char i = 3; i < 100; ++i)
        EXPECT_TRUE(admits(SenderId{i}));
    EXPECT_TRUE(movers_.at(other, 1, 30));
}

TEST_F(SentMoversTest, WhereAllPlacesAreOfThoseWhoMayOwnTheMatchAStrangerHasNone) {
    static_assert(SentMovers::max_senders == Ownership::max_claims);
    for (unsigned char i = 1; i <= SentMovers::max_senders; ++i) {
        describes_match({i});
        EXPECT_TRUE(admits({i}));
    }
    EXPECT_FALSE(admits(SenderId{99}));
    EXPECT_TRUE(admits(owner)) << "it has its place";
}

TEST_F(SentMoversTest, NothingIsKeptOfWhoIsGone) {
    describes_match(other);
    for (const SenderId& sender : {owner, other}) {
        sends(sender, movers_in(1));
        sends(sender, places_in(1, 7));
    }
    const std::array<WriterHandle, 1> matched{writer_of(owner)};
    movers_.retain(matched);
    EXPECT_EQ(time_at(30), 7);
    EXPECT_FALSE(movers_.at(other, 1, 30));
    movers_.retain({});
    EXPECT_TRUE(movers_.empty());
}

TEST_F(SentMoversTest, WhoHasAWriterStillIsNotGone) {
    const WriterHandle of_infos = writer_of(owner), of_frames = 50;
    for (const WriterHandle left : {of_infos, of_frames}) {
        sends(owner, movers_in(1));
        ASSERT_TRUE(movers_.admit(owner, of_frames, ownership_));
        movers_.put(owner, places_in(1, 7));
        const std::array<WriterHandle, 1> matched{left};
        movers_.retain(matched);
        EXPECT_EQ(time_at(30), 7);
    }
}

TEST_F(SentMoversTest, HullsHaveTheirBoundsOneByOneAndThenTheDescriptionCounts) {
    sends(owner, places_in(1, 7));
    auto info = with_hull(1);
    info->movers.push_back(info->movers.front());
    describes(owner, info);
    const auto first = movers_.bound_next(ownership_);
    ASSERT_TRUE(first);
    EXPECT_FALSE(first->is_accepted || first->error);
    EXPECT_TRUE(movers_.has_unbounded());
    EXPECT_EQ(time_at(30), -1);
    const auto second = movers_.bound_next(ownership_);
    ASSERT_TRUE(second);
    EXPECT_TRUE(second->is_accepted);
    EXPECT_FALSE(movers_.has_unbounded());
    EXPECT_EQ(time_at(30), 7);
}

TEST_F(SentMoversTest, ADescriptionWhoseHullIsNoneIsNotInEffect) {
    sends(owner, with_hull(1));
    sends(owner, places_in(1, 7));
    const auto before = movers_.at(owner, 1, 30);
    ASSERT_TRUE(before);
    describes(owner, with_hull(1, 5));
    const auto step = movers_.bound_next(ownership_);
    ASSERT_TRUE(step);
    EXPECT_EQ(step->error, ValidationError::bad_hull);
    EXPECT_FALSE(step->is_accepted);
    EXPECT_EQ(movers_.at(owner, 1, 31), before);
}

TEST_F(SentMoversTest, OfWhoIsGoneNothingIsInEffectThoughItsHullsHaveBoundsLater) {
    auto info = with_hull(1);
    info->movers.push_back(info->movers.front());
    describes(owner, info);
    ASSERT_TRUE(movers_.bound_next(ownership_));
    movers_.retain({});
    EXPECT_EQ(bound_all(), 1);
    EXPECT_TRUE(movers_.empty());
}

TEST_F(SentMoversTest, TheOwnersDescriptionIsTheFirstToHaveBoundsAndAStrangersWaits) {
    const SenderId stranger{3};
    describes_match(other);
    for (const SenderId& sender : {stranger, other, owner})
        describes(sender, movers_in(1));
    const auto owners = movers_.bound_next(ownership_);
    ASSERT_TRUE(owners);
    EXPECT_TRUE(owners->is_accepted);
    const auto others = movers_.bound_next(ownership_);
    ASSERT_TRUE(others);
    EXPECT_FALSE(others->is_accepted) << "it was counted as dropped";
    EXPECT_FALSE(movers_.bound_next(ownership_));
    EXPECT_TRUE(movers_.has_unbounded());
    describes_match(stranger);
    EXPECT_TRUE(movers_.bound_next(ownership_));
    EXPECT_FALSE(movers_.has_unbounded());
}

}  // namespace
}  // namespace camdir::dds
