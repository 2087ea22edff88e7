// The module as an engine sees it.
#include "proxy.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <malloc.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <regex>
#include <thread>

#include "engine.h"
#include "fake_engine.hpp"
#include "game.h"
#include "roster.h"
#include "support/eventually.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_domain.hpp"
#include "unpacked.hpp"

namespace camdir::openarena {
namespace {

using test::FakeEngine;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(OpenArenaProxy, ForwardsEveryCallWithItsArguments) {
    FakeEngine engine;
    engine.start_map("oa_dm1");
    for (const int command : {int{GAME_CLIENT_THINK}, int{GAME_RUN_BOTS}, 77}) {
        auto digest = static_cast<std::uint32_t>(command);
        for (std::uint32_t argument = 1; argument <= 12; ++argument) {
            digest = 31 * digest + argument;
        }
        EXPECT_EQ(vmMain(command, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12), digest) << command;
    }
    EXPECT_EQ(FakeEngine::call(700), 0x123456789abcdef) << "the game's call of the engine";
    engine.command = {"say", "hello"};
    FakeEngine::call(GAME_CLIENT_COMMAND, 4);
    EXPECT_THAT(engine.prints, ElementsAre("client 4: say hello"));
    EXPECT_EQ(engine.configstrings[CONFIGSTRING_PLAYERS], "n\\Bot0\\t\\0\\model\\sarge");
}

TEST(OpenArenaProxy, SamplesEveryFrame) {
    FakeEngine engine;
    engine.start_map("oa_dm1");
    const std::uint64_t before = module_counters()->frames;
    engine.run_frames(100);
    EXPECT_EQ(module_counters()->frames, before + 100);
    EXPECT_EQ(module_counters()->timed_frames, 100U);
    EXPECT_STREQ(module_map(), "oa_dm1");
}

TEST(OpenArenaProxy, CommandsOfItsOwnReachTheGameAlone) {
    FakeEngine engine;
    engine.start_map("oa_dm1");
    engine.command = {"say", "hello"};
    const char* const words[] = {"follow", "3"};
    game_client_command(9, words, 2);
    FakeEngine::call(GAME_CLIENT_COMMAND, 4);
    EXPECT_THAT(engine.prints, ElementsAre("client 9: follow 3", "client 4: say hello"));
}

TEST(OpenArenaProxy, AClientThatIsDroppedWithinAFrameLeaves) {
    FakeEngine engine;
    engine.start_map("oa_dm1");
    engine.run_frames(1);
    EXPECT_TRUE(roster_at(3)->in_use);
    engine.cvars["fake_drop"] = "3";
    engine.run_frames(2);
    EXPECT_FALSE(roster_at(3)->in_use);
    EXPECT_TRUE(roster_at(4)->in_use);
}

struct Resources {
    std::ptrdiff_t descriptors, threads;
    std::size_t heap;

