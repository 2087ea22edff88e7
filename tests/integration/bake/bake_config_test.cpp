// camera-director bake --config as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "freespace/freespace.hpp"
#include "support/child_process.hpp"
#include "support/eventually.hpp"
#include "support/q3_maps.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

namespace fs = std::filesystem;
namespace q3 = scene::q3;
using nlohmann::json;
using test::ChildProcess;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Pair;
using testing::UnorderedElementsAre;

constexpr double slow_d0 = 2.0;  // of a room this takes minutes

class BakeConfig : public testing::Test {
  protected:
    void write(const std::string& name, const std::string& content) const {
        ASSERT_TRUE(write_file(folder_ / name, content));
    }

    // NAME.bsp, a room of this size, and an entry that bakes it into NAME.vfs.
    void add_room(const std::string& name, double size, double d0 = 64.0) {
        q3::Bsp bsp = test::room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(size, size, 256.0)));
        test::add_spawn_point(bsp, Vec3d(size / 2.0, size / 2.0, 40.0));
        ASSERT_TRUE(write_file(folder_ / (name + ".bsp"), test::encode(bsp)));
        entries_[name] = {{"name", name}, {"file", name + ".vfs"}, {"source", name + ".bsp"}, {"d0", d0}};
    }

    // Writes the configuration; the command that bakes it.
    std::vector<std::string> command(const std::vector<std::string>& arguments = {}) const {
        json maps = json::array();
        for (const auto& [name, entry] : entries_)
            maps.push_back(entry);
        write("config.json", json{{"maps", maps}}.dump());
        std::vector<std::string> words{CAMERA_DIRECTOR, "bake", "--config", folder_ / "config.json"};
        words.insert(words.end(), arguments.begin(), arguments.end());
        return words;
    }

    struct Ran {
        int exit_code;
        json report;
        std::string errors;

        [[nodiscard]] std::map<std::string, std::string> states() const {
            std::map<std::string, std::string> states;
            for (const json& map : report.at("maps"))
                states[map.at("map")] = map.at("state");
            return states;
        }
        [[nodiscard]] std::string reason(const std::string& name) const {
            for (const json& map : report.at("maps"))
                if (map.at("map") == name) return map.at("reason");
            return "no such map";
        }
    };
    [[nodiscard]] Ran run(std::vector<std::string> arguments = {}) const {
        arguments.insert(arguments.end(), {"--report", "-"});
        ChildProcess process(command(arguments));
        const int exit_code = process.wait();
        return {exit_code, json::parse(process.output()), process.errors()};
    }

    [[nodiscard]] std::vector<std::string> files_ending_with(const std::string& end) const {
        std::vector<std::string> names;
        for (const auto& file : fs::directory_iterator(folder_.path()))
            if (file.path().filename().string().ends_with(end)) names.push_back(file.path().filename());
        std::sort(names.begin(), names.end());
        return names;
    }

    [[nodiscard]] Bytes bytes_of(const std::string& name) const {
        return read_file(folder_ / name).value_or(Bytes{});
    }

    // A running process that bakes one map for minutes.
    [[nodiscard]] std::unique_ptr<ChildProcess> start_slow_bake() const {
        auto process = std::make_unique<ChildProcess>(command());
        EXPECT_TRUE(test::eventually([&] { return fs::exists(folder_ / "slow.vfs.part"); }))
            << process->errors();
        return process;
    }

    test::TemporaryFolder folder_;
    std::map<std::string, json> entries_;
};

