#include "http/status.hpp"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace camdir::http {
namespace {

using nlohmann::json;

TEST(Status, ShowsMapsMatchesShotsAndObservers) {
    director::MatchView match;
    match.match_id = "cup \"7\"";
    match.answered = true;
    match.state = "running";
    match.delay_s = 90.0;
    match.players = {{2, "anarki", "scout", 1}, {4, "doom", "", 2}};
    match.last_event =
        director::MatchEvent{.kind = 1, .actor = 4, .subject = 2, .value = 1.0F, .detail = "rail"};
    match.shots.push_back({5, 2, false, "default", 3, 2, {}, 0});
    match.shots.push_back(
        {6, director::no_player, true, "default", 1, 0, {.actor = 4, .subject = 9, .why = "kill"}, 77});
    match.shots.push_back({7, 9, false, "default", 1, 0, {}, 0});
    match.shots.push_back({8, 2, false, "default", 1, 2, {}, 0, {2, 9}});
    match.observers.push_back(
        {"anna", director::RequestState::waiting_for_player, 0, "player 9 is not in the match"});
    director::MatchView busy;
    busy.match_id = "busy";
    director::MapEntry failed;
    failed.state = director::LoadState::failed;
    failed.reason = "damaged";

    const json page = json::parse(
        status_page({{match, busy}}, {{"dm1", failed}}, [](const std::string& id) { return id == "busy"; }));
    EXPECT_EQ(page["maps"][0]["name"], "dm1");
    EXPECT_EQ(page["maps"][0]["state"], "failed");
    EXPECT_EQ(page["maps"][0]["reason"], "damaged");
    EXPECT_EQ(page["matches"][0]["match_id"], "cup \"7\"");
    EXPECT_EQ(page["matches"][0]["delay_s"], 90.0);
    const json anarki = {{"id", 2}, {"name", "anarki"}, {"class", "scout"}, {"team", 1}};
    EXPECT_EQ(page["matches"][0]["players"][0], anarki);
    EXPECT_EQ(page["matches"][0]["players"][1]["team"], 2);
    EXPECT_EQ(page["matches"][0]["last_event"]["kind"], "kill");
    EXPECT_EQ(page["matches"][0]["last_event"]["actor"]["name"], "doom");
    EXPECT_EQ(page["matches"][0]["last_event"]["subject"], anarki);
    EXPECT_EQ(page["matches"][0]["last_event"]["value"], 1.0);
    EXPECT_EQ(page["matches"][0]["last_event"]["detail"], "rail");
    EXPECT_EQ(page["matches"][0]["shots"][0]["target"], anarki);
    EXPECT_EQ(page["matches"][0]["shots"][2]["target"], json({{"id", 9}})) << "not listed";
    EXPECT_TRUE(page["matches"][0]["shots"][1]["target"].is_null());
    EXPECT_TRUE(page["matches"][0]["shots"][0]["group"].empty());
    EXPECT_EQ(page["matches"][0]["shots"][3]["group"], json({anarki, {{"id", 9}}}));
    EXPECT_TRUE(page["matches"][0]["shots"][0]["reason"].is_null()) << "an observer has chosen";
    EXPECT_EQ(page["matches"][0]["shots"][1]["reason"]["why"], "kill");
    EXPECT_EQ(page["matches"][0]["shots"][1]["reason"]["actor"]["name"], "doom");
    EXPECT_EQ(page["matches"][0]["shots"][1]["reason"]["subject"], json({{"id", 9}}));
    EXPECT_EQ(page["matches"][0]["shots"][1]["since"], 77);
    EXPECT_EQ(page["matches"][0]["observers"][0]["state"], "waiting for player");
    EXPECT_EQ(page["matches"][1]["state"], "no answer");
    EXPECT_EQ(page["matches"][0]["leads"], false);
    EXPECT_EQ(page["matches"][1]["leads"], true);
}

TEST(Status, NamesTheKindsOfEventsAndCarriesOthersAlong) {
    const auto shown = [](std::uint32_t kind) {
        director::MatchView match;
        match.answered = true;
        match.last_event = director::MatchEvent{.kind = kind};
        return json::parse(status_page(
            {{match}}, {}, [](const std::string&) { return true; }))["matches"][0]["last_event"]["kind"];
    };
    EXPECT_EQ(shown(2), "flag taken");
    EXPECT_EQ(shown(10), "weapon");
    for (const std::uint32_t unknown : {0U, 11U, 0xffffffffU})
        EXPECT_EQ(shown(unknown), unknown);
}

TEST(Status, AcceptsNamesThatAreNotUtf8) {
    director::MatchView match;
    match.match_id = "\xff\xfe";
    match.answered = true;
    EXPECT_TRUE(json::accept(status_page({{match}}, {}, [](const std::string&) { return true; })));
}

}  // namespace
}  // namespace camdir::http
