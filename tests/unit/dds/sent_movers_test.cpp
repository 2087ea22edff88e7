#include "dds/sent_movers.hpp"

#include <gtest/gtest.h>

#include <array>

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

class SentMoversTest : public testing::Test {
  protected:
    void sends(const SenderId& sender, std::shared_ptr<const director::MoverFrame> frame) {
        movers_.admit(sender, owner);
        movers_.put(sender, std::move(frame));
    }
    void sends(const SenderId& sender, std::shared_ptr<director::MoverInfo> described) {
        movers_.admit(sender, owner);
        movers_.put(sender, std::move(described), false);
        const auto rank = [](const SenderId& of) {
            return of == owner ? SentMovers::Rank::owner : SentMovers::Rank::may_own;
        };
        while (const auto described = movers_.take_described(rank))
            movers_.put_bounded(described->sender, described->info);
    }
    // Of the mover frame that the owner's poses of this time are seen with; -1: none.
    std::int64_t time_at(std::int64_t time, std::uint64_t epoch = 1) {
        const auto movers = movers_.at(owner, epoch, time);
        return movers ? movers->frame->frame_time : -1;
    }

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

TEST_F(SentMoversTest, FramesOfAClockThatPosesNeverReachWaitInABoundedQueue) {
    sends(owner, movers_in(1));
    for (std::int64_t i = 0; i < 20; ++i)
        sends(owner, places_in(1, 1000 + i));
    EXPECT_EQ(time_at(1), 1000 + 20 - static_cast<std::int64_t>(SentMovers::max_waiting) - 1);
}

TEST_F(SentMoversTest, WhoDoesNotOwnTheMatchIsKeptForLater) {
    sends(owner, movers_in(1));
    sends(owner, places_in(1, 20));
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
        sends(SenderId{i}, movers_in(1));
    EXPECT_EQ(time_at(30), 20);
    sends(SenderId{99}, places_in(1, 8));
    EXPECT_TRUE(movers_.at(SenderId{99}, 1, 30)) << "the last ones are kept";
    sends(SenderId{2}, places_in(1, 8));
    EXPECT_FALSE(movers_.at(SenderId{2}, 1, 30)) << "the first are not";
}

TEST_F(SentMoversTest, ACrowdOfStrangersTakesNoPlaceOfWhoMayOwnTheMatch) {
    const std::array<SenderId, 1> heirs{other};
    sends(other, places_in(1, 7));
    sends(other, movers_in(1));
    for (unsigned char i = 3; i < 100; ++i)
        EXPECT_TRUE(movers_.admit(SenderId{i}, owner, heirs));
    EXPECT_TRUE(movers_.at(other, 1, 30));
}

TEST_F(SentMoversTest, WhereAllPlacesAreOfThoseWhoMayOwnTheMatchAStrangerHasNone) {
    std::vector<SenderId> heirs;
    for (unsigned char i = 2; i <= SentMovers::max_senders; ++i)
        heirs.push_back({i});
    EXPECT_TRUE(movers_.admit(owner, owner, heirs));
    for (const SenderId& heir : heirs)
        EXPECT_TRUE(movers_.admit(heir, owner, heirs));
    EXPECT_FALSE(movers_.admit(SenderId{99}, owner, heirs));
    EXPECT_TRUE(movers_.admit(owner, owner, heirs)) << "it has its place";
}

TEST_F(SentMoversTest, NothingIsKeptOfWhoIsGone) {
    for (const SenderId& sender : {owner, other}) {
        sends(sender, movers_in(1));
        sends(sender, places_in(1, 7));
    }
    const std::array<SenderId, 1> matched{owner};
    movers_.retain(matched);
    EXPECT_EQ(time_at(30), 7);
    EXPECT_FALSE(movers_.at(other, 1, 30));
    movers_.put_bounded(other, movers_in(1));
    EXPECT_FALSE(movers_.at(other, 1, 30)) << "its hulls had bounds too late";
    movers_.retain({});
    EXPECT_TRUE(movers_.empty());
}

TEST_F(SentMoversTest, TheOwnersDescriptionIsTheFirstToHaveBoundsAndAStrangersWaits) {
    for (const SenderId& sender : {other, owner}) {
        movers_.admit(sender, owner);
        movers_.put(sender, movers_in(1), sender == other);
    }
    auto others = SentMovers::Rank::stranger;
    const auto rank = [&](const SenderId& of) { return of == owner ? SentMovers::Rank::owner : others; };
    const auto next = [&] {
        const auto described = movers_.take_described(rank);
        if (described) {
            EXPECT_EQ(described->counted_as_dropped, described->sender == other);
        }
        return described ? described->sender : SenderId{};
    };
    EXPECT_EQ(next(), owner);
    EXPECT_EQ(next(), SenderId{});
    others = SentMovers::Rank::may_own;
    EXPECT_EQ(next(), other);
    EXPECT_EQ(next(), SenderId{});
}

}  // namespace
}  // namespace camdir::dds
