// Movers on their way through the gateway: they come with the poses of the same match.
#include "gateway_test.hpp"

namespace camdir::dds {
namespace {

class MoversTest : public GatewayTest {
  protected:
    static void describe(RawPeer& raw, std::uint64_t epoch, const std::string& model) {
        test::RawMoverInfo info("cup", epoch);
        info.add_mover(1, model);
        raw.write(info.sample());
    }
    static void place(RawPeer& raw, std::uint64_t epoch, std::int64_t time) {
        test::RawMoverFrame frame("cup", epoch, time);
        frame.add(1, {0.0F, 0.0F, 1.0F});
        raw.write(frame.sample());
    }
    // Sends poses until the line is there.
    bool leads_to(RawPeer& raw, const std::string& line, std::uint64_t epoch = 1) {
        RawPoseFrame frame("cup", epoch, ++number_, 1);
        return eventually([&] {
            raw.write(frame.sample());
            return recorder_.has(line);
        });
    }
    bool is_ignored(RawPeer& raw, std::uint64_t epoch, const std::string& model) {
        const std::uint64_t infos = dropped(Topic::mover_info, ValidationError::not_owner);
        const std::uint64_t frames = dropped(Topic::mover_frame, ValidationError::not_owner);
        describe(raw, epoch, model);
        place(raw, epoch, 0);
        return eventually([&] { return dropped(Topic::mover_info, ValidationError::not_owner) > infos; }) &&
               eventually([&] { return dropped(Topic::mover_frame, ValidationError::not_owner) > frames; });
    }

    std::uint32_t number_ = 0;
};

TEST_F(MoversTest, ComeWithThePosesAlsoWhereTheyWereWrittenBefore) {
    RawPeer& raw = peer("cup");
    describe(raw, 1, "*3");
    place(raw, 1, -5);
    raw.write(test::raw_match_info("cup", 1));
    EXPECT_TRUE(leads_to(raw, "movers cup *3 at -5"));
    place(raw, 1, 0);
    EXPECT_TRUE(leads_to(raw, "movers cup *3 at 0"));
    place(raw, 1, 3'600'000'000'000);
    EXPECT_TRUE(eventually([&] { return gateway_->counters().of(Topic::mover_frame).accepted >= 3; }));
    ASSERT_TRUE(leads_to(raw, "pose cup " + std::to_string(number_ + 1)));
    EXPECT_FALSE(recorder_.has("movers cup *3 at 3600000000000")) << "the poses are of an earlier time";
    EXPECT_GE(gateway_->counters().of(Topic::mover_info).accepted, 1U);
}

TEST_F(MoversTest, OfAnotherEpochDoNotCount) {
    RawPeer& raw = game("cup");
    describe(raw, 1, "*3");
    place(raw, 1, 0);
    ASSERT_TRUE(leads_to(raw, "movers cup *3 at 0"));
    raw.write(test::raw_match_info("cup", 2));
    ASSERT_TRUE(eventually([&] { return recorder_.has("info cup 2"); }));
    const std::ptrdiff_t before = recorder_.count("movers cup *3 at 0");
    ASSERT_TRUE(leads_to(raw, "pose cup " + std::to_string(number_ + 1), 2));
    EXPECT_EQ(recorder_.count("movers cup *3 at 0"), before);
    describe(raw, 2, "*4");
    place(raw, 2, -1);
    EXPECT_TRUE(leads_to(raw, "movers cup *4 at -1", 2));
}

TEST_F(MoversTest, OfAStrangerAreDroppedAndCounted) {
    RawPeer& owner = game("cup");
    describe(owner, 1, "*3");
    place(owner, 1, 0);
    ASSERT_TRUE(leads_to(owner, "movers cup *3 at 0"));
    RawPeer& stranger = peer("cup");
    EXPECT_TRUE(is_ignored(stranger, 1, "*9"));
    ASSERT_TRUE(leads_to(owner, "pose cup " + std::to_string(number_ + 1)));
    EXPECT_FALSE(recorder_.has("movers cup *9 at 0"));
}

TEST_F(MoversTest, OfASuccessorCountFromItsFirstPoses) {
    recorder_.silence = std::chrono::milliseconds(50);
    RawPeer& owner = game("cup");
    ASSERT_TRUE(leads_to(owner, "pose cup 1"));
    RawPeer& successor = peer("cup");
    successor.write(test::raw_match_info("cup", 7));
    EXPECT_TRUE(is_ignored(successor, 7, "*7"));
    EXPECT_TRUE(leads_to(successor, "movers cup *7 at 0", 7)) << "the owner is silent";
}

TEST_F(MoversTest, ThatAreMalformedAreDroppedAndCounted) {
    RawPeer& raw = game("cup");
    test::RawMoverInfo unbounded("cup", 1);
    unbounded.add_mover(1);
    unbounded.add_box({0.0F, 0.0F, 0.0F}, {1.0F, 1.0F, 1.0F});
    unbounded.planes[0] = -1.0F;
    raw.write(unbounded.sample());
    EXPECT_TRUE(eventually([&] { return dropped(Topic::mover_info, ValidationError::bad_hull) == 1; }));
    test::RawMoverFrame skewed("cup", 1, 0);
    skewed.add(1, {0.0F, 0.0F, 0.0F});
    skewed.orientation[3] = 2.0F;
    raw.write(skewed.sample());
    EXPECT_TRUE(eventually([&] { return dropped(Topic::mover_frame, ValidationError::not_unit) == 1; }));
    test::RawMoverFrame foreign("final", 1, 0);
    raw.write(foreign.sample());
    EXPECT_TRUE(
        eventually([&] { return dropped(Topic::mover_frame, ValidationError::wrong_partition) == 1; }));
    ASSERT_TRUE(leads_to(raw, "pose cup 1"));
    describe(raw, 1, "*3");
    place(raw, 1, 0);
    EXPECT_TRUE(leads_to(raw, "movers cup *3 at 0")) << "what is valid counts";
}

}  // namespace
}  // namespace camdir::dds
