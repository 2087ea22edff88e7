// What a scenario of chaos may say.
#include "soak/scenario.hpp"

#include <gmock/gmock.h>

namespace camdir::soak {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& text) {
    const auto scenario = parse_scenario(text);
    return scenario ? "" : scenario.error().message;
}

TEST(ScenarioTest, ThoseThatShipAreValid) {
    for (const char* name : {"short.json", "every_act.json", "churn.json", "crowd.json", "dense_matches.json",
                             "floods.json", "long.json"}) {
        const auto scenario = read_scenario(std::string(CAMDIR_SCENARIOS) + "/" + name);
        ASSERT_TRUE(scenario) << scenario.error().message;
        EXPECT_FALSE(scenario->acts.empty()) << name;
    }
}

TEST(ScenarioTest, KeysAreStored) {
    const auto scenario = parse_scenario(
        R"({"seconds": 5, "observers": 3, "delay_s": 1.5, "acts": [{"act": "pause", "at_s": 2, "director": "standby"}]})");
    ASSERT_TRUE(scenario) << scenario.error().message;
    EXPECT_EQ(scenario->seconds, 5.0);
    EXPECT_EQ(scenario->observers, 3);
    EXPECT_EQ(scenario->delay_s, 1.5);
    ASSERT_EQ(scenario->acts.size(), 1U);
    EXPECT_EQ(scenario->acts[0].kind, ActKind::pause);
    EXPECT_EQ(scenario->acts[0].director, Role::standby);
    EXPECT_EQ(name_of(ActKind::pause), "pause");
}

TEST(ScenarioTest, EveryProblemIsNamedWithItsPointer) {
    const std::string error =
        error_of(R"({"matchs": 2, "seed": 1.5, "acts": [{"at_s": -1}, {"act": "kil", "at_s": 0}, 3]})");
    EXPECT_THAT(error, HasSubstr("/matchs: unknown key, did you mean \"matches\"?"));
    EXPECT_THAT(error, HasSubstr("/seed: 1.5: expected an integer from 0"));
    EXPECT_THAT(error, HasSubstr("/acts/0/act: missing: expected one of \"kill\""));
    EXPECT_THAT(error, HasSubstr("/acts/0/at_s: -1: expected a number from 0"));
    EXPECT_THAT(error, HasSubstr("/acts/1/act: \"kil\": expected one of"));
    EXPECT_THAT(error, HasSubstr("/acts/2: expected an object"));
}

TEST(ScenarioTest, WhatNeedsAStandbyIsRefusedWithoutOne) {
    EXPECT_THAT(error_of(R"({"directors": 1, "acts": [{"act": "hand_over", "at_s": 0}]})"),
                HasSubstr("/acts/0/act"));
    EXPECT_THAT(error_of(R"({"acts": [{"act": "kill", "at_s": 0, "director": "standby"}], "directors": 1})"),
                HasSubstr("/acts/0/director"));
}

TEST(ScenarioTest, TextThatIsNoObjectIsRefused) {
    EXPECT_NE(error_of("["), "");
    EXPECT_NE(error_of("[]"), "");
    EXPECT_THAT(error_of(R"({"acts": {}})"), HasSubstr("/acts: expected a list"));
}

}  // namespace
}  // namespace camdir::soak
