#include "roster.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "engine.h"
#include "frame.h"

namespace camdir::openarena {
namespace {

TEST(OpenArenaRoster, ReadsNameAndTeam) {
    const match_player entry = roster_parse("n\\Sarge\\t\\2\\model\\sarge\\hmodel\\sarge\\c1\\4");
    EXPECT_TRUE(entry.in_use);
    EXPECT_EQ(entry.team, team_blue);
    EXPECT_STREQ(entry.name, "Sarge");
}

TEST(OpenArenaRoster, LeavesColoursAndUnprintableBytesOut) {
    EXPECT_STREQ(roster_parse("n\\^1Re^7d \x01\xff^\\t\\0").name, "Red ^");
}

TEST(OpenArenaRoster, AnEmptyStringFreesTheSlot) {
    roster_reset();
    roster_take_configstring(CONFIGSTRING_PLAYERS + 5, "n\\Tony\\t\\3");
    EXPECT_TRUE(roster_at(5)->in_use);
    EXPECT_EQ(roster_at(5)->team, team_spectator);
    roster_take_configstring(CONFIGSTRING_PLAYERS + 5, nullptr);
    EXPECT_FALSE(roster_at(5)->in_use);
}

TEST(OpenArenaRoster, TheVersionChangesOnlyWithAnEntry) {
    roster_reset();
    roster_take_configstring(CONFIGSTRING_PLAYERS, "n\\Tony\\t\\0\\w\\0");
    const std::uint32_t version = roster_version();
    roster_take_configstring(CONFIGSTRING_PLAYERS, "n\\Tony\\t\\0\\w\\1");
    roster_take_configstring(CONFIGSTRING_PLAYERS + int{max_slots}, "n\\Nobody\\t\\0");
    roster_take_configstring(CONFIGSTRING_PLAYERS - 1, "n\\Nobody\\t\\0");
    EXPECT_EQ(roster_version(), version);
    roster_take_configstring(CONFIGSTRING_PLAYERS, "n\\Tony\\t\\1");
    EXPECT_NE(roster_version(), version);
}

TEST(OpenArenaRoster, JunkGivesAnEntryThatIsInRange) {
    std::mt19937 random(11);
    std::uniform_int_distribution<std::size_t> length(0, 2000);
    const std::string alphabet = "nt\\\\\\^0123-9abc \x01\xff";
    std::uniform_int_distribution<std::size_t> letter(0, alphabet.size() - 1);
    for (int i = 0; i < 5000; ++i) {
        std::string text(length(random) % (i % 2 == 0 ? 20 : 2000), ' ');
        for (char& c : text) {
            c = alphabet[letter(random)];
        }
        const match_player entry = roster_parse(text.c_str());
        EXPECT_LE(entry.team, team_spectator);
        EXPECT_LT(std::string(entry.name).size(), sizeof entry.name);
        for (const char* c = entry.name; *c != '\0'; ++c) {
            EXPECT_TRUE(*c >= 0x20 && *c < 0x7f);
        }
    }
}

}  // namespace
}  // namespace camdir::openarena
