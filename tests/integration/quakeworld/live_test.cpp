// A real game: a QuakeWorld server with bots, qtv-publisher, a director, an observer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <camera_director/camera_director.hpp>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "game_server.hpp"
#include "support/eventually.hpp"
#include "support/http_client.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

constexpr int bots = 4;
constexpr const char* match_id = "quakeworld";

// `camera-director serve` with the bots' map, which it bakes when no earlier test has.
class Director {
  public:
    explicit Director(std::uint32_t domain) {
        std::filesystem::create_directories(CAMDIR_TEST_MAPS);
        const std::string map = bot_map;
        std::ofstream(folder_ / "config.json")
            << nlohmann::json{{"dds", {{"domain", domain}}},
                              {"http", {{"port", 0}}},
                              {"maps",
                               {{{"name", map},
                                 {"file", CAMDIR_TEST_MAPS "/" + map + ".vfs"},
                                 {"source", bot_map_file().string()}}}}};
        process_.emplace(std::vector<std::string>{CAMDIR_BIN_DIR "/camera-director", "serve", "--config",
                                                  (folder_ / "config.json").string()});
    }

    [[nodiscard]] bool ready() const { return logs("info: ready"); }
    [[nodiscard]] bool logs(const std::string& text) const {
        return eventually([&] { return log().find(text) != std::string::npos; });
    }
    [[nodiscard]] std::string log() const { return process_->errors(); }
    // Of the match, as the status page has it; null while there is none.
    [[nodiscard]] nlohmann::json status() {
        const std::string before = "http: listening on 127.0.0.1 port ";
        const int port = std::stoi(log().substr(log().find(before) + before.size()));
        const auto page = nlohmann::json::parse(HttpClient(port).ask("GET", "/status").body);
        return page["matches"].empty() ? nlohmann::json() : page["matches"][0];
    }

  private:
    TemporaryFolder folder_;
    std::optional<ChildProcess> process_;
};

class LiveQuakeWorld : public testing::Test {
  protected:
    void SetUp() override {
        if (const auto needs = needs_for_quakeworld()) GTEST_SKIP() << *needs;
        director_.emplace(domain_.id());
        server_.emplace(bots);
        std::ofstream(folder_ / "password") << QuakeWorldServer::password << "\n";
        ASSERT_TRUE(director_->ready()) << director_->log();
        ASSERT_TRUE(server_->ready()) << server_->log();
        publisher_.emplace(std::vector<std::string>{
            CAMDIR_BIN_DIR "/qtv-publisher", "127.0.0.1:" + std::to_string(server_->qtv_port()), "--match",
            match_id, "--domain", std::to_string(domain_.id()), "--password-file",
            (folder_ / "password").string()});
    }

    [[nodiscard]] std::string logs() const {
        return "publisher:\n" + publisher_->errors() + "director:\n" + director_->log() + "server:\n" +
               server_->log();
    }

    TestDomain domain_;
    TemporaryFolder folder_;
    std::optional<Director> director_;
    std::optional<QuakeWorldServer> server_;
    std::optional<ChildProcess> publisher_;
};

TEST_F(LiveQuakeWorld, CamerasFollowThePlayersAndKillsArrive) {
    const auto context = camera_director::Context::open({.domain = domain_.id()}).value();
    auto observer = camera_director::Observer::open(context, match_id, "anna").value();
    observer.request({}).value();

    // Cameras of living players, and how many of them saw theirs.
    int cameras = 0;
    int visible = 0;
    std::set<std::uint32_t> targets;
    std::vector<camera_director::Camera> frame_cameras(16);
    EXPECT_TRUE(eventually([&] {
        (void)observer.wait(std::chrono::milliseconds(100)).value();
        while (const auto frame = observer.next_frame(frame_cameras).value()) {
            for (std::uint32_t i = 0; i < frame->camera_count; ++i) {
                const auto& camera = frame_cameras[i];
                if ((camera.flags & (CDIR_CAMERA_HELD | CDIR_CAMERA_TARGET_ABSENT)) != 0) continue;
                targets.insert(camera.target);
                ++cameras;
                visible += (camera.flags & CDIR_CAMERA_TARGET_VISIBLE) != 0;
            }
        }
        return cameras >= 500 && targets.size() >= 2;
    })) << cameras
        << " cameras\n"
        << logs();
    EXPECT_GT(visible, cameras * 9 / 10) << "of " << cameras;

    const auto info = observer.match_info().value();
    ASSERT_TRUE(info);
    EXPECT_EQ(info->map_name, bot_map);
    EXPECT_EQ(info->players.size(), std::size_t{bots}) << "the spectator is no player";
    for (const auto& player : info->players)
        EXPECT_NE(player.name, "");

    EXPECT_TRUE(eventually([&] {
        const auto status = director_->status();
        return status.is_object() && status["last_event"].is_object() &&
               status["last_event"]["kind"] == "kill";
    })) << director_->status().dump()
        << logs();

    publisher_->send_signal(SIGTERM);
    EXPECT_EQ(publisher_->wait(), 0) << logs();
    EXPECT_TRUE(director_->logs(std::string("match ") + match_id + ": ended")) << logs();
}

}  // namespace
}  // namespace camdir::test