    static Resources used() {
        const auto entries = [](const char* folder) {
            const std::filesystem::directory_iterator all(folder);
            return std::distance(begin(all), end(all));
        };
        return {entries("/proc/self/fd"), entries("/proc/self/task"), mallinfo2().uordblks};
    }
};

TEST(OpenArenaProxy, AHundredMapsLeaveNothingBehind) {
    const test::TestDomain domain;
    FakeEngine engine;
    engine.cvars["director_enable"] = "1";
    engine.cvars["director_domain"] = std::to_string(domain.id());
    engine.start_map("oa_dm1");
    for (const int spectator : {8, 9})
        engine.connect(spectator);
    const auto published_anew = [&](std::uint64_t before) {
        engine.run_frames(1);
        return module_report() != nullptr && module_report()->epoch > before;
    };
    const auto change_map = [&](const char* map) {
        const std::uint64_t before = module_report()->epoch;
        engine.start_map(map);
        return test::eventually([&] { return published_anew(before); });
    };
    ASSERT_TRUE(test::eventually([&] { return published_anew(0); }));
    for (int i = 0; i < 10; ++i) {
        ASSERT_TRUE(change_map("oa_dm3"));
    }
    const Resources before = Resources::used();
    const std::uint32_t life = module_life();
    for (int i = 0; i < 100; ++i) {
        ASSERT_TRUE(change_map(i % 2 == 0 ? "oa_dm2" : "oa_dm1"));
    }
    const Resources after = Resources::used();
    EXPECT_EQ(module_life(), life + 100);
    EXPECT_EQ(after.descriptors, before.descriptors);
    EXPECT_EQ(after.threads, before.threads);
    EXPECT_LT(after.heap, before.heap + 100'000) << "1 kB a map";
    EXPECT_THAT(engine.errors, IsEmpty());
    engine.cvars["director_enable"] = "0";
}

// Enabled or not, the thread is there before the frames.
TEST(OpenArenaProxy, NoFrameStartsTheThread) {
    FakeEngine engine;
    engine.start_map("oa_dm1");
    const std::ptrdiff_t threads = Resources::used().threads;
    EXPECT_GE(threads, 2);
    engine.cvars["director_interface"] = "no-such-interface";
    engine.cvars["director_enable"] = "1";
    engine.run_frames(30);
    EXPECT_EQ(Resources::used().threads, threads);
    engine.cvars["director_enable"] = "0";
}

class OpenArenaRefusal : public testing::Test {
  protected:
    // Starts a map, and ends it as an engine does after an error.
    std::string refusal() {
        engine.errors.clear();
        engine.start_map("oa_dm1");
        EXPECT_FALSE(game_is_loaded());
        engine.run_frames(1);
        engine.end_map();
        return engine.errors.empty() ? "no error" : engine.errors.front();
    }

    FakeEngine engine;
    test::TemporaryFolder folder;
};

TEST_F(OpenArenaRefusal, AMissingGameModuleIsNamedWithWhatToDo) {
    engine.cvars["director_game"] = "/nonexistent/qagamex86_64.so";
    EXPECT_THAT(refusal(), AllOf(HasSubstr("/nonexistent/qagamex86_64.so"), HasSubstr("set director_game")));
}

TEST_F(OpenArenaRefusal, AGameInQvmIsRefused) {
    engine.cvars["director_game"] = "/usr/share/vm/qagame.qvm";
    EXPECT_THAT(refusal(), AllOf(HasSubstr("QVM"), HasSubstr("set director_game")));
}

TEST_F(OpenArenaRefusal, AModWithoutANativeModuleIsNotReplacedByTheBaseGame) {
    engine.cvars["director_game"] = "";
    engine.cvars["fs_basepath"] = folder.path();
    engine.cvars["fs_game"] = "mymod";
    EXPECT_THAT(refusal(), AllOf(HasSubstr("'mymod'"), HasSubstr("QVM"), HasSubstr("set director_game")));
}

TEST_F(OpenArenaRefusal, ALibraryThatIsNoGameIsRefused) {
    engine.cvars["director_game"] = "libm.so.6";
    EXPECT_THAT(refusal(), HasSubstr("is no game module"));
    const auto junk = folder / "junk.so";
    std::ofstream(junk) << "junk";
    engine.cvars["director_game"] = junk;
    EXPECT_THAT(refusal(), HasSubstr("junk.so"));
}

TEST_F(OpenArenaRefusal, ThisModuleItselfIsRefused) {
    engine.cvars["director_game"] = "/proc/self/exe";
    EXPECT_THAT(refusal(), HasSubstr("this module itself"));
}

TEST_F(OpenArenaRefusal, TheNextMapMayBeRightAgain) {
    const std::string game = engine.cvars["director_game"];
    engine.cvars["director_game"] = "/nonexistent";
    (void)refusal();
    engine.cvars["director_game"] = game;
    engine.start_map("oa_dm1");
    EXPECT_TRUE(game_is_loaded());
}

TEST(OpenArenaProxy, TheGameOfTheBasePathIsFound) {
    test::TemporaryFolder base;
    FakeEngine engine;
    std::filesystem::create_directory(base / "mymod");
    std::filesystem::copy_file(engine.cvars["director_game"], base / "mymod/qagamex86_64.so");
    engine.cvars["director_game"] = "";
    engine.cvars["fs_basepath"] = base.path();
    engine.cvars["fs_game"] = "mymod";
    engine.start_map("oa_dm1");
    EXPECT_EQ(game_path(), base / "mymod/qagamex86_64.so");
}

// A second copy in the same process leaves all to the first.
TEST(OpenArenaProxy, ASecondCopyOnlyForwards) {
    FakeEngine engine;
    engine.cvars["director_module"] = "another";
    const std::uint64_t before = module_counters()->frames;
    engine.start_map("oa_dm1");
    engine.run_frames(5);
    EXPECT_EQ(module_counters()->frames, before);
    EXPECT_NE(FakeEngine::call(GAME_CLIENT_THINK, 0, 5), FakeEngine::call(GAME_CLIENT_THINK, 0, 6));
    EXPECT_THAT(engine.prints, ElementsAre(HasSubstr("loaded twice")));
    engine.end_map();
    EXPECT_EQ(engine.cvars["director_module"], "another");
    engine.cvars["director_module"] = "";
}

// A match that is recorded and cannot be published.
class OpenArenaUnpublished : public testing::Test {
  protected:
    OpenArenaUnpublished() {
        engine.cvars["director_enable"] = "1";
        engine.cvars["director_interface"] = "no-such-interface";
        engine.cvars["director_record"] = (folder / "m").string();
        engine.start_map("oa_dm1");
    }
    ~OpenArenaUnpublished() override { engine.cvars["director_enable"] = "0"; }

    test::TemporaryFolder folder;
    FakeEngine engine;
};

// The worker falls behind, while a game that never pauses kills a player in every frame.
TEST_F(OpenArenaUnpublished, EventsOfAFrameThatWasDroppedGoWithTheNext) {
    const auto dropped = [] { return module_counters()->dropped; };
    const std::uint64_t dropped_before = dropped();
    std::ptrdiff_t kills = 0;
    write_int(engine.entity(100), ENTITY_TYPE, ENTITY_TYPE_OBITUARY);
    write_int(engine.entity(100), ENTITY_OTHER2, 1);
    while (dropped() == dropped_before && kills < 1'000'000) {
        write_int(engine.entity(100), ENTITY_EVENT_PARAMETER, static_cast<std::int32_t>(1 + kills % 2));
        engine.run_frames(1);
        ++kills;
    }
    ASSERT_GT(dropped(), dropped_before);
    ASSERT_TRUE(test::eventually([&] {
        const std::uint64_t before = dropped();
        engine.run_frames(1);
        return dropped() == before;
    }));
    engine.end_map();
    std::ptrdiff_t recorded = 0;
    EXPECT_TRUE(test::eventually([&] {
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            if (!entry.path().string().ends_with("-events.csv.gz")) continue;
            const std::string text = test::unpacked(entry.path());
            const std::regex kill(",kill,");
            recorded = std::distance(std::sregex_iterator(text.begin(), text.end(), kill), {});
            return true;
        }
        return false;
    }));
    EXPECT_EQ(recorded, kills);
}

// The reason is told, and the game goes on.
TEST_F(OpenArenaUnpublished, IsRecorded) {
    const auto frames_are_recorded = [&] {
        engine.run_frames(1);
        const director_report* report = module_report();
        return report != nullptr && report->error[0] != '\0' && report->recorded_rows > 0;
    };
    ASSERT_TRUE(test::eventually(frames_are_recorded));
    EXPECT_EQ(module_report()->epoch, 0U);
    EXPECT_EQ(module_report()->directors, 0U);
    engine.end_map();
    EXPECT_TRUE(test::eventually([&] {
        int complete = 0;
        for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
            if (entry.path().extension() != ".part") ++complete;
        }
        return complete == 4;
    }));
}

}  // namespace
}  // namespace camdir::openarena
