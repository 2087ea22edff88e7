// Matches that are recorded as a director shows them.
#include <gmock/gmock.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <thread>
#include <vector>

#include "recording/reader.hpp"
#include "recording/recorder.hpp"
#include "support/eventually.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::recording {
namespace {

namespace fs = std::filesystem;
using director::CameraFrame;
using director::MatchEvent;
using director::MatchInfo;
using director::ObserverRequest;
using director::PoseFrame;
using ::testing::ElementsAre;
using ::testing::MatchesRegex;

RecorderOptions options(const fs::path& folder) {
    RecorderOptions options;
    options.folder = folder;
    options.max_bytes = 1ULL << 40;
    options.max_match_bytes = 1ULL << 40;
    options.fragment_duration = 1'000'000;
    options.director_version = "test";
    return options;
}

MatchInfo info(const std::string& match_id, std::uint64_t epoch = 1) {
    MatchInfo info;
    info.match_id = match_id;
    info.epoch = epoch;
    info.map_name = "square";
    return info;
}

void show_frame(Recorder& recorder, const std::string& match_id, std::uint32_t number) {
    PoseFrame poses{1, number, number * 16'000'000LL, 0, {}};
    for (std::uint32_t id = 0; id < 4; ++id)
        poses.poses.push_back(
            {id, Vec3f(1.0F, static_cast<float>(number), 2.0F), Quatf::Identity(), Vec3f::Zero(), 1, {}});
    recorder.show(match_id, poses, CameraFrame{1, number, number, poses.frame_time, 0, {}, {}});
}

// Oldest first.
std::vector<std::string> names_in(const fs::path& folder) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
        names.push_back(entry.path().filename().string());
    std::sort(names.begin(), names.end());
    return names;
}

std::vector<Record> records_in(const fs::path& folder) {
    const auto reader = Reader::open(folder);
    EXPECT_TRUE(reader) << reader.error().message;
    std::vector<Record> records;
    if (reader) {
        EXPECT_TRUE(reader->replay(0, [&](const Record& record) { records.push_back(record); }).empty());
    }
    return records;
}

std::string kinds(const std::vector<Record>& records) {
    constexpr std::string_view letters = "IPERWCDM";  // the last: movers described, and moved
    static_assert(letters.size() == std::variant_size_v<Message>);
    std::string kinds;
    for (const Record& record : records)
        kinds += letters[record.message.index()];
    return kinds;
}

TEST(Recorder, HasWhatWasShownInItsOrder) {
    const test::TemporaryFolder folder;
    {
        Recorder recorder(options(folder / "r"));
        recorder.request(ObserverRequest{"m", "early", 1, {}, "", ""});
        recorder.request(ObserverRequest{"m", "gone", 1, {}, "", ""});
        recorder.request_ended("m", "gone");
        recorder.show(info("m"));
        show_frame(recorder, "m", 1);
        recorder.show("m", MatchEvent{1, 2, 3, 4, 5, 6.0F, "axe"});
        recorder.request_ended("m", "early");
        recorder.show(info("m", 2));
        recorder.end("m");
        recorder.show("m", MatchEvent{1, 2, 3, 4, 5, 6.0F, "after the end"});
    }
    const auto names = names_in(folder / "r");
    ASSERT_THAT(names, ElementsAre(MatchesRegex("20[0-9]{6}T[0-9]{6}\\.[0-9]{3}Z-[0-9a-f]{8}-m")));
    const auto records = records_in(folder / "r" / names[0]);
    EXPECT_EQ(kinds(records), "RIPCEWI");
    EXPECT_EQ(std::get<ObserverRequest>(records[0].message).observer_id, "early");
    EXPECT_EQ(std::get<MatchEvent>(records[4].message).detail, "axe");
    EXPECT_EQ(Reader::open(folder / "r" / names[0])->start().director_version, "test");
}

