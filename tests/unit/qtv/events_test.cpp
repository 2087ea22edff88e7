#include "events.hpp"

#include <gtest/gtest.h>

namespace camdir::qtv {
namespace {

using quakeworld::Occurrence;
using Kind = Occurrence::Kind;

void expect(const Occurrence& occurrence, std::uint32_t kind, std::uint32_t actor, std::uint32_t subject,
            float value, const std::string& detail) {
    const auto event = event_of(occurrence, 3);
    EXPECT_EQ(event.kind, kind) << occurrence.detail;
    EXPECT_EQ(event.frame_time, occurrence.time * 1'000'000);
    EXPECT_EQ(event.actor, actor) << occurrence.detail;
    EXPECT_EQ(event.subject, subject) << occurrence.detail;
    EXPECT_EQ(event.value, value) << occurrence.detail;
    EXPECT_EQ(event.detail, detail);
}

TEST(Events, AreInTheClientLibrarysTerms) {
    expect({5, Kind::obituary, 1, 2, "rl"}, CDIR_EVENT_KILL, 1, 2, 1.0F, "rl");
    expect({5, Kind::obituary, {}, 2, "fall"}, CDIR_EVENT_KILL, CDIR_NO_PLAYER, 2, 0.0F, "fall");
    expect({5, Kind::obituary, {}, 2, "self"}, CDIR_EVENT_KILL, 2, 2, -1.0F, "self");
    expect({5, Kind::obituary, 1, {}, "team"}, CDIR_EVENT_KILL, 1, CDIR_NO_PLAYER, -1.0F, "team");
    expect({5, Kind::damage, {}, 2, "70"}, CDIR_EVENT_DAMAGE, CDIR_NO_PLAYER, 2, 70.0F, "");
    expect({5, Kind::item, 1, {}, "quad"}, CDIR_EVENT_ITEM, 1, CDIR_NO_PLAYER, 0.0F, "quad");
    expect({5, Kind::match_begin, {}, {}, ""}, CDIR_EVENT_ROUND, CDIR_NO_PLAYER, CDIR_NO_PLAYER, 3.0F,
           "begin");
    expect({5, Kind::match_end, {}, {}, ""}, CDIR_EVENT_ROUND, CDIR_NO_PLAYER, CDIR_NO_PLAYER, 3.0F, "end");
}

}  // namespace
}  // namespace camdir::qtv
