#include "evaluation/events.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string_view>

#include "tiny_trace.hpp"

namespace camdir::evaluation {
namespace {

Result<std::vector<TraceEvent>> parse_rows(std::string_view text, const TakesKind& takes = {}) {
    Trace trace;
    trace.players = {4, 9};
    add_frame(trace, 0, {standing(4, {0, 0, 100}), standing(9, {0, 0, 100})});
    return parse_events(std::as_bytes(std::span(text)), "events.csv", trace, takes);
}

TEST(Events, OfEveryKindAreRead) {
    const auto events = parse_rows(
        "t_ms,kind,actor,subject,value\n100,item,9,,rl\n1256.5,damage,4,9,24\n2000,kill,1022,4,\n");
    ASSERT_TRUE(events) << events.error().message;
    ASSERT_EQ(events->size(), 3U);
    EXPECT_EQ((*events)[0].kind, "item");
    EXPECT_EQ((*events)[0].actor, 9U);
    EXPECT_EQ((*events)[0].subject, std::nullopt);
    EXPECT_EQ((*events)[0].detail, "rl");
    EXPECT_EQ((*events)[1].time, 1'256'500'000);
    EXPECT_EQ((*events)[1].subject, 9U);
    EXPECT_EQ((*events)[2].actor, std::nullopt);
}

TEST(Events, DeathsAreOfWhoDiedAlone) {
    const auto events =
        parse_rows("t_ms,kind,actor,subject\n1,death,,4\n2,death,4,4\n3,death,4,\n4,death,9,4\n5,kill,4,4\n");
    ASSERT_TRUE(events) << events.error().message;
    ASSERT_EQ(events->size(), 5U);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ((*events)[i].actor, std::nullopt) << i;
        EXPECT_EQ((*events)[i].subject, 4U) << i;
    }
    EXPECT_EQ((*events)[4].actor, 4U);
}

TEST(Events, OfKindsThatAreNotTakenMayNameAnyPlayer) {
    const auto takes = [](std::string_view kind) { return kind == "kill"; };
    const auto events = parse_rows("t_ms,kind,actor,subject\n100,jump,99,x\n200,kill,9,4\n", takes);
    ASSERT_TRUE(events) << events.error().message;
    ASSERT_EQ(events->size(), 1U);
    EXPECT_EQ((*events)[0].actor, 9U);
    const auto late = parse_rows("t_ms,kind,actor,subject\n300,jump,99,x\n200,kill,9,4\n", takes);
    ASSERT_FALSE(late);
    EXPECT_THAT(late.error().message, testing::HasSubstr("events.csv:3: column \"t_ms\" is before"));
}

TEST(Events, NeedNoDetail) {
    const auto events = parse_rows("t_ms,event,player,other\n100,kill,9,4\n");
    ASSERT_TRUE(events) << events.error().message;
    ASSERT_EQ(events->size(), 1U);
    EXPECT_EQ((*events)[0].detail, "");
}

TEST(Events, AreThoseOfOneMatchAtMost) {
    std::string text = "t_ms,event,player,other\n";
    for (std::size_t i = 0; i < max_events; ++i)
        text += "1,a,,\n";
    const auto events = parse_rows(text);
    ASSERT_TRUE(events) << events.error().message;
    EXPECT_EQ(events->size(), max_events);
    const auto more = parse_rows(text + "1,a,,\n");
    ASSERT_FALSE(more);
    EXPECT_THAT(more.error().message, testing::HasSubstr("events.csv:1000002: more than 1000000 events"));
}

TEST(Events, ErrorsNameTheLineAndTheReason) {
    const auto error_of = [](std::string_view text) {
        const auto events = parse_rows(text);
        return events ? "no error" : events.error().message;
    };
    const std::string header = "t_ms,event,player,other,detail\n";
    EXPECT_THAT(error_of("t_ms,event,player\n"),
                testing::HasSubstr("events.csv:1: the header lacks the column \"other\""));
    EXPECT_THAT(error_of(header + "1,kill,5,9,\n"),
                testing::HasSubstr("events.csv:2: column \"player\" is 5, expected a player of the trace"));
    EXPECT_THAT(error_of(header + "1,kill,4,x,\n"), testing::HasSubstr("column \"other\" is \"x\""));
    EXPECT_THAT(error_of(header + "-1,kill,4,9,\n"), testing::HasSubstr("column \"t_ms\" is \"-1\""));
    EXPECT_THAT(error_of(header + "2,kill,4,9,\n1,kill,4,9,\n"),
                testing::HasSubstr("events.csv:3: column \"t_ms\" is before the last row's"));
}

}  // namespace
}  // namespace camdir::evaluation
