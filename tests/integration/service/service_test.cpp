// The life of the process, without a match.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <sstream>

#include "served.hpp"
#include "support/authority.hpp"
#include "support/eventually.hpp"

namespace camdir::test {
namespace {

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

json with_square(json config = quiet_config()) {
    config["maps"] = {{{"name", "square"}, {"file", "square.vfs"}}};
    return config;
}

TEST(Service, IsReadyShowsItselfAndStopsOnSigterm) {
    const Folder folder;
    folder.write_square("square.vfs");
    Served served(folder, with_square());
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();
    EXPECT_EQ(served.get("/-/healthy"), "ok\n");
    EXPECT_EQ(served.get("/-/ready"), "ready\n");
    EXPECT_THAT(served.get("/metrics"),
                AllOf(HasSubstr("camera_director_map_loaded{map=\"square\"} 1\n"),
                      HasSubstr("camera_director_matches 0\n"), HasSubstr("camera_director_matches_led 0\n"),
                      HasSubstr("camera_director_strength 100\n"),
                      HasSubstr("camera_director_reception_seconds_count 0\n"),
                      HasSubstr("camera_director_wire_received_total{topic=")));
    EXPECT_EQ(served.status()["maps"][0]["state"], "ready");
    EXPECT_EQ(served.status()["maps"][0]["triangles"], 2);
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0);

    std::istringstream lines(served.log());
    for (std::string line; std::getline(lines, line);) {
        ASSERT_TRUE(json::accept(line)) << line;
        EXPECT_TRUE(json::parse(line).contains("time"));
    }
    EXPECT_THAT(served.log(), HasSubstr("\"stopped\""));
}

TEST(Service, StopsOnSigintWhileItStarts) {
    const Folder folder;
    Served served(folder, quiet_config());
    ASSERT_TRUE(served.logged("http: listening"));
    served.signal(SIGINT);
    EXPECT_EQ(served.exit_code(), 0);
}

TEST(Service, IsNotReadyOnceItsIdentityHasExpired) {
    const Authority authority;
    const auto identity = authority.issue("director", "director", "*");
    // Valid for long enough to begin with it.
    authority.certify(identity, "-enddate $(date -u -d '20 seconds' +%Y%m%d%H%M%SZ)");
    const Folder folder;
    json config = quiet_config();
    config["dds"]["security"] = identity.string();
    Served served(folder, config);
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();
    std::string missing;
    const auto refuses = [&] {
        try {
            missing = served.get("/-/ready", 503);
            return true;
        } catch (const std::exception&) {
            return false;  // another status
        }
    };
    EXPECT_TRUE(eventually(refuses)) << served.log();
    EXPECT_THAT(missing, HasSubstr("identity in " + identity.string() + ": its certificate has expired"));
    EXPECT_EQ(served.get("/-/healthy"), "ok\n") << "it serves on";
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0);
}

TEST(Service, ReportsAMapThatFailsAndServesTheOthers) {
    const Folder folder;
    folder.write_square("square.vfs");
    folder.write("damaged.vfs", "not a baked map");
    json config = with_square();
    config["maps"].push_back({{"name", "damaged"}, {"file", "damaged.vfs"}});
    config["maps"].push_back({{"name", "unbaked"}, {"file", "unbaked.vfs"}, {"source", "unbaked.bsp"}});
    Served served(folder, config);
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();
    EXPECT_THAT(served.get("/metrics"), AllOf(HasSubstr("map_loaded{map=\"damaged\"} 0\n"),
                                              HasSubstr("map_loaded{map=\"square\"} 1\n"),
                                              HasSubstr("map_loaded{map=\"unbaked\"} 0\n")));
    const json status = served.status();
    ASSERT_EQ(status.at("maps").size(), 3U);
    for (const json& map : status.at("maps")) {
        if (map["name"] == "square") continue;
        EXPECT_EQ(map["state"], "failed");
        EXPECT_THAT(map["reason"].get<std::string>(), HasSubstr(map["name"].get<std::string>() + "."));
    }
}

TEST(Service, NamesFromOutsideCannotForgeALineOfTheLog) {
    const Folder folder;
    json config = quiet_config();
    config["log"]["format"] = "text";
    config["maps"] = json::array({{{"name", "a\nforged"}, {"file", "a.vfs"}}});
    const Served served(folder, config);
    ASSERT_TRUE(served.logged("info: ready")) << served.log();
    EXPECT_THAT(served.log(), HasSubstr("error: map a?forged: "));
    EXPECT_THAT(served.log(), testing::Not(HasSubstr("\nforged")));
}

TEST(Service, SighupReloads) {
    const Folder folder;
    folder.write_square("square.vfs");
    folder.write_square("other.vfs");
    Served served(folder, with_square());
    ASSERT_TRUE(served.logged("\"ready\"")) << served.log();

    folder.write("config.json", R"({"maps": [{"name": "other", "file": "other.vfs", "d0": 1}]})");
    served.signal(SIGHUP);
    ASSERT_TRUE(served.logged("/maps/0/d0: 1: expected a number from 2 to 256, or 0")) << served.log();
    EXPECT_THAT(served.log(), HasSubstr("not reloaded"));
    EXPECT_EQ(served.status()["maps"][0]["name"], "square");
    EXPECT_THAT(served.get("/metrics"), HasSubstr("camera_director_config_refused 1\n"));

    json config = with_square();
    config["maps"].push_back({{"name", "other"}, {"file", "other.vfs"}});
    config["http"]["port"] = 1;
    folder.write("config.json", config.dump());
    served.signal(SIGHUP);
    ASSERT_TRUE(eventually([&] {
        const json maps = served.status()["maps"];
        return maps.size() == 2 && maps[0]["state"] == "ready" && maps[1]["state"] == "ready";
    })) << served.log();
    EXPECT_THAT(served.log(), HasSubstr("/http/port takes effect after a restart"));
    EXPECT_THAT(served.get("/metrics"), AllOf(HasSubstr("camera_director_config_refused 0\n"),
                                              HasSubstr("camera_director_config_keys_for_restart 1\n")));
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0);
}

TEST(Service, FailsOnAPortInUse) {
    const Folder folder;
    Served first(folder, quiet_config());
    const Folder other;
    ASSERT_TRUE(first.logged("http: listening"));
    const std::string log = first.log();
    const std::size_t at = log.find(" port ") + 6;
    json config = quiet_config();
    config["http"]["port"] = std::stoi(log.substr(at));
    Served second(other, config);
    EXPECT_EQ(second.exit_code(), 1);
    EXPECT_THAT(second.log(),
                AllOf(HasSubstr("http: cannot listen on 127.0.0.1 port"), HasSubstr("; set /http/port")));
}

}  // namespace
}  // namespace camdir::test
