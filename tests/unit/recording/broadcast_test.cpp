// The resources that viewers fetch.
#include "recording/broadcast.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "recording/percent.hpp"
#include "recording/resource.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::recording {
namespace {

using nlohmann::json;

class BroadcastTest : public testing::Test {
  protected:
    // Fragments 0 to 4, of which viewers know 1 to 3.
    BroadcastTest() {
        write("start", content_of({ResourceKind::start, 0, 0, {}}));
        for (std::uint32_t n = 0; n < 5; ++n) {
            write(std::to_string(n) + "/full", content_of({ResourceKind::full, n, 0, {}}));
            write(std::to_string(n) + "/delta", content_of({ResourceKind::delta, n, 0, {}}));
        }
        write("secret", "x");
        std::ofstream(folder_ / "secret") << "x";
        broadcast_.set("m/1", channel("id"));
    }

    [[nodiscard]] Channel channel(const std::string& recording_id) const {
        return {recording_id, folder_ / "r", "square", 3.0, 10.0, {1, 3}, Channel::Clock::now()};
    }
    [[nodiscard]] static std::string content_of(const Resource& resource) {
        const Bytes bytes = encode(resource);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    [[nodiscard]] std::string content(const std::string& path) const {
        const auto answer = broadcast_.get(path);
        return answer ? answer->content : "none";
    }

    const test::TemporaryFolder folder_;
    Broadcast broadcast_;

    void write(const std::string& name, const std::string& content) const {
        std::filesystem::create_directories((folder_ / "r" / name).parent_path());
        std::ofstream(folder_ / "r" / name) << content;
    }
};

TEST_F(BroadcastTest, HasTheResourcesOfARecording) {
    EXPECT_TRUE(broadcast_.get("/m%2F1/id/0/full")) << "given up, and still there";
    EXPECT_EQ(content("/m%2F1/id/start"), content_of({ResourceKind::start, 0, 0, {}}));
    EXPECT_EQ(content("/m%2F1/id/1/full"), content_of({ResourceKind::full, 1, 0, {}}));
    EXPECT_EQ(content("/m%2F1/id/3/delta"), content_of({ResourceKind::delta, 3, 0, {}}));
    const auto one = broadcast_.get("/m%2F1/id/1/full");
    EXPECT_FALSE(one->is_json);
    EXPECT_EQ(one->tag, "id/1/full");
    EXPECT_EQ(broadcast_.get("/m%2F1/id/start")->tag, "id/start");
}

TEST_F(BroadcastTest, TellsHowFarBehindAViewerIs) {
    const auto answer = broadcast_.get("/m%2F1/sync");
    ASSERT_TRUE(answer);
    EXPECT_TRUE(answer->is_json);
    EXPECT_EQ(answer->tag, "");
    json sync = json::parse(answer->content);
    EXPECT_GE(sync["age_s"].get<double>(), 0.0);
    sync.erase("age_s");
    EXPECT_EQ(sync, json({{"version", 1},
                          {"recording", "id"},
                          {"first_fragment", 1},
                          {"last_fragment", 3},
                          {"fragment_duration_s", 3.0},
                          {"delay_s", 10.0},
                          {"live", true}}));
    const auto read = decode_sync(std::as_bytes(std::span(answer->content)), "sync");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->last, 3U);
}

TEST_F(BroadcastTest, ListsTheMatches) {
    broadcast_.set("\xff", channel("other"));
    EXPECT_EQ(
        json::parse(content("")),
        json(
            {{"matches",
              {{{"match", "m/1"}, {"map", "square"}, {"live", true}, {"sync", "/broadcast/m%2F1/sync"}},
               {{"match", "\ufffd"}, {"map", "square"}, {"live", true}, {"sync", "/broadcast/%FF/sync"}}}}}));
}

TEST_F(BroadcastTest, HasNothingElse) {
    for (const char* path : {"/",
                             "/m%2F1",
                             "/m%2F1/",
                             "/m%2F1/id",
                             "/m%2F1/id/",
                             "/m/1/sync",
                             "/m%2F1/sync/",
                             "/m%2F1/id/sync",
                             "/m%2F1/id/secret",
                             "/m%2F1/id/1",
                             "/m%2F1/id/1/",
                             "/m%2F1/id/1/full/",
                             "/m%2F1/id/1/start",
                             "/m%2F1/id/01/full",
                             "/m%2F1/id/+1/full",
                             "/m%2F1/id/-1/full",
                             "/m%2F1/id/4294967297/full",
                             "/m%2F1/id/4/full",
                             "/m%2F1/id/1/../../secret",
                             "/m%2F1/../secret/start",
                             "/m%2F1/id/..%2F..%2Fsecret",
                             "/m%2f1/sync",
                             "/%6D%2F1/sync",
                             "/m%2/sync",
                             "/m%2G1/sync",
                             "/other/sync",
                             "/../r/start",
                             "/m%2F1/other/start"})
        EXPECT_FALSE(broadcast_.get(path)) << path;
}

TEST_F(BroadcastTest, NeverMixesTwoRecordings) {
    broadcast_.set("m/1", channel("second"));
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/start"));
    EXPECT_EQ(content("/m%2F1/second/start"), content_of({ResourceKind::start, 0, 0, {}}));
}

TEST_F(BroadcastTest, AnEndedMatchCanBeSeenToItsEnd) {
    broadcast_.end("m/1");
    broadcast_.end("unknown");
    EXPECT_EQ(json::parse(content("/m%2F1/sync"))["live"], false);
    EXPECT_TRUE(broadcast_.get("/m%2F1/id/3/delta"));
    broadcast_.set("m/1", channel("second"));
    EXPECT_EQ(json::parse(content("/m%2F1/sync"))["live"], true);
}

TEST_F(BroadcastTest, AnEndedMatchStaysAsLongAsSomebodyWatchesIt) {
    const Broadcast::Time end = Channel::Clock::now();
    const auto after = [&](int minutes) { return end + std::chrono::minutes(minutes); };
    broadcast_.end("m/1", end);
    for (int minutes = 5; minutes <= 30; minutes += 5) {
        broadcast_.drop_unwanted(after(minutes));
        const char* part = minutes % 10 == 0 ? "/m%2F1/id/3/delta" : "/m%2F1/sync";
        EXPECT_TRUE(broadcast_.get(part, after(minutes))) << minutes;
    }
    broadcast_.drop_unwanted(after(41));
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/3/delta", after(41)));
}

TEST_F(BroadcastTest, ARemovedRecordingIsGoneAndNoOther) {
    broadcast_.set("runs", channel("other"));
    broadcast_.end("m/1");
    broadcast_.remove(folder_ / "elsewhere");
    EXPECT_TRUE(broadcast_.get("/m%2F1/sync"));
    broadcast_.remove(folder_ / "r");
    EXPECT_FALSE(broadcast_.get("/m%2F1/sync"));
    EXPECT_TRUE(broadcast_.get("/runs/sync"));
}

TEST_F(BroadcastTest, WhatIsNoSuchResourceIsNotShown) {
    namespace fs = std::filesystem;
    const auto replace = [&](const fs::path& name, const std::string& content) {
        fs::remove(folder_ / "r" / name);
        write(name.string(), content);
    };
    fs::remove(folder_ / "r" / "1" / "full");
    fs::create_symlink(folder_ / "secret", folder_ / "r" / "1" / "full");
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/1/full"));
    replace("1/delta", content_of({ResourceKind::delta, 2, 0, {}}));
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/1/delta")) << "another fragment's";
    replace("2/full", content_of({ResourceKind::delta, 2, 0, {}}));
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/2/full")) << "another kind's";
    replace("2/delta", content_of({ResourceKind::delta, 2, 0, {}}) + "x");
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/2/delta")) << "longer than it says";
    replace("3/full", "");
    fs::resize_file(folder_ / "r" / "3" / "full", 1ULL << 30U);  // takes no place
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/3/full"));
}

TEST_F(BroadcastTest, AProxyMayLeaveWhatNeedNotBeEncoded) {
    broadcast_.set("a-b.c~d", channel("id"));
    for (const char* path : {"/a%2Db%2Ec%7Ed/sync", "/a-b.c~d/sync"})
        EXPECT_TRUE(broadcast_.get(path)) << path;
    for (const char* path : {"/a%2Db.c~d/sync", "/a-b%2Ec~d/sync"})
        EXPECT_FALSE(broadcast_.get(path)) << path << ": a cache would keep it once more";
}

TEST_F(BroadcastTest, ARotatedFragmentIsGone) {
    std::filesystem::remove_all(folder_ / "r" / "2");
    EXPECT_FALSE(broadcast_.get("/m%2F1/id/2/full"));
    EXPECT_TRUE(broadcast_.get("/m%2F1/id/3/full"));
}

TEST(Percent, EveryByteComesBack) {
    std::string all;
    for (int byte = 0; byte < 256; ++byte)
        all += static_cast<char>(byte);
    const std::string encoded = percent_encoded(all);
    EXPECT_TRUE(std::all_of(encoded.begin(), encoded.end(),
                            [](char c) { return std::isalnum(c) != 0 || c == '_' || c == '%'; }));
    EXPECT_EQ(percent_decoded(encoded), all);
    for (const char* wrong : {"%", "%1", "%x1", "a%-1", "%1x"})
        EXPECT_FALSE(percent_decoded(wrong)) << wrong;
}

}  // namespace
}  // namespace camdir::recording
