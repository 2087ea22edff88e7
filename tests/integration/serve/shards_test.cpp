// Matches that are spread over directors, and move when one more comes or one goes.
#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "hall.hpp"
#include "support/eventually.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Context;
using camera_director::Observer;

// Directors 10 and 20, of the shards "a" and "b".
Server::Options options_of(int index, const std::string& shards) {
    return {.participant_index = index,
            .director_id = 10 * (index + 1),
            .shard = index == 0 ? "a" : "b",
            .shards = shards};
}

// Until the next `frames` frames have come from this director.
testing::AssertionResult moves_to(Observer& observer, std::uint64_t director_id, int frames) {
    std::optional<std::uint32_t> last;
    testing::AssertionResult result = testing::AssertionSuccess();
    const bool came = sees(observer, [&](const auto& frame, auto cameras) {
        if (last && frame.frame_number != *last + 1 && !came_late(frame))
            result = testing::AssertionFailure() << "frame " << frame.frame_number << " after " << *last;
        for (const auto& camera : cameras)
            if ((camera.flags & CDIR_CAMERA_CUT) != 0) result = testing::AssertionFailure() << "a cut";
        last = frame.frame_number;
        if (frame.director_id == director_id) --frames;
        return !result || frames == 0;
    });
    return came ? result : testing::AssertionFailure() << "director " << director_id << " serves no frames";
}

class ShardsTest : public testing::Test {
  protected:
    static constexpr const char* match_of_b = "cup";
    static constexpr const char* match_of_a = "jug";

    TestDomain domain_;
};

TEST_F(ShardsTest, EachServesItsOwnMatches) {
    const Server a(domain_.id(), options_of(0, R"(["a", "b"])"));
    const Server b(domain_.id(), options_of(1, R"(["a", "b"])"));
    const Context context = Context::open(connection(domain_.id())).value();
    for (const auto& [match_id, director] : {std::pair{match_of_a, 10U}, std::pair{match_of_b, 20U}}) {
        const Game game(context, match_id, "hall");
        Observer observer = Observer::open(context, match_id, "anna").value();
        observer.request({.target = 1}).value();
        ASSERT_TRUE(sees_own_camera(observer)) << a.log() << b.log();
        EXPECT_TRUE(serves_on(observer, director, 60)) << a.log() << b.log();
        EXPECT_EQ(observer.counters().value().directors, 1U) << "no other has opened it";
    }
}

TEST_F(ShardsTest, MatchesMoveWithoutALostFrameOrACutToAShardThatComesAndBackWhenItGoes) {
    Server a(domain_.id(), options_of(0, R"(["a"])"));
    ASSERT_TRUE(a.ready()) << a.log();
    const Context context = Context::open(connection(domain_.id())).value();
    const Game moving(context, match_of_b, "hall");
    const Game staying(context, match_of_a, "hall");
    Observer observer = Observer::open(context, match_of_b, "anna").value();
    Observer of_other = Observer::open(context, match_of_a, "anna").value();
    for (Observer* each : {&observer, &of_other}) {
        each->request({.target = 1}).value();
        ASSERT_TRUE(sees_own_camera(*each)) << a.log();
        ASSERT_TRUE(serves_on(*each, 10, 60)) << a.log();
    }

    Server b(domain_.id(), options_of(1, R"(["a", "b"])"));
    ASSERT_TRUE(b.ready()) << b.log();
    ASSERT_TRUE(eventually([&] {
        observer.poll().value();
        return observer.counters().value().directors == 2;
    })) << b.log();
    EXPECT_TRUE(serves_on(observer, 10, 60)) << "whoever serves a match serves it on";
    a.reload(options_of(0, R"(["a", "b"])"));
    EXPECT_TRUE(moves_to(observer, 20, 60)) << a.log() << b.log();
    EXPECT_TRUE(eventually([&] {
        observer.poll().value();
        return observer.counters().value().directors == 1;
    })) << a.log();
    EXPECT_TRUE(serves_on(of_other, 10, 60)) << a.log();

    a.reload(options_of(0, R"(["a"])"));
    ASSERT_TRUE(eventually([&] {
        observer.poll().value();
        return observer.counters().value().directors == 2;
    })) << a.log();
    b.reload(options_of(1, R"(["a"])"));
    EXPECT_TRUE(moves_to(observer, 10, 60)) << a.log() << b.log();
    EXPECT_TRUE(serves_on(observer, 10, 60)) << a.log() << b.log();
}

TEST_F(ShardsTest, MatchesOfAShardThatDoesNotRunGoOnWhereTheyAre) {
    const auto of_a = [](int index, const std::string& shards) {
        Server::Options options = options_of(index, shards);
        options.shard = "a";
        return options;
    };
    std::optional<Server> leader;
    leader.emplace(domain_.id(), of_a(0, R"(["a"])"));
    ASSERT_TRUE(leader->ready()) << leader->log();
    const Context context = Context::open(connection(domain_.id())).value();
    const Game game(context, match_of_b, "hall");
    Observer observer = Observer::open(context, match_of_b, "anna").value();
    observer.request({.target = 1}).value();
    ASSERT_TRUE(sees_own_camera(observer)) << leader->log();
    Server standby(domain_.id(), of_a(1, R"(["a"])"));
    ASSERT_TRUE(standby.ready()) << standby.log();
    ASSERT_TRUE(eventually([&] {
        observer.poll().value();
        return observer.counters().value().directors == 2;
    })) << standby.log();

    standby.reload(of_a(1, R"(["a", "b"])"));
    ASSERT_TRUE(eventually([&] { return standby.log().find("reloaded") != std::string::npos; }));
    EXPECT_TRUE(moves_to(observer, 10, 180)) << leader->log() << standby.log();
    leader->reload(of_a(0, R"(["a", "b"])"));
    ASSERT_TRUE(eventually([&] { return leader->log().find("reloaded") != std::string::npos; }));
    EXPECT_TRUE(moves_to(observer, 10, 180)) << leader->log() << standby.log();
    leader.reset();
    EXPECT_TRUE(sees(observer, [](const auto& frame, auto /*cameras*/) { return frame.director_id == 20; }))
        << standby.log();
}

}  // namespace
}  // namespace camdir::test
