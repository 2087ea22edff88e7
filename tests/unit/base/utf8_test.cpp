#include "base/utf8.hpp"

#include <gtest/gtest.h>

namespace camdir {
namespace {

TEST(Utf8, PrefixEndsBetweenCharacters) {
    const std::string text = "a\u00e9\u20ac\U0001f600";  // 1, 2, 3 and 4 bytes
    const std::size_t ends[] = {0, 1, 1, 3, 3, 3, 6, 6, 6, 6, 10, 10};
    for (std::size_t most = 0; most < std::size(ends); ++most)
        EXPECT_EQ(utf8_prefix(text, most), ends[most]) << most;
}

TEST(Utf8, InvalidBytesBecomeQuestionMarks) {
    const std::string text = "a\u00e9\u20ac\U0001f600\u07ff\ud7ff\U0010ffff";
    EXPECT_EQ(to_utf8(text), text);
    EXPECT_EQ(to_utf8("caf\xe9 x"), "caf? x");
    EXPECT_EQ(to_utf8("\xe2\x82"), "??") << "cut off";
    EXPECT_EQ(to_utf8("\xc0\xaf"), "??") << "overlong";
    EXPECT_EQ(to_utf8("\xed\xa0\x80"), "???") << "a surrogate";
    EXPECT_EQ(to_utf8("\xf4\x90\x80\x80"), "????") << "beyond the last";
    EXPECT_EQ(to_utf8(""), "");
}

TEST(Utf8, WhatIsPrintedCommandsNoTerminal) {
    EXPECT_EQ(printable("caf\u00e9 ~\u00a0"), "caf\u00e9 ~\u00a0");
    EXPECT_EQ(printable("a\nb\tc\x1b[2J\x7f"), "a?b?c?[2J?");
    EXPECT_EQ(printable("\u0080\u009b2J\u009f"), "??2J?") << "as escape sequences are";
    EXPECT_EQ(printable("\x9b\xff"), "??");
}

}  // namespace
}  // namespace camdir
