#include "settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <string>

#include "engine.h"
#include "fake_engine.hpp"
#include "proxy.h"

namespace camdir::openarena {
namespace {

class OpenArenaSettings : public testing::Test {
  protected:
    OpenArenaSettings() { engine.start_map("oa_dm1"); }

    settings read() {
        settings found{};
        (void)settings_read(&found);
        return found;
    }

    test::FakeEngine engine;
};

TEST_F(OpenArenaSettings, HaveDefaults) {
    const settings found = read();
    EXPECT_STREQ(found.match.match_id, "openarena-27960");
    EXPECT_STREQ(found.match.directors, "127.0.0.1");
    EXPECT_EQ(found.match.domain, 0U);
    EXPECT_EQ(found.match.rate_hz, 20);
    EXPECT_STREQ(found.match.error, "");
}

TEST_F(OpenArenaSettings, AreReadAgainOnlyWhenTheyDiffer) {
    settings found = read();
    EXPECT_FALSE(settings_read(&found));
    engine.cvars["sv_fps"] = "60";
    EXPECT_TRUE(settings_read(&found));
    EXPECT_EQ(found.match.rate_hz, 60);
}

TEST_F(OpenArenaSettings, ADomainThatIsNoneIsNotAnotherOne) {
    const auto domain = [&](const std::string& text) {
        engine.cvars["director_domain"] = text;
        return read().match.domain;
    };
    EXPECT_EQ(domain("230"), 230U);
    for (const char* text : {"231", "", "-1", "abc", "1x", "99999999999999999999"}) {
        EXPECT_EQ(domain(text), std::numeric_limits<std::uint32_t>::max()) << text;
        EXPECT_EQ(read().match.error,
                  "director_domain '" + std::string(text) + "': expected a number from 0 to 230");
    }
}

TEST_F(OpenArenaSettings, AValueThatDoesNotFitIsAnError) {
    engine.cvars["director_match"] = std::string(63, 'm');
    EXPECT_STREQ(read().match.error, "");
    engine.cvars["director_match"] = std::string(64, 'm');
    EXPECT_STREQ(read().match.error, "director_match is longer than 63 bytes");
}

TEST_F(OpenArenaSettings, WithoutPosesThereAreNoCameras) {
    EXPECT_EQ(read().spectate, 0) << "director_enable is 0";
    engine.cvars["director_enable"] = "1";
    EXPECT_EQ(read().spectate, 1);
    engine.cvars["director_spectate"] = "0";
    EXPECT_EQ(read().spectate, 0);
}

TEST_F(OpenArenaSettings, NoConsoleChangesWhichCodeIsLoaded) {
    EXPECT_EQ(engine.cvar_flags.at("director_game"), cvar_set_at_start);
    EXPECT_EQ(engine.cvar_flags.at("director_record"), cvar_open);
}

}  // namespace
}  // namespace camdir::openarena