TEST(Recorder, EveryMatchHasAFolderInsideTheArchive) {
    const test::TemporaryFolder folder;
    const std::vector<std::string> ids = {"../../up", "/etc",     ".",    "..", std::string("a\0b", 3),
                                          "a\nb",     "\xff\xfe", "a%2Fb"};
    {
        Recorder recorder(options(folder / "r"));
        for (const std::string& id : ids)
            recorder.show(info(id));
    }
    EXPECT_THAT(names_in(folder / ""), ElementsAre("r"));
    std::vector<std::string> found;
    for (const std::string& name : names_in(folder / "r")) {
        EXPECT_THAT(name, MatchesRegex("[0-9TZ.a-f-]+-[A-Za-z0-9_%]*"));
        found.push_back(Reader::open(folder / "r" / name)->start().match.match_id);
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(ids));
}

TEST(Recorder, ANewLifeOfAMatchIsANewRecording) {
    const test::TemporaryFolder folder;
    Recorder recorder(options(folder / "r"));
    recorder.show(info("m"));
    recorder.request(ObserverRequest{"m", "stays", 1, {}, "", ""});
    recorder.end("m");
    recorder.show(info("m"));
    recorder.end("m");
    recorder.wait_until_written();
    EXPECT_EQ(recorder.statistics().running, 0U);
    const auto names = names_in(folder / "r");
    ASSERT_EQ(names.size(), 2U);
    std::vector<std::string> both = {kinds(records_in(folder / "r" / names[0])),
                                     kinds(records_in(folder / "r" / names[1]))};
    EXPECT_THAT(both, testing::UnorderedElementsAre("IR", "RI"));
}

TEST(Recorder, AFragmentIsCompleteThoughTheMatchPauses) {
    const test::TemporaryFolder folder;
    Recorder recorder(options(folder / "r"));
    recorder.show(info("m"));
    EXPECT_TRUE(test::eventually([&] { return recorder.statistics().fragments == 1; }));
    EXPECT_EQ(kinds(records_in(folder / "r" / names_in(folder / "r")[0])), "I");
}

TEST(Recorder, ViewersLearnOfCompleteFragments) {
    const test::TemporaryFolder folder;
    Recorder recorder(options(folder / "r"));
    EXPECT_FALSE(recorder.broadcast().get("/m/sync"));
    recorder.show(info("m"));
    EXPECT_TRUE(test::eventually([&] { return recorder.broadcast().get("/m/sync").has_value(); }));
    const auto sync = [&] { return nlohmann::json::parse(recorder.broadcast().get("/m/sync")->content); };
    const std::string id = sync()["recording"];
    EXPECT_TRUE(recorder.broadcast().get("/m/" + id + "/0/full"));
    EXPECT_TRUE(recorder.broadcast().get("/m/" + id + "/0/delta"));
    EXPECT_FALSE(recorder.broadcast().get("/m/" + id + "/1/full"));
    EXPECT_EQ(sync()["live"], true);
    show_frame(recorder, "m", 1);
    recorder.end("m");
    recorder.wait_until_written();
    EXPECT_EQ(sync()["last_fragment"], 1);
    EXPECT_EQ(sync()["live"], false);
    recorder.show(info("m"));
    EXPECT_TRUE(test::eventually([&] { return sync()["recording"] != id; }));
    EXPECT_FALSE(recorder.broadcast().get("/m/" + id + "/0/full"));
}

