// camera-director bake as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <thread>

#include "base/file.hpp"
#include "freespace/freespace.hpp"
#include "support/child_process.hpp"
#include "support/openarena.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

namespace fs = std::filesystem;
using test::ChildProcess;
using testing::HasSubstr;

class BakeCommand : public testing::Test {
  protected:
    static std::vector<std::string> command(std::vector<std::string> arguments) {
        arguments.insert(arguments.begin(), {CAMERA_DIRECTOR, "bake"});
        return arguments;
    }

    test::TemporaryFolder folder_;
    std::string output_ = (folder_ / "map.vfs").string();
};

TEST_F(BakeCommand, BadUsageExitsWith2) {
    const std::vector<std::vector<std::string>> wrong{
        {},
        {"map.bsp"},
        {"map.bsp", "-o", output_, "--d0", "1"},
        {"map.bsp", "-o", output_, "--d0", "much"},
        {"map.bsp", "-o", output_, "--threads", "-1"},
        {"map.bsp", "-o", output_, "--sampling", "random"},
        {"map.bsp", "-o", output_, "--no-such-option"},
        {"map.bsp", "other.bsp", "-o", output_},
        {"map.bsp", "-o", "-", "--report", "-"},
    };
    for (const auto& arguments : wrong) {
        ChildProcess process(command(arguments));
        EXPECT_EQ(process.wait(), 2) << process.errors();
        EXPECT_NE(process.errors(), "");
    }
    EXPECT_TRUE(fs::is_empty(folder_.path()));
}

TEST_F(BakeCommand, BadInputExitsWith1AndLeavesNothing) {
    const std::string text = (folder_ / "text.bsp").string();
    ASSERT_TRUE(write_file(text, std::string("no map at all")));
    for (const std::string& map :
         {text, (folder_ / "missing.bsp").string(), folder_.path().string(), std::string(":maps/a.bsp")}) {
        ChildProcess process(command({map, "-o", output_}));
        EXPECT_EQ(process.wait(), 1);
        EXPECT_THAT(process.errors(), HasSubstr(map));
        EXPECT_FALSE(fs::exists(output_));
    }
}

