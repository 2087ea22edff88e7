#include "game/setting.h"

#include <gtest/gtest.h>

#include <limits>
#include <string>

namespace camdir::game {
namespace {

TEST(Setting, ADomainThatIsNoneIsNotAnotherOne) {
    EXPECT_EQ(setting_domain("0"), 0U);
    EXPECT_EQ(setting_domain("230"), 230U);
    EXPECT_EQ(setting_domain("231"), 231U) << "which the client library refuses";
    for (const char* text : {"", "-1", "+1", " 1", "abc", "1x", "1.5", "99999999999999999999"})
        EXPECT_EQ(setting_domain(text), std::numeric_limits<std::uint32_t>::max()) << text;
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