TEST_F(BakeConfig, BakesOnlyWhatIsMissingOrStale) {
    add_room("a", 512.0);
    add_room("b", 768.0);
    const Ran first = run();
    EXPECT_EQ(first.exit_code, 0) << first.errors;
    EXPECT_THAT(first.states(), UnorderedElementsAre(Pair("a", "baked"), Pair("b", "baked")));
    EXPECT_THAT(first.reason("a"), HasSubstr("a.vfs was not there"));
    const Bytes a = bytes_of("a.vfs");

    const auto states = [&] { return run().states(); };
    EXPECT_THAT(states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "fresh")));
    entries_["b"]["d0"] = 48;
    const Ran parameter = run();
    EXPECT_THAT(parameter.states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "baked")));
    EXPECT_EQ(parameter.reason("b"), "it was baked with d0 64 instead of 48");
    entries_["b"]["loss"] = 5;
    EXPECT_THAT(states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "baked")));
    entries_["b"]["triangles"] = 1000;
    EXPECT_THAT(states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "baked")));
    add_room("b", 640.0);
    const Ran source = run();
    EXPECT_THAT(source.states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "baked")));
    EXPECT_THAT(source.reason("b"),
                AllOf(HasSubstr("it was baked from other bytes ("), HasSubstr("b.bsp has")));
    EXPECT_THAT(states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "fresh")));

    write("b.vfs", "damaged");
    EXPECT_THAT(states(), UnorderedElementsAre(Pair("a", "fresh"), Pair("b", "baked")));
    Bytes flipped = bytes_of("a.vfs");
    flipped[flipped.size() / 2] ^= std::byte{1};
    ASSERT_TRUE(write_file(folder_ / "a.vfs", flipped));
    EXPECT_THAT(states(), UnorderedElementsAre(Pair("a", "baked"), Pair("b", "fresh")));
    EXPECT_EQ(bytes_of("a.vfs"), a);
    EXPECT_THAT(run({"--force"}).states(), UnorderedElementsAre(Pair("a", "baked"), Pair("b", "baked")));
    EXPECT_THAT(files_ending_with(".vfs"), ElementsAre("a.vfs", "b.vfs"));
    EXPECT_THAT(files_ending_with(".part"), ElementsAre());
}

TEST_F(BakeConfig, TellsWhatAFileOfAnotherMapWasBakedFrom) {
    add_room("a", 512.0);
    add_room("b", 768.0);
    ASSERT_EQ(run().exit_code, 0);
    entries_.erase("b");
    entries_["a"]["file"] = "b.vfs";
    EXPECT_THAT(run().reason("a"),
                testing::MatchesRegex("it was baked from other bytes \\(.*b\\.bsp\\) than .*a\\.bsp has"));
}

TEST_F(BakeConfig, NamesAFileThatCannotBeReached) {
    add_room("a", 512.0);
    fs::create_symlink("a.vfs", folder_ / "a.vfs");
    const Ran ran = run();
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.reason("a"), AllOf(HasSubstr("a.vfs: cannot open: "), testing::Not(HasSubstr("a.bsp"))));
}

TEST_F(BakeConfig, OneThatFailsDoesNotStopTheOthers) {
    add_room("good", 512.0);
    write("text.bsp", "no map at all");
    entries_["text"] = {{"name", "text"}, {"file", "text.vfs"}, {"source", "text.bsp"}};
    entries_["nowhere"] = {{"name", "nowhere"}, {"file", "nowhere.vfs"}, {"source", "nowhere.bsp"}};
    entries_["bare"] = {{"name", "bare"}, {"file", "bare.vfs"}};
    q3::Bsp empty = test::empty_map();
    test::add_spawn_point(empty, Vec3d(0.0, 0.0, 40.0));
    ASSERT_TRUE(write_file(folder_ / "empty.bsp", test::encode(empty)));
    entries_["empty"] = {{"name", "empty"}, {"file", "empty.vfs"}, {"source", "empty.bsp"}};

    const Ran ran = run();
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.states(), UnorderedElementsAre(Pair("good", "baked"), Pair("text", "failed"),
                                                   Pair("nowhere", "failed"), Pair("empty", "failed")));
    EXPECT_THAT(ran.reason("text"), HasSubstr("unknown format"));
    EXPECT_THAT(ran.reason("nowhere"), HasSubstr("nowhere.bsp: cannot open"));
    EXPECT_THAT(ran.reason("empty"), HasSubstr("empty.bsp"));
    EXPECT_THAT(ran.errors, AllOf(HasSubstr("text: failed: "), HasSubstr("good: baked in ")));
    EXPECT_THAT(files_ending_with(".vfs"), ElementsAre("good.vfs"));
    EXPECT_THAT(files_ending_with(".part"), ElementsAre());
}

