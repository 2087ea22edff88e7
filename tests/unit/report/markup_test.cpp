#include "report/markup.hpp"

#include <gtest/gtest.h>

namespace camdir::report {
namespace {

TEST(Markup, EscapesWhatHtmlWouldRead) {
    EXPECT_EQ(escape("<b title=\"a\" id='b'>&amp;</b>"),
              "&lt;b title=&quot;a&quot; id=&#39;b&#39;&gt;&amp;amp;&lt;/b&gt;");
    EXPECT_EQ(escape("caf\xc3\xa9 \xff\x01"), "caf\xc3\xa9 ? ");
}

// The test vectors of RFC 4648.
TEST(Markup, EncodesPictures) {
    const auto encoded = [](std::string_view text) {
        const std::string uri = png_uri(std::as_bytes(std::span(text)));
        return uri.substr(uri.find(',') + 1);
    };
    EXPECT_EQ(encoded(""), "");
    EXPECT_EQ(encoded("f"), "Zg==");
    EXPECT_EQ(encoded("fo"), "Zm8=");
    EXPECT_EQ(encoded("foo"), "Zm9v");
    EXPECT_EQ(encoded("foob"), "Zm9vYg==");
    EXPECT_EQ(encoded("fooba"), "Zm9vYmE=");
    EXPECT_EQ(encoded("foobar"), "Zm9vYmFy");
    EXPECT_EQ(encoded("\xfb\xff"), "+/8=");
}

TEST(Markup, QuotesForAShell) {
    EXPECT_EQ(shell_word("maps/a-1.csv"), "maps/a-1.csv");
    EXPECT_EQ(shell_word("my match.csv"), "'my match.csv'");
    EXPECT_EQ(shell_word("it's $(here)"), "'it'\\''s $(here)'");
    EXPECT_EQ(shell_word(""), "''");
}

TEST(Markup, WritesShortNumbers) {
    EXPECT_EQ(decimal(12.340, 3), "12.34");
    EXPECT_EQ(decimal(1e6, 0), "1000000");
    EXPECT_EQ(decimal(-0.001, 2), "0");
    EXPECT_EQ(decimal(100.0, 1), "100");
}

}  // namespace
}  // namespace camdir::report
