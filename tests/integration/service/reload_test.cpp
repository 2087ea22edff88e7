// A reload while a match runs, with the client SDK at both ends.
#include <gtest/gtest.h>

#include <array>
#include <camera_director/camera_director.hpp>
#include <csignal>

#include "served.hpp"
#include "support/eventually.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

namespace sdk = camera_director;
using nlohmann::json;

// Game servers find the director by its address, so it needs well-known ports.
json config_for_a_match(const TestDomain& domain) {
    json config = quiet_config();
    config["dds"] = {{"domain", domain.id()}, {"participant_index", 0}};
    config["maps"] = {{{"name", "square"}, {"file", "square.vfs"}}};
    return config;
}

// One player who walks over the square.
class GameServer {
  public:
    GameServer(const TestDomain& domain, const std::string& map_name)
        : context_(sdk::Context::open({.domain = domain.id()}).value()),
          match_(sdk::Match::open(context_, info(map_name)).value()) {}

    void send_frame() {
        time_ += 20'000'000;
        const std::array<std::uint32_t, 1> player = {7};
        const std::array<float, 3> eye = {30.0F + 0.001F * static_cast<float>(time_ / 1'000'000 % 40'000),
                                          50.0F, 0.0F};
        const std::array<float, 4> orientation = {0.0F, 0.0F, 0.0F, 1.0F};
        const std::array<std::uint32_t, 1> flags = {CDIR_POSE_ALIVE};
        match_
            .publish(sdk::PoseFrame{.frame_time = time_,
                                    .player_id = player,
                                    .eye = eye,
                                    .orientation = orientation,
                                    .flags = flags})
            .value();
    }

    [[nodiscard]] const sdk::Context& context() const { return context_; }

  private:
    static sdk::MatchInfo info(const std::string& map_name) {
        return {.match_id = "cup",
                .map_name = map_name,
                .rate_hz = 50.0F,
                .players = {{.id = 7, .name = "anna"}}};
    }

    sdk::Context context_;
    sdk::Match match_;
    std::int64_t time_ = 0;
};

// Sends frames until the condition on the observer holds.
bool play_until(GameServer& server, sdk::Observer& observer, const std::function<bool()>& condition) {
    return eventually([&] {
        server.send_frame();
        (void)observer.wait(std::chrono::milliseconds(10)).value();
        observer.poll().value();
        return condition();
    });
}

TEST(Reload, LoadsTheMapThatAMatchWaitsFor) {
    const Folder folder;
    folder.write_square("square.vfs");
    folder.write_square("late.vfs");
    const TestDomain domain;
    json config = config_for_a_match(domain);
    Served served(folder, config);
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();
    GameServer server(domain, "late");
    sdk::Observer observer = sdk::Observer::open(server.context(), "cup", "o").value();
    observer.request({}).value();
    ASSERT_TRUE(play_until(server, observer, [&] {
        return observer.shot_status().value().state == static_cast<std::uint32_t>(CDIR_SHOT_WAITING_FOR_MAP);
    })) << served.log();
    EXPECT_STREQ(observer.shot_status().value().reason, "map 'late' is not configured; known: square");

    config["maps"].push_back({{"name", "late"}, {"file", "late.vfs"}});
    folder.write("config.json", config.dump());
    served.signal(SIGHUP);
    ASSERT_TRUE(play_until(server, observer, [&] { return observer.newest_camera().value().has_value(); }))
        << served.log();
    EXPECT_EQ(observer.newest_camera().value()->camera.target, 7U);
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0) << served.log();
}

TEST(Reload, KeepsTheShardOfTheCommandLine) {
    const Folder folder;
    json config = quiet_config();
    config["dds"]["shards"] = json::array({"a"});
    const Served served(folder, config, {"--shard", "a"});
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();
    config["dds"]["shards"] = json::array({"a", "b"});
    folder.write("config.json", config.dump());
    served.signal(SIGHUP);
    EXPECT_TRUE(served.logged("config.json: reloaded")) << served.log();
}

}  // namespace
}  // namespace camdir::test
