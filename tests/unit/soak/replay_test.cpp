#include "soak/replay.hpp"

#include <gtest/gtest.h>

#include <string>

namespace camdir::soak {
namespace {

// Two players at 10 Hz from 1.0 to 1.3 s, and what happens to them.
std::shared_ptr<const evaluation::RecordedMatch> match_with(const std::string& rows) {
    std::string poses = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (const int time : {1000, 1100, 1200, 1300})
        for (const int player : {1, 4})
            poses += std::to_string(time) + ',' + std::to_string(player) + ",0,0,0,0,0,0,0,0,0,0,0,0,1\n";
    auto match = evaluation::parse_match(std::as_bytes(std::span<const char>(poses)), "match.csv").value();
    const std::string table = "t_ms,event,player,other,detail\n" + rows;
    match.events =
        evaluation::parse_events(std::as_bytes(std::span<const char>(table)), "events.csv", match.trace)
            .value();
    return std::make_shared<const evaluation::RecordedMatch>(std::move(match));
}

// "frame: kind actor subject value detail" of each event of the first frames.
std::vector<std::string> told(const MatchFrames& frames, std::uint64_t count) {
    std::vector<std::string> all;
    for (std::uint64_t number = 0; number < count; ++number) {
        MatchFrame frame;
        frames(number, frame);
        EXPECT_EQ(frame.poses.player_id, (std::vector<std::uint32_t>{1, 4}));
        for (const camera_director::MatchEvent& event : frame.events) {
            const auto player = [](std::uint32_t id) {
                return id == CDIR_NO_PLAYER ? "-" : std::to_string(id);
            };
            all.push_back(std::to_string(number) + ": " + std::to_string(event.kind) + ' ' +
                          player(event.actor) + ' ' + player(event.subject) + ' ' +
                          std::to_string(static_cast<int>(event.value)) + ' ' + event.detail);
        }
    }
    return all;
}

TEST(Replay, TellsWhatHappensWithTheFirstFrameThatIsNotBeforeIt) {
    const auto match =
        match_with("1000,kill,1,4,rocket\n1100,damage,1,4,35\n1101,kill,,4,lava\n1101,jump,1,,\n");
    EXPECT_EQ(told(replay(match, 0), 4),
              (std::vector<std::string>{"0: 1 1 4 0 rocket", "1: 5 1 4 35 ", "2: 1 - 4 0 lava"}));
    EXPECT_EQ(told(replay(match_with("1000,death,,4,fell\n"), 0), 1),
              std::vector<std::string>{"0: 1 - 4 0 fell"});
    EXPECT_TRUE(is_sent("flag_taken") && is_sent("respawn") && is_sent("death"));
    EXPECT_FALSE(is_sent("jump"));
}

TEST(Replay, TellsItAgainEveryTimeAndNothingFromBeforeAndAfter) {
    const auto match =
        match_with("999,kill,1,4,\n1200,award,4,,excellent\n1250,respawn,1,,\n1301,kill,1,4,\n");
    EXPECT_EQ(told(replay(match, 2), 8), (std::vector<std::string>{"0: 6 4 - 0 excellent", "1: 9 1 - 0 ",
                                                                   "4: 6 4 - 0 excellent", "5: 9 1 - 0 "}));
}

TEST(Replay, MarksAllPlayersWhereTheMatchBeginsAnew) {
    const MatchFrames frames = replay(match_with(""), 3);
    for (std::uint64_t number = 0; number < 6; ++number) {
        MatchFrame frame;
        frames(number, frame);
        const std::uint32_t flags =
            number % 4 == 1 ? CDIR_POSE_ALIVE | CDIR_POSE_DISCONTINUITY : CDIR_POSE_ALIVE;
        EXPECT_EQ(frame.poses.flags, (std::vector<std::uint32_t>{flags, flags})) << number;
    }
}

TEST(Replay, SendsWhatTheWireTakes) {
    std::string long_name = "a";
    for (int i = 0; i < 20; ++i)
        long_name += "\u00e9";
    const auto match =
        match_with("1000,item,1,," + long_name + "\n1000,kill,1,4,a\tb\n1000,damage,1,4,inf\n");
    EXPECT_EQ(told(replay(match, 0), 1), (std::vector<std::string>{"0: 7 1 - 0 " + long_name.substr(0, 31),
                                                                   "0: 1 1 4 0 a?b", "0: 5 1 4 0 "}));
}

}  // namespace
}  // namespace camdir::soak
