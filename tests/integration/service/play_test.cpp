// `camera-director play`: a recording is fetched over HTTP like a match that goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "recording/reader.hpp"
#include "recording/writer.hpp"
#include "served.hpp"
#include "support/eventually.hpp"
#include "support/http_client.hpp"

namespace camdir::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using recording::Reader;

constexpr std::int64_t fragment_ns = 100'000'000;
constexpr std::uint32_t fragments = 8;

class PlayTest : public testing::Test {
  protected:
    // Fragments of 0.1 s with a withdrawal each.
    PlayTest() {
        recording::Start start;
        start.match.match_id = "cup/1";
        start.match.map_name = "hall";
        start.fragment_duration = fragment_ns;
        auto writer = recording::Writer::create(folder_ / "r", start, 1ULL << 40);
        for (std::uint32_t n = 0; n < fragments; ++n)
            EXPECT_TRUE(writer->append({n * fragment_ns, recording::Withdrawal{std::to_string(n)}}));
        EXPECT_TRUE(writer->finish());
    }

    void play(const std::vector<std::string>& options) {
        std::vector<std::string> command = {CAMERA_DIRECTOR, "play", folder_ / "r", "--http", "127.0.0.1:0"};
        command.insert(command.end(), options.begin(), options.end());
        process_.emplace(command);
        static const std::string before = "match cup/1 on port ";
        ASSERT_TRUE(eventually([&] { return process_->errors().find(", /broadcast") != std::string::npos; }))
            << process_->errors();
        const std::string said = process_->errors();
        port_ = std::stoi(said.substr(said.find(before) + before.size()));
    }
    [[nodiscard]] HttpAnswer get(const std::string& path) const { return HttpClient(port_).ask("GET", path); }
    [[nodiscard]] json sync() const { return json::parse(get("/broadcast/cup%2F1/sync").body); }

    const Folder folder_;
    std::optional<ChildProcess> process_;
    int port_ = 0;
};

TEST_F(PlayTest, AViewerFetchesEveryBitFromTheListToTheEnd) {
    play({"--speed", "2"});
    const json list = json::parse(get("/broadcast").body);
    ASSERT_EQ(list["matches"].size(), 1U);
    EXPECT_EQ(list["matches"][0]["match"], "cup/1");
    EXPECT_EQ(list["matches"][0]["sync"], "/broadcast/cup%2F1/sync");

    const std::string below = "/broadcast/cup%2F1/" + sync()["recording"].get<std::string>();
    const fs::path copy = folder_ / "copy";
    fs::create_directory(copy);
    const auto fetch = [&](const std::string& name) {
        const HttpAnswer answer = get(below + "/" + name);
        EXPECT_EQ(answer.status, 200) << name;
        EXPECT_EQ(answer.header.at("cache-control"), "public, max-age=31536000, immutable");
        fs::create_directories((copy / name).parent_path());
        EXPECT_TRUE(write_file(copy / name, answer.body));
    };
    fetch("start");
    std::uint32_t next = 0;
    const auto follow = [&] {
        const json now = sync();
        for (; next <= now["last_fragment"].get<std::uint32_t>(); ++next)
            for (const char* name : {"/full", "/delta"})
                fetch(std::to_string(next) + name);
        EXPECT_TRUE(write_file(copy / "sync", now.dump()));
        return !now["live"].get<bool>();
    };
    EXPECT_TRUE(eventually(follow));
    EXPECT_EQ(next, fragments);
    const auto reader = Reader::open(copy);
    ASSERT_TRUE(reader) << reader.error().message;
    std::vector<std::string> gone;
    EXPECT_TRUE(reader->replay(0, [&](const recording::Record& record) {
        gone.push_back(std::get<recording::Withdrawal>(record.message).observer_id);
    }));
    EXPECT_THAT(gone, testing::ElementsAre("0", "1", "2", "3", "4", "5", "6", "7"));
    process_->send_signal(SIGINT);
    EXPECT_EQ(process_->wait(), 0);
}

TEST_F(PlayTest, BeginsWhereItIsTold) {
    play({"--from", "0.45", "--speed", "0.01"});
    EXPECT_EQ(sync()["first_fragment"], 0);
    EXPECT_EQ(sync()["last_fragment"], 4);
    EXPECT_EQ(sync()["live"], true);
    const std::string below = "/broadcast/cup%2F1/" + sync()["recording"].get<std::string>();
    EXPECT_EQ(get(below + "/0/full").status, 200) << "seeking is by the number";
    EXPECT_EQ(get(below + "/5/full").status, 404) << "not yet";
}

TEST_F(PlayTest, HasNothingToWatchLive) {
    play({});
    EXPECT_EQ(json::parse(get("/live").body)["matches"], json::array());
    EXPECT_EQ(get("/map/hall/mesh.glb").status, 404);
    const std::string upgrade =
        "Connection: Upgrade\r\nUpgrade: websocket\r\nSec-WebSocket-Version: 13\r\n"
        "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n";
    EXPECT_EQ(HttpClient(port_).ask("GET", "/live/cup%2F1", upgrade).status, 404);
    for (const char* path : {"/-/healthy", "/-/ready", "/metrics", "/status"})
        EXPECT_EQ(get(path).status, 200) << path;
}

TEST_F(PlayTest, RefusesWhatIsNoRecordingAndNoAddress) {
    const std::string recording = folder_ / "r";
    EXPECT_EQ(run_director({"play", folder_ / "none"}).exit_code, 1);
    for (const char* address : {"localhost", "127.0.0.1:x", "127.0.0.1:70000", "127.0.0.1:"}) {
        const Ran ran = run_director({"play", recording, "--http", address});
        EXPECT_EQ(ran.exit_code, 1) << address;
        EXPECT_THAT(ran.errors, testing::HasSubstr("expected ADDRESS:PORT")) << address;
    }
    EXPECT_THAT(run_director({"play", recording, "--http", "0.0.0.0:0"}).errors,
                testing::HasSubstr("is not a loopback address"));
}

}  // namespace
}  // namespace camdir::test