TEST_F(BakeConfig, UsesAFileWhoseSourceIsGone) {
    add_room("a", 512.0);
    ASSERT_EQ(run().exit_code, 0);
    fs::remove(folder_ / "a.bsp");
    const Ran ran = run();
    EXPECT_EQ(ran.exit_code, 0);
    EXPECT_THAT(ran.states(), ElementsAre(Pair("a", "fresh")));
    EXPECT_THAT(ran.reason("a"), HasSubstr("is used as it is"));
}

TEST_F(BakeConfig, WritesWhatTheSingleBakeWritesForAnyThreadsAndMemory) {
    add_room("a", 1024.0, 48.0);
    add_room("b", 896.0, 48.0);
    add_room("c", 512.0, 48.0);
    const std::string single = folder_ / "single";
    ChildProcess process({CAMERA_DIRECTOR, "bake", folder_ / "a.bsp", "-o", single, "--d0", "48"});
    ASSERT_EQ(process.wait(), 0) << process.errors();
    std::vector<Bytes> seen;
    const std::vector<std::vector<std::string>> ways{
        {"--threads", "1"}, {"--threads", "2"}, {"--memory", "64"}, {}};
    for (std::vector<std::string> way : ways) {
        way.emplace_back("--force");
        const Ran ran = run(way);
        ASSERT_EQ(ran.exit_code, 0) << ran.errors;
        EXPECT_EQ(bytes_of("a.vfs"), bytes_of("single"));
        seen.push_back(bytes_of("b.vfs"));
        EXPECT_EQ(seen.back(), seen.front());
    }
}

TEST_F(BakeConfig, ReportsWhatTheFilesHold) {
    add_room("a", 512.0);
    const Ran ran = run({"--memory", "123"});
    EXPECT_EQ(ran.report.at("memory_budget_bytes"), 123U << 20U);
    EXPECT_GT(ran.report.at("peak_memory_bytes"), 1'000'000);
    const json& map = ran.report.at("maps").at(0);
    const auto freespace = freespace::Freespace::open(folder_ / "a.vfs").value();
    EXPECT_EQ(map.at("triangles"), freespace.triangles().size());
    EXPECT_EQ(map.at("file_bytes"), fs::file_size(folder_ / "a.vfs"));
    EXPECT_GT(map.at("samples"), 100);
    EXPECT_EQ(map.at("bake").at("triangles"), map.at("triangles"));
    EXPECT_EQ(map.at("bake").at("parameters").at("d0"), 64.0);
    const Ran again = run({"--quiet"});
    EXPECT_EQ(again.errors, "");
    EXPECT_EQ(again.report.at("maps").at(0).at("samples"), map.at("samples"));
    EXPECT_FALSE(again.report.at("maps").at(0).contains("bake"));
}

TEST_F(BakeConfig, KilledLeavesNothingThatIsTakenForAFileAndGoesOnLater) {
    add_room("quick", 512.0);
    ASSERT_EQ(run().exit_code, 0);
    const Bytes quick = bytes_of("quick.vfs");
    add_room("slow", 2048.0, slow_d0);
    const auto process = start_slow_bake();
    process->send_signal(SIGKILL);
    EXPECT_EQ(process->wait(), -SIGKILL);
    EXPECT_THAT(files_ending_with(".vfs"), ElementsAre("quick.vfs"));

    entries_["slow"]["d0"] = 64;
    const Ran resumed = run();
    EXPECT_EQ(resumed.exit_code, 0) << resumed.errors;
    EXPECT_THAT(resumed.states(), UnorderedElementsAre(Pair("quick", "fresh"), Pair("slow", "baked")));
    EXPECT_EQ(bytes_of("quick.vfs"), quick);
    EXPECT_THAT(files_ending_with(".part"), ElementsAre());
}

