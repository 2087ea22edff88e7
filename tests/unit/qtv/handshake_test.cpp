#include "handshake.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camdir::qtv {
namespace {

using testing::HasSubstr;

Result<std::optional<Answer>> answer_to(const std::string& text) {
    return read_answer(std::as_bytes(std::span(text)));
}

TEST(Handshake, AsksForAStream) {
    EXPECT_EQ(text_of(StreamRequest{}), "QTV\nVERSION: 1\n\n");
    EXPECT_EQ(text_of(StreamRequest{"3", "a b"}),
              "QTV\nVERSION: 1\nSOURCE: 3\nAUTH: PLAIN\nPASSWORD: \"a b\"\n\n");
}

TEST(Handshake, RefusesWhatTheProtocolCannotCarry) {
    EXPECT_TRUE(check({"1@host", "a b"}));
    EXPECT_EQ(check({"3\n", ""}).error().message, "the source has a quotation mark or a control character");
    EXPECT_EQ(check({"", "\""}).error().message, "the password has a quotation mark or a control character");
}

TEST(Handshake, TheAnswerEndsWithAnEmptyLine) {
    const std::string begin = "QTVSV 1\nBEGIN\n\n";
    for (std::size_t size = 0; size < begin.size(); ++size) {
        const auto answer = answer_to(begin.substr(0, size));
        ASSERT_TRUE(answer) << answer.error().message;
        EXPECT_FALSE(*answer) << size;
    }
    const auto answer = answer_to(begin + std::string("\0\6", 2));
    EXPECT_EQ((*answer)->kind, Answer::Kind::begin);
    EXPECT_EQ((*answer)->size, begin.size());
    EXPECT_EQ((*answer_to("QTVSV 1.2\nX: y\nBEGIN: a name\n\n"))->kind, Answer::Kind::begin);
}

TEST(Handshake, RefusalsHaveTheServersReason) {
    const auto refused = answer_to("QTVSV 1\nPERROR: Bad password.\x1b\n\n");
    EXPECT_EQ((*refused)->kind, Answer::Kind::refused);
    EXPECT_EQ((*refused)->reason, "Bad password.?");
    for (const char* text : {"QTVSV 1\nERROR: full\n\n", "QTVSV 1\nTERROR: full\n\n"}) {
        const auto busy = answer_to(text);
        EXPECT_EQ((*busy)->kind, Answer::Kind::busy);
        EXPECT_EQ((*busy)->reason, "full");
    }
    EXPECT_EQ((*answer_to("QTVSV 1\nERROR\n\n"))->reason, "no reason given");
}

TEST(Handshake, OtherServersAreNoQtvServers) {
    EXPECT_EQ(answer_to("HTTP/1.1 400\r\n").error().message,
              "byte 0: 'HTTP/1', expected 'QTVSV ' of a QTV server");
    EXPECT_FALSE(answer_to("Q\n")->has_value()) << "the error says as much, wherever the answer is parted";
    EXPECT_THAT(answer_to("QTVSV 1\n\n").error().message, HasSubstr("begins no stream"));
    EXPECT_THAT(answer_to("QTVSV 1\n" + std::string(5000, 'a')).error().message,
                HasSubstr("within 4096 bytes"));
}

}  // namespace
}  // namespace camdir::qtv
