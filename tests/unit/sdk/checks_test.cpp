#include "checks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "failure.hpp"

namespace camdir::sdk {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

TEST(Checks, MatchIdHasOneToSixtyThreeBytesAndNoWildcards) {
    EXPECT_EQ(checked_match_id("a"), "a");
    EXPECT_EQ(checked_match_id(std::string(63, 'x').c_str()), std::string(63, 'x'));
    EXPECT_EQ(checked_match_id("Pokal \xc3\xbc 7"), "Pokal \xc3\xbc 7");
    for (const std::string& wrong :
         {std::string(), std::string(64, 'x'), std::string("a/b"), std::string("*"), std::string("a?"),
          std::string("a\nb"), std::string("a\x7f")}) {
        EXPECT_THROW((void)checked_match_id(wrong.c_str()), Failure) << wrong;
    }
    EXPECT_THROW((void)checked_match_id(nullptr), Failure);
}

TEST(Checks, ObserverIdMayContainSlashAndWildcards) {
    EXPECT_EQ(checked_observer_id("anna/2?"), "anna/2?");
    EXPECT_THROW((void)checked_observer_id("a\tb"), Failure);
    EXPECT_THROW((void)checked_observer_id(""), Failure);
}

TEST(Checks, StringWithoutZeroByteIsNotReadBeyondItsEnd) {
    const std::vector<char> endless(8, 'x');  // the address sanitizer reports reading a ninth byte
    EXPECT_THROW((void)checked_string("name", endless.data(), 0, 7), Failure);
}

cdir_match_info valid_info() {
    cdir_match_info info = cdir_match_info_default();
    std::string("cup").copy(info.match_id, 63);
    std::string("oa_dm1").copy(info.map_name, 255);
    return info;
}

TEST(Checks, MatchInfoWithImpossibleNumbersIsRefused) {
    EXPECT_NO_THROW(check(valid_info(), {}));
    const std::vector<std::function<void(cdir_match_info&)>> defects = {
        [](auto& info) { info.map_name[0] = '\0'; },
        [](auto& info) { std::fill(std::begin(info.map_name), std::end(info.map_name), 'x'); },
        [](auto& info) { info.metres_per_unit = 0.0F; },
        [](auto& info) { info.metres_per_unit = nan; },
        [](auto& info) { info.rate_hz = -1.0F; },
        [](auto& info) { info.rate_hz = infinity; },
        [](auto& info) { info.spectator_delay_s = -0.5F; },
    };
    for (std::size_t i = 0; i < defects.size(); ++i) {
        cdir_match_info info = valid_info();
        defects[i](info);
        EXPECT_THROW(check(info, {}), Failure) << "defect " << i;
    }
}

TEST(Checks, PlayersAreDistinctAndNamed) {
    std::vector<cdir_player> players(2, cdir_player_default());
    players[0].id = 3;
    players[1].id = 4;
    EXPECT_NO_THROW(check(valid_info(), players));
    players[1].id = 3;
    EXPECT_THROW(check(valid_info(), players), Failure);
    for (const std::uint32_t reserved : {CDIR_NO_PLAYER, CDIR_SHOW_GROUP}) {
        players[1].id = reserved;
        EXPECT_THROW(check(valid_info(), players), Failure);
    }
    players[1].id = 4;
    std::fill(std::begin(players[1].player_class), std::end(players[1].player_class), 'x');
    EXPECT_THROW(check(valid_info(), players), Failure);
}

TEST(Checks, FrameTimesAreWithin73Years) {
    for (const std::int64_t far :
         {std::numeric_limits<std::int64_t>::min(), std::numeric_limits<std::int64_t>::max()}) {
        EXPECT_THROW(check_frame_time(far), Failure);
    }
    EXPECT_NO_THROW(check_frame_time(0));
}

std::string refusal(const cdir_match_event& event) {
    try {
        check(event);
        return "";
    } catch (const Failure& failure) {
        return failure.text;
    }
}

TEST(Checks, KindsOfEventsAreThoseOfTheHeaderAndOfLaterOnes) {
    cdir_match_event event = cdir_match_event_default();
    for (event.kind = CDIR_EVENT_KILL; event.kind <= CDIR_EVENT_WEAPON + 1; ++event.kind)
        EXPECT_EQ(refusal(event), "");
    event.kind = 0;
    EXPECT_NE(refusal(event), "");
}

TEST(Checks, DetailOfAnEventIsShortAndWithoutControlCharacters) {
    const auto with = [](const std::string& detail) {
        cdir_match_event event = cdir_match_event_default();
        detail.copy(event.detail, sizeof event.detail);
        return event;
    };
    for (const std::string& right : {std::string(), std::string("MOD_ROCKET"), std::string(31, 'x')})
        EXPECT_EQ(refusal(with(right)), "") << right;
    EXPECT_EQ(refusal(with(std::string(32, 'x'))),
              "an event's detail must have 0 to 31 bytes before its zero byte");
    for (const char* wrong : {"a\nb", "a\x7f"})
        EXPECT_EQ(refusal(with(wrong)), "an event's detail must not contain control characters") << wrong;
}

}  // namespace
}  // namespace camdir::sdk
