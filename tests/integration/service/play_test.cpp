// `camera-director play`: a recording is watched in a browser and fetched over HTTP, whole or like a match
// that goes on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "freespace/freespace.hpp"
#include "recording/reader.hpp"
#include "recording/writer.hpp"
#include "scene/load.hpp"
#include "served.hpp"
#include "support/eventually.hpp"
#include "support/freespace_meshes.hpp"
#include "support/http_client.hpp"

namespace camdir::test {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using recording::Reader;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

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
        static const std::string before =
            "match cup/1 on hall, 0:01: watch it, until Ctrl-C, at http://127.0.0.1:";
        ASSERT_TRUE(eventually([&] {
            return process_->errors().find("/\n", process_->errors().find(before)) != std::string::npos;
        })) << process_->errors();
        said_ = process_->errors();
        ASSERT_THAT(said_, HasSubstr(before));
        port_ = std::stoi(said_.substr(said_.find(before) + before.size()));
    }
    [[nodiscard]] HttpAnswer get(const std::string& path) const { return HttpClient(port_).ask("GET", path); }
    [[nodiscard]] json sync() const { return json::parse(get("/broadcast/cup%2F1/sync").body); }

    const Folder folder_;
    std::optional<ChildProcess> process_;
    std::string said_;  // when it began
    int port_ = 0;
};

TEST_F(PlayTest, AViewerFetchesEveryBitFromTheListToTheEnd) {
    play({"--live", "--speed", "2"});
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
    EXPECT_TRUE(reader
                    ->replay(0,
                             [&](const recording::Record& record) {
                                 gone.push_back(std::get<recording::Withdrawal>(record.message).observer_id);
                             })
                    .empty());
    EXPECT_THAT(gone, testing::ElementsAre("0", "1", "2", "3", "4", "5", "6", "7"));
    process_->send_signal(SIGINT);
    EXPECT_EQ(process_->wait(), 0);
}

TEST_F(PlayTest, BeginsWhereItIsTold) {
    play({"--live", "--from", "0.45", "--speed", "0.01"});
    EXPECT_EQ(sync()["first_fragment"], 0);
    EXPECT_EQ(sync()["last_fragment"], 4);
    EXPECT_EQ(sync()["live"], true);
    const std::string below = "/broadcast/cup%2F1/" + sync()["recording"].get<std::string>();
    EXPECT_EQ(get(below + "/0/full").status, 200) << "seeking is by the number";
    EXPECT_EQ(get(below + "/5/full").status, 404) << "not yet";
}

TEST_F(PlayTest, HasAllOfItAtOnce) {
    play({});
    EXPECT_EQ(sync()["first_fragment"], 0);
    EXPECT_EQ(sync()["last_fragment"], fragments - 1);
    EXPECT_EQ(sync()["live"], false);
    EXPECT_EQ(get("/").header.at("content-type"), "text/html; charset=utf-8");
    EXPECT_EQ(run_director({"play", folder_ / "r", "--from", "1"}).exit_code, 2) << "of --live";
}

TEST_F(PlayTest, ShowsTheMapThatItIsGiven) {
    EXPECT_TRUE(write_file(folder_ / "room.obj",
                           "v 0 0 0\nv 9 0 0\nv 0 9 0\nv 0 0 9\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n"));
    auto contents = square_contents();
    contents.metadata.source_hash = scene::hash_source(folder_ / "room.obj").value();
    contents.metadata.metres_per_unit = 1.0F;
    ASSERT_TRUE(write_file(folder_ / "room.vfs", freespace::encode(contents)));
    play({folder_ / "room.vfs", "--map", folder_ / "room.obj"});
    for (const char* path : {"/map/hall/mesh.glb", "/map/hall/obstacles.glb"})
        EXPECT_EQ(get(path).header.at("content-type"), "model/gltf-binary") << path;
    EXPECT_EQ(get("/map/room/mesh.glb").status, 404) << "the recording's name counts";
    EXPECT_THAT(said_, Not(HasSubstr("was baked from another")));
    EXPECT_EQ(run_director({"play", folder_ / "r", folder_ / "none.vfs"}).exit_code, 1);
}

TEST_F(PlayTest, TellsAtOnceOfAMapThatIsNotTheRight) {
    auto contents = square_contents();
    contents.metadata.source_hash = 1;
    const std::string vfs = folder_ / "room.vfs";
    ASSERT_TRUE(write_file(vfs, freespace::encode(contents)));
    ASSERT_TRUE(write_file(folder_ / "other.obj", "v 0 0 0\nv 9 0 0\nv 0 9 0\nf 1 3 2\n"));
    play({vfs, "--map", folder_ / "other.obj"});
    const std::string other = folder_ / "other.obj";
    EXPECT_THAT(said_, HasSubstr(vfs + " was baked from another file than " + other));
    const Ran ran = run_director({"play", folder_ / "r", vfs, "--map", folder_ / "none.obj"});
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.errors, HasSubstr("none.obj"));
}

TEST_F(PlayTest, TellsHowToUseAnotherPort) {
    play({});
    const Ran ran = run_director({"play", folder_ / "r", "--http", "127.0.0.1:" + std::to_string(port_)});
    EXPECT_EQ(ran.exit_code, 1);
    EXPECT_THAT(ran.errors, AllOf(HasSubstr("cannot listen"), HasSubstr("--http takes another")));
}

TEST_F(PlayTest, HasNothingToWatchLive) {
    play({});
    EXPECT_EQ(json::parse(get("/live").body)["matches"], json::array());
    EXPECT_EQ(json::parse(get("/live").body)["broadcast"], "/broadcast");
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
    const auto errors_of = [&](const std::string& folder) {
        const Ran ran = run_director({"play", folder});
        EXPECT_EQ(ran.exit_code, 1) << folder;
        return ran.errors;
    };
    EXPECT_THAT(errors_of(folder_ / "none"), HasSubstr("is no folder: expected the folder of a recording"));
    EXPECT_THAT(errors_of(folder_ / ""),
                AllOf(HasSubstr("holds recordings and is none: name one of these 1"), HasSubstr(recording)));
    fs::create_directory(folder_ / "empty");
    EXPECT_THAT(errors_of(folder_ / "empty"), HasSubstr("has no start: expected the folder of a recording"));
    fs::copy(folder_ / "r", folder_ / "cut", fs::copy_options::recursive);
    fs::remove(folder_ / "cut/sync");
    EXPECT_THAT(errors_of(folder_ / "cut"), HasSubstr("the recording ended before its first fragment did"));
    for (const char* address : {"localhost", "127.0.0.1:x", "127.0.0.1:70000", "127.0.0.1:"}) {
        const Ran ran = run_director({"play", recording, "--http", address});
        EXPECT_EQ(ran.exit_code, 1) << address;
        EXPECT_THAT(ran.errors, HasSubstr("expected ADDRESS:PORT")) << address;
    }
    EXPECT_THAT(run_director({"play", recording, "--http", "0.0.0.0:0"}).errors,
                HasSubstr("is not a loopback address"));
}

}  // namespace
}  // namespace camdir::test