TEST(Recorder, TheBoundRemovesEndedRecordingsAndThenFragments) {
    const test::TemporaryFolder folder;
    RecorderOptions bounded = options(folder / "r");
    bounded.max_bytes = 200'000;
    Recorder recorder(bounded);
    for (const char* id : {"first", "second"}) {
        recorder.show(info(id));
        recorder.end(id);
        recorder.wait_until_written();
    }
    ASSERT_EQ(names_in(folder / "r").size(), 2U);
    recorder.show(info("long"));
    for (std::uint32_t number = 0; recorder.statistics().fragments < 25; ++number) {
        show_frame(recorder, "long", number);
        recorder.wait_until_written();
        ASSERT_LE(recorder.statistics().bytes, 200'000U);
    }
    ASSERT_TRUE(test::eventually([&] { return names_in(folder / "r").size() == 1; }));
    const auto reader = Reader::open(folder / "r" / names_in(folder / "r")[0]);
    EXPECT_GT(reader->first_fragment(), 0U);
    EXPECT_GT(reader->last_fragment(), reader->first_fragment() + 5);
    EXPECT_TRUE(reader->full(reader->first_fragment())->info);
}

TEST(Recorder, TheBoundCountsWhatEarlierRunsLeft) {
    const test::TemporaryFolder folder;
    for (const char* id : {"old", "new"}) {
        std::this_thread::sleep_for(std::chrono::milliseconds(2));  // which the order of their names tells
        Recorder recorder(options(folder / "r"));
        recorder.show(info(id));
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
    // Whatever stands beside them is left alone.
    for (const char* name : {"0 not a recording", "20200101T000000.000Z-00000000-copy"}) {
        fs::create_directory(folder / "r" / name);
        std::ofstream(folder / "r" / name / "start") << "x";
        std::ofstream(folder / "r" / name / "file") << std::string(100'000, 'x');
    }
    RecorderOptions bounded = options(folder / "r");
    bounded.max_bytes = 60'000;  // a recording of one fragment takes 6 blocks
    Recorder recorder(bounded);
    recorder.show(info("now"));
    recorder.end("now");
    const auto expected = ElementsAre("0 not a recording", testing::EndsWith("-copy"),
                                      testing::EndsWith("-new"), testing::EndsWith("-now"));
    EXPECT_TRUE(test::eventually([&] { return testing::Value(names_in(folder / "r"), expected); }));
}

// Its name tells when it began by a clock that was not set yet.
TEST(Recorder, TheBoundRemovesFirstWhatEndedFirst) {
    const test::TemporaryFolder folder;
    {
        Recorder recorder(options(folder / "r"));
        for (const char* id : {"old", "new"}) {
            recorder.show(info(id));
            recorder.end(id);
            recorder.wait_until_written();
        }
    }
    const auto is_new = [](const std::string& name) { return name.ends_with("-new"); };
    const auto names = names_in(folder / "r");
    const auto newest = std::ranges::find_if(names, is_new);
    ASSERT_NE(newest, names.end());
    fs::rename(folder / "r" / *newest, folder / "r" / "19700101T000000.000Z-00000000-new");
    for (const auto& entry : fs::recursive_directory_iterator(folder / "r"))
        if (entry.path().string().find("-old") != std::string::npos && entry.is_regular_file())
            fs::last_write_time(entry, fs::file_time_type::clock::now() - std::chrono::hours(24));
    RecorderOptions bounded = options(folder / "r");
    bounded.max_bytes = 60'000;
    Recorder recorder(bounded);
    recorder.show(info("now"));
    recorder.end("now");
    const auto expected = ElementsAre(testing::EndsWith("-new"), testing::EndsWith("-now"));
    EXPECT_TRUE(test::eventually([&] { return testing::Value(names_in(folder / "r"), expected); }));
}

TEST(Recorder, WhatSomebodyHasMovedAwayCountsNoMore) {
    const test::TemporaryFolder folder;
    RecorderOptions bounded = options(folder / "r");
    bounded.max_bytes = 110'000;  // a recording of one fragment takes 6 blocks: four of them, but not five
    Recorder recorder(bounded);
    const auto record = [&](const char* id) {
        recorder.show(info(id));
        recorder.end(id);
        recorder.wait_until_written();
    };
    for (const char* id : {"final", "b", "c", "d"})
        record(id);
    ASSERT_EQ(names_in(folder / "r").size(), 4U);
    for (const std::string& name : names_in(folder / "r"))
        if (!name.ends_with("-final")) fs::remove_all(folder / "r" / name);
    for (const char* id : {"e", "f"})
        record(id);
    EXPECT_THAT(names_in(folder / "r"),
                testing::UnorderedElementsAre(testing::EndsWith("-final"), testing::EndsWith("-e"),
                                              testing::EndsWith("-f")));
    EXPECT_LT(recorder.statistics().bytes, 110'000U);
}

// As a process leaves it that is killed while it removes a recording.
TEST(Recorder, WhatWasBeingRemovedIsRemovedByTheNextRecorder) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "r" / ".removed-20261126T120000.000Z-00000000-m" / "3");
    std::ofstream(folder / "r" / ".removed-20261126T120000.000Z-00000000-m" / "3" / "full") << "x";
    Recorder recorder(options(folder / "r"));
    recorder.show(info("m"));
    EXPECT_TRUE(test::eventually([&] {
        const auto names = names_in(folder / "r");
        return names.size() == 1 && names[0].ends_with("-m");
    }));
}

TEST(Recorder, WhatALinkNamesIsNotRemoved) {
    const test::TemporaryFolder folder;
    fs::create_directories(folder / "r");
    fs::create_directories(folder / "precious");
    std::ofstream(folder / "precious" / "file") << "x";
    fs::create_directory_symlink(folder / "precious",
                                 folder / "r" / ".removed-20261126T120000.000Z-00000000-m");
    fs::create_directories(folder / "r" / ".removed-20261126T120001.000Z-00000000-m");
    Recorder recorder(options(folder / "r"));
    EXPECT_TRUE(test::eventually([&] { return names_in(folder / "r").size() == 1; }));
    EXPECT_TRUE(fs::exists(folder / "precious" / "file"));
}

TEST(Recorder, AFolderThatWasRemovedIsLockedAnew) {
    const test::TemporaryFolder folder;
    Recorder first(options(folder / "r"));
    first.show(info("m"));
    first.wait_until_written();
    fs::remove_all(folder / "r");
    first.show(info("n"));
    first.wait_until_written();
    Recorder second(options(folder / "r"));
    second.show(info("o"));
    second.wait_until_written();
    EXPECT_EQ(second.statistics().failures, 1U) << "the first has it";
}

TEST(Recorder, ViewersAreNotToldOfARemovedRecording) {
    const test::TemporaryFolder folder;
    RecorderOptions bounded = options(folder / "r");
    bounded.max_bytes = 60'000;  // a recording of one fragment takes 6 blocks
    Recorder recorder(bounded);
    for (const char* id : {"first", "second", "third"}) {
        recorder.show(info(id));
        recorder.end(id);
        recorder.wait_until_written();
    }
    EXPECT_FALSE(recorder.broadcast().get("/first/sync"));
    EXPECT_TRUE(recorder.broadcast().get("/third/sync"));
}

TEST(Recorder, ViewersAreNeverToldOfAFragmentThatIsGone) {
    const test::TemporaryFolder folder;
    RecorderOptions bounded = options(folder / "r");
    bounded.max_match_bytes = 40'000;
    Recorder recorder(bounded);
    recorder.show(info("m"));
    std::uint32_t number = 0;
    EXPECT_TRUE(test::eventually([&] {
        show_frame(recorder, "m", ++number);
        const auto told = recorder.broadcast().get("/m/sync");
        if (!told) return false;
        const auto sync = nlohmann::json::parse(told->content);
        const std::uint32_t first = sync["first_fragment"];
        // Right after it was told, whatever the recorder does meanwhile; a cache may still tell it a second
        // later.
        const std::string path =
            "/" + sync["recording"].get<std::string>() + "/" + std::to_string(first) + "/full";
        const bool there = recorder.broadcast().get("/m" + path).has_value();
        const auto again = nlohmann::json::parse(recorder.broadcast().get("/m/sync")->content);
        EXPECT_TRUE(there || again["first_fragment"] > first) << path;
        return first >= 20;
    }));
}

TEST(Recorder, AFolderHasOneRecorder) {
    const test::TemporaryFolder folder;
    Recorder first(options(folder / "r"));
    first.show(info("m"));
    first.wait_until_written();
    Recorder second(options(folder / "r"));
    second.show(info("m"));
    second.wait_until_written();
    EXPECT_EQ(first.statistics().failures, 0U);
    EXPECT_EQ(second.statistics().failures, 1U);
    EXPECT_EQ(names_in(folder / "r").size(), 1U);
}

TEST(Recorder, RecordsOnceTheOtherRecorderHasLeftTheFolder) {
    const test::TemporaryFolder folder;
    auto first = std::make_unique<Recorder>(options(folder / "r"));
    first->show(info("0"));
    first->wait_until_written();
    RecorderOptions soon = options(folder / "r");
    soon.folder_retry = 200'000'000;
    Recorder second(soon);
    std::uint32_t number = 0;
    const auto show_frames = [&] {
        ++number;
        for (const char* id : {"m", "n"})
            show_frame(second, id, number);
    };
    for (const char* id : {"m", "n"})
        second.show(info(id));
    for (int i = 0; i < 10; ++i) {
        show_frames();
        second.wait_until_written();
        std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    EXPECT_EQ(second.statistics().running, 0U);
    EXPECT_EQ(second.statistics().failures, 2U) << "of two matches, however often it is tried";
    first.reset();
    EXPECT_TRUE(test::eventually([&] {
        show_frames();
        return second.statistics().running == 2;
    }));
    second.end("m");
    second.end("n");
    second.wait_until_written();
    for (const std::string& name : names_in(folder / "r"))
        if (name.ends_with("-m") || name.ends_with("-n")) {
            EXPECT_EQ(kinds(records_in(folder / "r" / name)).substr(0, 3), "IPC") << name;
        }
}

TEST(Recorder, AMatchThatHasEndedIsNotRecordedOnceTheFolderCanBeUsed) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "r") << "in the way";
    RecorderOptions soon = options(folder / "r");
    soon.folder_retry = 0;
    Recorder recorder(soon);
    recorder.request(ObserverRequest{"m", "stays", 1, {}, "", ""});
    recorder.show(info("m"));
    recorder.end("m");
    recorder.wait_until_written();
    fs::remove(folder / "r");
    recorder.request(ObserverRequest{"m", "comes", 1, {}, "", ""});
    recorder.wait_until_written();
    EXPECT_EQ(recorder.statistics().running, 0U);
}

TEST(Recorder, AFolderThatCannotBeWrittenFailsTheEpoch) {
    const test::TemporaryFolder folder;
    std::ofstream(folder / "r") << "in the way";
    Recorder recorder(options(folder / "r"));
    recorder.show(info("m"));
    recorder.show(info("m"));
    show_frame(recorder, "m", 1);
    recorder.wait_until_written();
    EXPECT_EQ(recorder.statistics().failures, 1U);
    fs::remove(folder / "r");
    recorder.show(info("m", 2));
    recorder.wait_until_written();
    EXPECT_EQ(recorder.statistics().failures, 1U);
    EXPECT_EQ(recorder.statistics().running, 1U);
}

TEST(Recorder, ADiskThatIsTooSlowDropsFramesAndCounts) {
    const test::TemporaryFolder folder;
    {
        Recorder recorder(options(folder / "r"));
        recorder.show(info("m"));
        // Faster than any disk: the thread looks for messages every 50 ms.
        EXPECT_TRUE(test::eventually([&] {
            for (std::uint32_t number = 0; number < 5000; ++number)
                show_frame(recorder, "m", number);
            return recorder.statistics().dropped > 0;
        }));
        recorder.end("m");
    }
    const auto names = names_in(folder / "r");
    EXPECT_EQ(kinds(records_in(folder / "r" / names[0])).substr(0, 5), "IPCPC");
}

TEST(Recorder, EndsThatWaitForASlowDiskAreBoundedAndCounted) {
    const test::TemporaryFolder folder;
    Recorder recorder(options(folder / "r"));
    for (int i = 0; i < 200'000; ++i)
        recorder.end("the same");
    recorder.wait_until_written();
    EXPECT_EQ(recorder.statistics().dropped, 0U) << "one is enough";
    // Faster than the thread, which looks for them every 50 ms.
    EXPECT_TRUE(test::eventually([&] {
        for (int i = 0; i < 100'000; ++i)
            recorder.end(std::to_string(i));
        return recorder.statistics().dropped > 0;
    }));
    recorder.wait_until_written();
    recorder.show(info("m"));
    recorder.wait_until_written();
    EXPECT_EQ(recorder.statistics().running, 1U) << "it goes on";
}

TEST(Recorder, WithdrawalsThatWaitForASlowDiskAreBoundedAndCounted) {
    const test::TemporaryFolder folder;
    Recorder recorder(options(folder / "r"));
    EXPECT_TRUE(test::eventually([&] {
        for (int i = 0; i < 10'000; ++i)
            recorder.request_ended("m", "gone");
        return recorder.statistics().dropped > 0;
    }));
}

TEST(Recorder, KnowsWhatAllItsFragmentsTake) {
    const test::TemporaryFolder folder;
    auto writer = Writer::create(folder / "r", {info("m"), "test", 1'000'000}, 100'000);
    ASSERT_TRUE(writer);
    for (int i = 0; i < 60; ++i) {
        ASSERT_TRUE(writer->append({i * 1'000'000LL, Withdrawal{std::string(1000U * (i % 9), 'x')}}));
        std::uint64_t sum = 0;
        for (const Writer::Written& fragment : writer->written())
            sum += fragment.bytes;
        ASSERT_EQ(writer->bytes(), sum);
    }
    ASSERT_TRUE(writer->remove_oldest());
    EXPECT_EQ(writer->bytes(), 12'288U * writer->written().size()) << "a folder and two files each";
}

// In a process of its own, for what ends it or bounds its files; reports on `out`.
class Child {
  public:
    template <class Work>
    explicit Child(Work work) {
        int ends[2];
        EXPECT_EQ(::pipe(ends), 0);
        pid_ = ::fork();
        if (pid_ == 0) {
            work([out = ends[1]](std::uint64_t value) {
                if (::write(out, &value, sizeof value) != sizeof value) ::_exit(2);
            });
            ::_exit(0);
        }
        ::close(ends[1]);
        in_ = ends[0];
    }
    Child(const Child&) = delete;
    Child& operator=(const Child&) = delete;
    ~Child() {
        ::kill(pid_, SIGKILL);
        ::waitpid(pid_, nullptr, 0);
        ::close(in_);
    }
    [[nodiscard]] std::uint64_t report() const {
        std::uint64_t value = 0;
        EXPECT_EQ(::read(in_, &value, sizeof value), static_cast<ssize_t>(sizeof value));
        return value;
    }

  private:
    pid_t pid_ = 0;
    int in_ = 0;
};

TEST(Recorder, AKilledProcessLeavesAllCompleteFragments) {
    const test::TemporaryFolder folder;
    std::uint64_t complete = 0;
    {
        const Child child([&](auto report) {
            Recorder recorder(options(folder / "r"));
            recorder.show(info("m"));
            for (std::uint32_t number = 0;; ++number) {
                show_frame(recorder, "m", number);
                if (number % 50 == 0) recorder.wait_until_written();
                if (recorder.statistics().fragments >= 5) report(recorder.statistics().fragments);
            }
        });
        for (int i = 0; i < 20; ++i)
            complete = child.report();
    }
    const fs::path recording = folder / "r" / names_in(folder / "r")[0];
    const auto reader = Reader::open(recording);
    ASSERT_TRUE(reader) << reader.error().message;
    EXPECT_GE(reader->last_fragment() + 1, complete);
    EXPECT_EQ(kinds(records_in(recording)).substr(0, 3), "IPC");
}

TEST(Recorder, AFullDiskEndsTheRecordingAtItsLastFragment) {
    const test::TemporaryFolder folder;
    const Child child([&](auto report) {
        Recorder recorder(options(folder / "r"));
        recorder.show(info("m"));
        while (recorder.statistics().fragments < 2)
            show_frame(recorder, "m", 1);
        ::signal(SIGXFSZ, SIG_IGN);
        const rlimit nothing{0, 0};
        ::setrlimit(RLIMIT_FSIZE, &nothing);
        while (recorder.statistics().failures == 0)
            show_frame(recorder, "m", 2);
        report(recorder.statistics().running);
        report(recorder.statistics().failures);
    });
    EXPECT_EQ(child.report(), 0U);
    EXPECT_EQ(child.report(), 1U);
    const auto names = names_in(folder / "r");
    ASSERT_EQ(names.size(), 1U);
    EXPECT_GE(Reader::open(folder / "r" / names[0])->last_fragment(), 1U);
    EXPECT_EQ(kinds(records_in(folder / "r" / names[0])).substr(0, 3), "IPC");
}

}  // namespace
}  // namespace camdir::recording