TEST_F(BakeConfig, InterruptedExitsWith130AndKeepsWhatWasThere) {
    add_room("quick", 512.0);
    ASSERT_EQ(run().exit_code, 0);
    add_room("slow", 2048.0, slow_d0);
    write("slow.vfs", "older");
    for (const int signal : {SIGINT, SIGTERM}) {
        const auto process = start_slow_bake();
        process->send_signal(signal);
        EXPECT_EQ(process->wait_for(test::patience), 130);
        EXPECT_THAT(process->errors(), AllOf(HasSubstr("slow: interrupted"), HasSubstr("quick: fresh")));
        EXPECT_EQ(bytes_of("slow.vfs").size(), 5U);
        EXPECT_THAT(files_ending_with(".part"), ElementsAre());
    }
}

TEST_F(BakeConfig, TwoProcessesShareTheWork) {
    for (const char* name : {"a", "b", "c", "d"})
        add_room(name, 512.0);
    const auto words = command({"--report", "-"});
    ChildProcess one(words);
    ChildProcess two(words);
    EXPECT_EQ(one.wait(), 0) << one.errors();
    EXPECT_EQ(two.wait(), 0) << two.errors();
    std::map<std::string, int> times_baked;
    for (const std::string& output : {one.output(), two.output()}) {
        const json report = json::parse(output);
        for (const json& map : report.at("maps"))
            times_baked[map.at("map")] += map.at("state") == "baked" ? 1 : 0;
    }
    EXPECT_THAT(times_baked, UnorderedElementsAre(Pair("a", 1), Pair("b", 1), Pair("c", 1), Pair("d", 1)));
    EXPECT_EQ(run().exit_code, 0);
    EXPECT_THAT(files_ending_with(".part"), ElementsAre());
}

TEST_F(BakeConfig, BadUsageExitsWith2) {
    add_room("a", 512.0);
    const std::string config = folder_ / "config.json";
    command();
    const std::vector<std::vector<std::string>> wrong{
        {"--config"},
        {"--config", config, "a.bsp"},
        {"--config", config, "-o", "a.vfs"},
        {"--config", config, "--d0", "32"},
        {"--config", config, "--loss", "3"},
        {"--config", config, "--memory", "-1"},
        {"--config", config, "--memory", "lots"},
        {"a.bsp", "-o", "a.vfs", "--force"},
    };
    for (std::vector<std::string> arguments : wrong) {
        arguments.insert(arguments.begin(), {CAMERA_DIRECTOR, "bake"});
        ChildProcess process(arguments);
        EXPECT_EQ(process.wait(), 2) << process.errors();
        EXPECT_NE(process.errors(), "");
    }
    EXPECT_THAT(files_ending_with(".vfs"), ElementsAre());
}

TEST_F(BakeConfig, ABadConfigurationIsRefusedWithItsPlace) {
    write("bad.json", R"({"maps": [{"name": "a", "file": "a.vfs", "source": "a.bsp", "d0": 1}]})");
    const std::string missing = folder_ / "missing.json";
    const std::map<std::string, std::string> wrong{{folder_ / "bad.json", "/maps/0/d0"}, {missing, missing}};
    for (const auto& [file, place] : wrong) {
        ChildProcess process({CAMERA_DIRECTOR, "bake", "--config", file});
        EXPECT_EQ(process.wait(), 1);
        EXPECT_THAT(process.errors(), HasSubstr(place));
    }
    write("none.json", "{}");
    ChildProcess nothing({CAMERA_DIRECTOR, "bake", "--config", folder_ / "none.json"});
    EXPECT_EQ(nothing.wait(), 0);
    EXPECT_THAT(nothing.errors(), HasSubstr("no map has a source"));
}

}  // namespace
}  // namespace camdir
