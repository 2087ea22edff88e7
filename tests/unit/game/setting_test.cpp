#include "game/setting.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace camdir::game {
namespace {

TEST(Setting, ADomainThatIsNoneIsNotAnotherOne) {
    char error[128] = "";
    const auto domain = [&](const char* text) {
        error[0] = '\0';
        return setting_domain("director_domain", text, error, sizeof error);
    };
    EXPECT_EQ(domain("0"), 0U);
    EXPECT_EQ(domain("230"), 230U);
    EXPECT_STREQ(error, "");
    for (const char* text : {"231", "", "-1", "+1", " 1", "abc", "1x", "1.5", "99999999999999999999"}) {
        EXPECT_EQ(domain(text), std::numeric_limits<std::uint32_t>::max()) << text;
        EXPECT_EQ(error, "director_domain '" + std::string(text) + "': expected a number from 0 to 230");
    }
}

TEST(Setting, ATextThatDoesNotFitIsAnError) {
    char text[8] = "before", error[64] = "";
    setting_text(text, sizeof text, "director_match", "1234567", error, sizeof error);
    EXPECT_STREQ(text, "1234567");
    EXPECT_STREQ(error, "");
    setting_text(text, sizeof text, "director_match", "12345678", error, sizeof error);
    EXPECT_STREQ(text, "1234567");
    EXPECT_STREQ(error, "director_match is longer than 7 bytes");
}

}  // namespace
}  // namespace camdir::game
