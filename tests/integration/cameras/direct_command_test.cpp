// `direct` over a match of four seconds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

#include "hall_match.hpp"
#include "support/child_process.hpp"
#include "support/demo_writer.hpp"

namespace camdir {
namespace {

using nlohmann::json;
using testing::HasSubstr;
using testing::Not;

class DirectCommand : public HallMatch {
  protected:
    // The exit code; what it says is in `errors_`.
    int direct(const std::vector<std::string>& options) {
        std::vector<std::string> command = {CAMERA_DIRECTOR, "direct", vfs_,       "--map", map_,
                                            "--trace",       trace_,   "--events", events_};
        command.insert(command.end(), options.begin(), options.end());
        test::ChildProcess process(command);
        const int code = process.wait();
        errors_ = process.errors();
        return code;
    }

    static std::string written(const std::string& file) {
        const Bytes bytes = read_file(file).value();
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }

    std::string errors_;
};

TEST_F(DirectCommand, WritesEveryFigureBesideOtherDirectors) {
    const std::string file = folder_ / "figures.json";
    ASSERT_EQ(direct({"--delay", "2", "--json", file}), 0) << errors_;
    const json figures = json::parse(written(file));
    const char* names[] = {
        "kills",           "kills_seen",     "kills_seen_both", "multi_kills",   "multi_kills_seen",
        "cuts_per_minute", "shot_s_p10",     "shot_s_p50",      "shot_s_p90",    "shots_under_1_5",
        "jump_cuts",       "line_crossings", "idle_share",      "missed_by_cut", "moment_delay_s"};
    for (const char* name : names) {
        EXPECT_TRUE(figures.at(name).is_number()) << name;
        for (const char* other : {"running", "random", "hltv", "quakeworld", "bound"})
            EXPECT_TRUE(figures.at(other).at(name).is_number()) << other << ' ' << name;
    }
    EXPECT_EQ(figures.at("kills"), 1);
    EXPECT_EQ(figures.at("kills_seen"), 1);
    EXPECT_EQ(figures.at("kills_bound"), 1);
    EXPECT_EQ(figures.at("kills_in_reach"), 1);
    EXPECT_THAT(errors_, HasSubstr("\nbound: the most kills that can be seen"));
}

TEST_F(DirectCommand, IgnoresEventsOfKindsThatItDoesNotKnow) {
    ASSERT_TRUE(write_file(events_, "t_ms,event,player,other\n1550,jump,99,\n3000,kill,1,0\n"));
    const std::string file = folder_ / "figures.json";
    ASSERT_EQ(direct({"--json", file}), 0) << errors_;
    EXPECT_EQ(json::parse(written(file)).at("kills"), 1);
}

TEST_F(DirectCommand, WritesTheCameraOfEveryFrameAndRepeatsItself) {
    const std::string file = folder_ / "programme.csv";
    ASSERT_EQ(direct({"--delay", "0", "--cameras", file}), 0) << errors_;
    const std::string first = written(file);
    EXPECT_TRUE(first.starts_with("t_ms,player,x,y,z,qw,qx,qy,qz,cut,reason\n0,")) << first.substr(0, 200);
    EXPECT_EQ(std::ranges::count(first, '\n'), 1 + 4000 / 16 + 1);
    EXPECT_THAT(first, HasSubstr(",1,opening\n"));
    ASSERT_EQ(direct({"--delay", "0", "--cameras", file}), 0) << errors_;
    EXPECT_EQ(written(file), first);
}

TEST_F(DirectCommand, DrawsAPageThatNeedsNothingElse) {
    const std::string page = folder_ / "programme.html";
    const std::string file = folder_ / "figures.json";
    ASSERT_EQ(direct({"--delay", "2", "--json", file, "--report", page}), 0) << errors_;
    const std::string html = written(page);
    const json figures = json::parse(written(file));
    EXPECT_THAT(html, HasSubstr("<tr id=\"kills_seen\"><th>kills_seen</th><td><data value=\"1\">1</data>"));
    EXPECT_THAT(html, HasSubstr("its other figures bound nothing"));
    for (const char* section : {"figures", "timeline", "cuts"})
        EXPECT_THAT(html, HasSubstr("<section id=\"" + std::string(section) + "\">"));
    EXPECT_THAT(html, HasSubstr("<title>3 s: 1 kills 0, seen</title>"));
    EXPECT_THAT(html, testing::Not(testing::ContainsRegex("https?:|@import|url\\(|<link|<iframe|src=")));
    EXPECT_TRUE(html.ends_with("</html>\n"));
}

TEST_F(DirectCommand, TakesItsRulesFromTheConfiguration) {
    const std::string config = folder_ / "director.json";
    const std::string file = folder_ / "figures.json";
    ASSERT_TRUE(write_file(config, R"({"direction": {"minimum_shot_s": 60}})"));
    ASSERT_EQ(direct({"--config", config, "--json", file}), 0) << errors_;
    const json figures = json::parse(written(file));
    EXPECT_EQ(figures.at("shot_s_p50"), 0);  // there is no cut
    EXPECT_EQ(figures.at("random").at("kills"), 1);
    ASSERT_TRUE(write_file(config, R"({"moments": {"kill": {"worth": -1}}})"));
    EXPECT_EQ(direct({"--config", config, "--json", file}), 1);
    EXPECT_THAT(errors_,
                HasSubstr("director.json: /moments/kill/worth: -1: expected a number from 0 to 1000"));
}

// The hall's match as a demo of the game, whose events are in it.
TEST_F(DirectCommand, TakesTheEventsOfADemo) {
    using test::DemoMessages;
    test::DemoWriter demo;
    const auto pose = [](double x, double y, double yaw) {
        return DemoMessages::Pose{.origin = {x, y, 3.4 - 22.0}, .angles = {0, yaw, 0}};
    };
    demo.to_everyone(0, DemoMessages()
                            .begin_level({{test::fte, 0x8000}})
                            .models({"progs/player.mdl"})
                            .user_info(0, R"(\name\walker)")
                            .user_info(1, R"(\name\killer)"));
    for (int t = 0; t <= 4000; t += 16) {
        const double angle = 1e-3 * t;
        DemoMessages frame(true);
        frame.player(0, pose(2.5 * std::sin(angle), -2.5 * std::cos(angle), 0)).player(1, pose(0, 0, 0));
        if (t == 3008) frame.print(1, "walker rides killer's rocket\n");
        demo.to_everyone(16, frame);
    }
    const std::string trace = folder_ / "match.mvd";
    ASSERT_TRUE(write_file(trace, demo.bytes()));
    const std::string file = folder_ / "figures.json";
    const std::vector<std::string> command = {CAMERA_DIRECTOR, "direct", vfs_,     "--map", map_,
                                              "--json",        file,     "--trace"};
    const auto run = [&](const std::string& match) {
        std::vector<std::string> whole = command;
        whole.push_back(match);
        test::ChildProcess process(whole);
        const int code = process.wait();
        errors_ = process.errors();
        return code;
    };
    ASSERT_EQ(run(trace), 0) << errors_;
    EXPECT_EQ(json::parse(written(file)).at("kills"), 1);
    EXPECT_EQ(run(trace_), 0) << errors_;
    EXPECT_THAT(errors_, HasSubstr("trace.csv holds no events, so that no kill can be foreseen: name them"));
    EXPECT_EQ(json::parse(written(file)).at("kills"), 0);
}

// Player 1 is dead when `is_dead` says so.
std::string two_who_stand(int milliseconds, int every, const std::function<bool(int)>& is_dead) {
    std::string poses = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (int t = 0; t < milliseconds; t += every) {
        poses += std::to_string(t) + ",0,2.5,0,1.5,0,0,0,0,0,0,0,0,0,1\n";
        poses += std::to_string(t) + ",1,0,2.5,1.5,0,0,0,0,0,0,0,0,0," + (is_dead(t) ? "0\n" : "1\n");
    }
    return poses;
}

TEST_F(DirectCommand, WarnsOfEventsInWhichOthersDie) {
    ASSERT_TRUE(write_file(trace_, two_who_stand(4000, 50, [](int t) { return t >= 1000 && t < 1500; })));
    const auto with_kills_of = [&](const std::string& rows) {
        std::string table = "t_ms,event,player,other\n";
        for (int i = 0; i < 4; ++i)
            table += rows;
        ASSERT_TRUE(write_file(events_, table));
        ASSERT_EQ(direct({}), 0) << errors_;
    };
    with_kills_of("1000,kill,0,1\n");
    EXPECT_THAT(errors_, Not(HasSubstr("die in")));
    with_kills_of("2000,kill,0,1\n");
    EXPECT_THAT(errors_, HasSubstr("events.csv: of 4 who are killed 0 die in"));
    std::string hits;
    for (int i = 0; i < 1000; ++i)
        hits += "2000,damage,0,1\n";
    with_kills_of("2000,kill,0,1\n" + hits);
    EXPECT_THAT(errors_, HasSubstr("events.csv: of 4 who are killed 0 die in")) << "however rare kills are";
    with_kills_of("9000,kill,0,1\n");
    EXPECT_THAT(errors_, Not(HasSubstr("die in"))) << "they are not of the time of the poses";
    with_kills_of("");
    EXPECT_THAT(errors_, HasSubstr("events.csv has no event that is directed by"));
}

TEST_F(DirectCommand, DoesNotWarnOfKillsBetweenRareFrames) {
    ASSERT_TRUE(write_file(trace_, two_who_stand(10'000, 1000, [](int t) { return t % 2000 == 0; })));
    ASSERT_TRUE(write_file(events_,
                           "t_ms,event,player,other\n1400,kill,0,1\n3400,kill,0,1\n5400,kill,0,1\n"
                           "7400,kill,0,1\n"));
    ASSERT_EQ(direct({}), 0) << errors_;
    EXPECT_THAT(errors_, Not(HasSubstr("die in")));
}

TEST_F(DirectCommand, RefusesEventsOfAnotherMatchAndLeavesWhatWasThere) {
    const std::string file = folder_ / "programme.csv";
    ASSERT_TRUE(write_file(file, "old"));
    ASSERT_TRUE(write_file(events_, "t_ms,event,player,other\n3000,kill,17,0\n"));
    EXPECT_EQ(direct({"--cameras", file}), 1);
    EXPECT_THAT(errors_, HasSubstr("events.csv:2: column \"player\" is 17, expected a player of the trace"));
    EXPECT_EQ(written(file), "old");
}

// Four frames a second: most beats have none. Of the camera that follows the player, which is all that a
// random switch has; the editor may show them from a fixed one.
TEST_F(DirectCommand, AJumpOfTheCameraIsOneCutHoweverRareTheFramesAre) {
    std::string text = "t_ms,player,x,y,z,pitch,yaw,roll,vx,vy,vz,viewheight,team,teleport_bit,alive\n";
    for (int t = 0; t < 4000; t += 250)
        text += std::to_string(t) + (t < 2000 ? ",0,3,3" : ",0,-3,-3") + ",3.4,0,0,0,0,0,0,0.6,0," +
                (t < 2000 ? "0" : "1") + ",1\n";
    ASSERT_TRUE(write_file(trace_, text));
    ASSERT_TRUE(write_file(events_, "t_ms,event,player,other\n"));
    const std::string file = folder_ / "figures.json";
    ASSERT_EQ(direct({"--json", file}), 0) << errors_;
    const json figures = json::parse(written(file)).at("random");
    EXPECT_EQ(figures.at("shot_s_p50"), 2.0);
    EXPECT_EQ(figures.at("shots_under_1_5"), 0);
    EXPECT_NEAR(figures.at("cuts_per_minute"), 60.0 / 3.8, 1e-9);
}

// Nobody may be shown for longer than 2 s at a time.
TEST_F(DirectCommand, NamesFixedCamerasInItsTableAndOnItsPage) {
    const std::string file = folder_ / "programme.csv";
    const std::string page = folder_ / "programme.html";
    const std::string config = folder_ / "director.json";
    write_trace(0.0, 30'000);
    write_freespace({{.position = Vec3f(6, 0, 4), .yaw = std::numbers::pi_v<float>, .spawn_point = 0}});
    ASSERT_TRUE(write_file(config, R"({"direction": {"maximum_shot_s": 2, "preferred_shot_s": 2}})"));
    ASSERT_EQ(direct({"--config", config, "--cameras", file, "--report", page}), 0) << errors_;
    std::istringstream rows(written(file));
    bool has_fixed = false;
    for (std::string row; std::getline(rows, row);) {
        ASSERT_EQ(std::ranges::count(row, ','), 10) << row;
        has_fixed = has_fixed || row.find(",fixed camera 0 near spawn point 0: ") != std::string::npos;
    }
    EXPECT_TRUE(has_fixed);
    EXPECT_THAT(written(page), HasSubstr(" s, fixed camera 0 near spawn point 0: "));
}

TEST_F(DirectCommand, RefusesADelayThatIsNoNumber) {
    for (const char* delay : {"nan", "-nan", "inf", "-1"}) {
        EXPECT_EQ(direct({"--delay", delay}), 2) << delay;
        EXPECT_THAT(errors_, HasSubstr("--delay: ")) << delay;
    }
}

TEST_F(DirectCommand, NeedsABakedMapAndAFileForEachOutput) {
    vfs_.clear();
    EXPECT_EQ(direct({}), 2);
    EXPECT_THAT(errors_, HasSubstr("FILE.vfs is required"));
    vfs_ = folder_ / "hall.vfs";
    EXPECT_EQ(direct({"--json", "figures", "--cameras", "./figures"}), 1);
    EXPECT_THAT(errors_, HasSubstr("is named for two outputs; expected a file for each"));
}

TEST_F(DirectCommand, WarnsOfABakedMapOfAnotherSource) {
    ASSERT_EQ(direct({}), 0) << errors_;
    EXPECT_THAT(errors_, HasSubstr("hall.vfs was baked from another file than"));
}

TEST_F(DirectCommand, WarnsOfAMatchOfAnotherMap) {
    ASSERT_EQ(direct({}), 0) << errors_;
    EXPECT_THAT(errors_, Not(HasSubstr("expected a match on this map")));
    write_trace(100.0);
    ASSERT_EQ(direct({}), 0) << errors_;
    EXPECT_THAT(errors_, HasSubstr("trace.csv: 0 of "));
    EXPECT_THAT(errors_, HasSubstr("hall.vfs; expected a match on this map"));
}

TEST_F(DirectCommand, RefusesAMatchThatNeverEnds) {
    const Bytes bytes = read_file(trace_).value();
    std::string text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    text += "900000000000,0,0,0,3.4,0,0,0,0,0,0,0.6,0,0,1\n";
    ASSERT_TRUE(write_file(trace_, text));
    EXPECT_EQ(direct({"--json", folder_ / "figures.json"}), 1);
    // 18 rushes have 34 figures of each beat of 0.1 s; 400 million are kept.
    EXPECT_THAT(errors_,
                HasSubstr("trace.csv: the match lasts 900000000 s with 2 players, expected at most 65359 s"));
}

}  // namespace
}  // namespace camdir
