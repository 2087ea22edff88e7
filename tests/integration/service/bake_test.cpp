// Maps that are baked at start.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <filesystem>

#include "served.hpp"
#include "support/eventually.hpp"
#include "support/openarena.hpp"
#include "support/q3_maps.hpp"

namespace camdir::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

Bytes room(double height) {
    q3::Bsp bsp = room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(512.0, 384.0, height)));
    add_spawn_point(bsp, Vec3d(256.0, 192.0, 40.0));
    return encode(bsp);
}

void write(const Folder& folder, const std::string& name, const Bytes& bytes) {
    folder.write(name, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

json with_room(double d0 = 64.0) {
    json config = quiet_config();
    config["maps"] = {{{"name", "room"}, {"file", "room.vfs"}, {"source", "room.bsp"}, {"d0", d0}}};
    return config;
}

// Serves until ready, then stops; returns the log.
std::string log_of_a_start(const Folder& folder, const json& config) {
    Served served(folder, config);
    EXPECT_TRUE(served.logged("\"ready\"")) << served.log();
    EXPECT_EQ(served.status()["maps"][0]["state"], "ready") << served.log();
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0);
    return served.log();
}

TEST(Bake, BakesOnlyMissingOrStaleMaps) {
    const Folder folder;
    write(folder, "room.bsp", room(256.0));
    EXPECT_THAT(log_of_a_start(folder, with_room()),
                AllOf(HasSubstr("will be baked"), HasSubstr("baked in")));
    EXPECT_THAT(log_of_a_start(folder, with_room()), Not(HasSubstr("baked")));
    EXPECT_THAT(log_of_a_start(folder, with_room(48.0)), HasSubstr("it was baked with d0 64 instead of 48"));
    json uniform = with_room(48.0);
    uniform["maps"][0]["sampling"] = "uniform";
    EXPECT_THAT(log_of_a_start(folder, uniform), HasSubstr("it was baked with sampling "));
    EXPECT_THAT(log_of_a_start(folder, uniform), Not(HasSubstr("baked")));
    write(folder, "room.bsp", room(320.0));
    EXPECT_THAT(log_of_a_start(folder, with_room(48.0)), HasSubstr("it was baked from other bytes ("));
    folder.write("room.vfs", "damaged");
    EXPECT_THAT(log_of_a_start(folder, with_room(48.0)),
                AllOf(HasSubstr("will be baked: "), HasSubstr("room.vfs")));
    std::filesystem::remove(folder / "room.bsp");
    EXPECT_THAT(log_of_a_start(folder, with_room(48.0)),
                AllOf(HasSubstr("is used as it is"), Not(HasSubstr("baking"))));
}

TEST(Bake, UsesFilesOfBakeConfig) {
    const Folder folder;
    write(folder, "room.bsp", room(256.0));
    folder.write("config.json", with_room().dump());
    const Ran ran = run_director({"bake", "--config", folder / "config.json"});
    ASSERT_EQ(ran.exit_code, 0) << ran.errors;
    EXPECT_THAT(log_of_a_start(folder, with_room()), Not(HasSubstr("baked")));
}

TEST(Bake, AfterAReloadItIsReadyWhenAReplacedSourceIsBaked) {
    const Folder folder;
    write(folder, "room.bsp", room(256.0));
    Served served(folder, with_room());
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();
    const std::size_t before = served.log().size();
    write(folder, "room.bsp", room(320.0));
    served.signal(SIGHUP);
    const auto next = [&](const char* text) { return served.log().find(text, before); };
    ASSERT_TRUE(eventually([&] { return next("\"ready\"") != std::string::npos; })) << served.log();
    EXPECT_LT(next("map room: baked in"), next("\"ready\"")) << served.log();
    EXPECT_EQ(served.get("/-/ready"), "ready\n");

    std::filesystem::remove(folder / "room.bsp");
    served.signal(SIGHUP);
    EXPECT_TRUE(served.logged("is used as it is")) << served.log();
}

TEST(Bake, IsNotReadyWhileBakingAndStopsAtOnce) {
    const auto map = openarena_map("oa_dm1");
    if (!map) GTEST_SKIP() << needs_openarena_map("oa_dm1");
    const Folder folder;
    folder.write_square("square.vfs");
    json config = quiet_config();
    config["maps"] = {{{"name", "dm1"}, {"file", "dm1.vfs"}, {"source", *map}, {"d0", 4}},
                      {{"name", "square"}, {"file", "square.vfs"}}};
    Served served(folder, config);
    ASSERT_TRUE(served.logged("map dm1: baking")) << served.log();
    EXPECT_THAT(served.get("/-/ready", 503), HasSubstr("map dm1: "));
    EXPECT_EQ(served.get("/-/healthy"), "ok\n");
    EXPECT_EQ(served.status()["maps"][1]["state"], "ready") << "maps that need no bake come first";
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0) << served.log();
    EXPECT_FALSE(std::filesystem::exists(folder / "dm1.vfs"));
}

}  // namespace
}  // namespace camdir::test
