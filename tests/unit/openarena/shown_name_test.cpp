#include "shown_name.h"

#include <gtest/gtest.h>

#include <string>

namespace camdir::openarena {
namespace {

std::string replaced(const std::string& own, const std::string& other, std::size_t size = 1000) {
    std::string result(size, '\0');
    return shown_name_replace(own.c_str(), other.c_str(), result.data(), size) ? result.c_str() : "none";
}

TEST(OpenArenaShownName, ReplacesTheNameAlone) {
    EXPECT_EQ(replaced(R"(n\anna\t\3\model\sarge)", R"(n\^1Bob\t\0\model\rai)"),
              R"(n\^1Bob\t\3\model\sarge)");
    EXPECT_EQ(replaced(R"(t\3\n\anna)", R"(t\0\n\Bob\c1\4)"), R"(t\3\n\Bob)");
    EXPECT_EQ(replaced(R"(n\anna\t\3)", R"(n\\t\0)"), R"(n\\t\3)");
}

TEST(OpenArenaShownName, RefusesWhatCannotBeSent) {
    EXPECT_EQ(replaced("", R"(n\Bob\t\0)"), "none") << "an empty slot";
    EXPECT_EQ(replaced(R"(n\anna\t\3)", ""), "none");
    EXPECT_EQ(replaced(R"(n\anna\t\3)", R"(model\rai)"), "none");
    EXPECT_EQ(replaced(R"(n\anna\t\3)", "n\\B\"ob\\t\\0"), "none") << "a quote ends the engine's argument";
    EXPECT_EQ(replaced(R"(n\anna\t\3)", R"(n\Bob\t\0)", 9), "none");
    EXPECT_EQ(replaced(R"(n\anna\t\3)", R"(n\Bob\t\0)", 10), R"(n\Bob\t\3)");
}

}  // namespace
}  // namespace camdir::openarena