TEST_F(BakeCommand, TheMapMayComeAfterSeeds) {
    const std::string map = (folder_ / "missing.bsp").string();
    ChildProcess process(command({"-o", output_, "--seed", "0,0,1", "--seed", "2,0,1", map}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.errors(), HasSubstr(map + ": "));
}

TEST_F(BakeCommand, RefusesWhatNeedsMoreMemoryThanItMayHaveAndNamesTheD0ThatWouldDo) {
    const std::string map = (folder_ / "field.obj").string();
    ASSERT_TRUE(
        write_file(map, std::string("v 0 0 0\nv 200 0 0\nv 200 200 0\nv 0 200 0\nf 1 2 3\nf 1 3 4\n")));
    ChildProcess process(
        command({map, "-o", output_, "--d0", "4", "--sampling", "uniform", "--memory", "2048"}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.errors(),
                testing::AllOf(HasSubstr("This bake is expected to take about "),
                               HasSubstr("the limit is 2.1 GB; d0 = "), HasSubstr("(bake --memory)")));
    EXPECT_FALSE(fs::exists(output_));
}

TEST_F(BakeCommand, RefusesToWriteOverItsMap) {
    const std::string map = (folder_ / "room.obj").string();
    const std::string content = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    ASSERT_TRUE(write_file(map, content));
    fs::create_symlink(map, output_);
    for (const std::string& output : {map, output_}) {
        ChildProcess process(command({map, "-o", output}));
        EXPECT_EQ(process.wait(), 1);
        EXPECT_THAT(process.errors(), HasSubstr(output + ": is read, too"));
    }
    EXPECT_EQ(fs::file_size(map), content.size());
}

TEST_F(BakeCommand, RefusesOneFileForTwoOutputs) {
    const std::string map = (folder_ / "room.obj").string();
    ASSERT_TRUE(write_file(map, std::string("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")));
    const std::string same = (folder_ / "." / fs::path(output_).filename()).string();
    ChildProcess process(command({map, "-o", output_, "--report", same}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.errors(), HasSubstr(same + ": is named for two outputs"));
    EXPECT_FALSE(fs::exists(output_));
}

TEST_F(BakeCommand, RefusesAFolderThatIsNotThereBeforeItWorks) {
    const std::string nowhere = (folder_ / "no" / "map.vfs").string();
    ChildProcess process(command({"missing.bsp", "-o", nowhere}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.errors(), HasSubstr(nowhere));
    EXPECT_THAT(process.errors(), testing::Not(HasSubstr("missing.bsp")));
}

TEST_F(BakeCommand, WritesAFileAndAReportAndTheSameBytesForAnyThreads) {
    const auto map = test::openarena_map("oa_dm1");
    if (!map) GTEST_SKIP() << test::needs_openarena_map("oa_dm1");
    const std::string report = (folder_ / "report.json").string();
    ChildProcess one(command({*map, "-o", output_, "--d0", "48", "--threads", "1", "--report", report}));
    ASSERT_EQ(one.wait(), 0) << one.errors();
    EXPECT_EQ(one.output(), "");
    EXPECT_THAT(one.errors(), HasSubstr("certify"));
    EXPECT_THAT(one.errors(), HasSubstr("triangles"));

    const auto freespace = freespace::Freespace::open(output_).value();
    EXPECT_EQ(freespace.metadata().map_name, "oa_dm1");
    EXPECT_FLOAT_EQ(freespace.metadata().d0, 48.0F);
    const Bytes text = read_file(report).value();
    const auto json = nlohmann::json::parse(reinterpret_cast<const char*>(text.data()),
                                            reinterpret_cast<const char*>(text.data()) + text.size());
    EXPECT_EQ(json.at("triangles"), freespace.triangles().size());
    EXPECT_EQ(json.at("file_bytes"), fs::file_size(output_));
    EXPECT_GT(json.at("peak_memory_bytes"), 1'000'000);
    const auto& stages = json.at("stages");
    const auto pack = std::find_if(stages.begin(), stages.end(),
                                   [](const auto& stage) { return stage.at("stage") == "pack"; });
    ASSERT_NE(pack, stages.end());
    EXPECT_EQ(pack->at("counts").at("covered spawn points"), 8);

    const Bytes bytes = read_file(output_).value();
    ChildProcess two(command({*map, "-o", "-", "--d0", "48", "--threads", "2", "--quiet"}));
    ASSERT_EQ(two.wait(), 0) << two.errors();
    EXPECT_EQ(two.errors(), "") << "quiet";
    EXPECT_TRUE(two.output() == std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

TEST_F(BakeCommand, InterruptedExitsWith130AndKeepsWhatWasThere) {
    const auto map = test::openarena_map("oa_dm3");
    if (!map) GTEST_SKIP() << test::needs_openarena_map("oa_dm3");
    ASSERT_TRUE(write_file(output_, std::string("older")));
    for (const int signal : {SIGINT, SIGTERM}) {
        ChildProcess process(command({*map, "-o", output_, "--d0", "6"}));
        const auto give_up = std::chrono::steady_clock::now() + std::chrono::minutes(5);
        while (process.errors().find("sample") == std::string::npos) {
            ASSERT_LT(std::chrono::steady_clock::now(), give_up) << process.errors();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
        }
        process.send_signal(signal);
        EXPECT_EQ(process.wait_for(std::chrono::minutes(2)), 130);
        EXPECT_THAT(process.errors(), HasSubstr("interrupted"));
        EXPECT_EQ(std::distance(fs::directory_iterator(folder_.path()), fs::directory_iterator()), 1);
        EXPECT_EQ(fs::file_size(output_), 5U);
    }
}

}  // namespace
}  // namespace camdir
