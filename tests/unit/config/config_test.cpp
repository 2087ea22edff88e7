#include "config/config.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace camdir::config {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

Config good(const std::string& text) {
    auto config = parse(text, "test", "/etc/director");
    EXPECT_TRUE(config) << config.error().message;
    return config.value_or(Config{});
}

std::string problem(const std::string& text) {
    const auto config = parse(text, "test", "");
    return config ? "no problem" : config.error().message;
}

TEST(Config, EmptyObjectGivesTheDefaults) {
    const Config config = good("{}");
    EXPECT_EQ(config.http.address, "127.0.0.1");
    EXPECT_EQ(config.dds.partitions, std::vector<std::string>{"match/*"});
    EXPECT_EQ(config.dds.security, "");
    EXPECT_FALSE(config.dds.insecure);
    EXPECT_TRUE(config.profiles.contains("default"));
    EXPECT_TRUE(config.maps.empty());
}

TEST(Config, ReadsKeysOfEverySection) {
    const Config config = good(R"({
        "dds": {"domain": 7, "peers": ["a", "b:7411"]},
        "maps": [{"name": "dm1", "file": "dm1.vfs", "source": "/maps/pak.pk3:maps/dm1.bsp",
                  "d0": 24.5, "loss": 3, "triangles": 5000}],
        "profiles": {"close": {"distance": 60}},
        "matches": {"default_profile": "close"}})");
    EXPECT_EQ(config.dds.domain, 7);
    EXPECT_THAT(config.dds.peers, ElementsAre("a", "b:7411"));
    ASSERT_EQ(config.maps.size(), 1U);
    EXPECT_EQ(config.maps[0].d0, 24.5);
    EXPECT_EQ(config.maps[0].loss, 3.0);
    EXPECT_EQ(config.maps[0].triangles, 5000);
    EXPECT_EQ(config.profiles.at("close").distance, 60.0F);
    EXPECT_EQ(config.matches.default_profile, "close");
}

TEST(Config, ResolvesRelativePathsFromTheFilesFolder) {
    const Config config = good(R"({"maps": [{"name": "a", "file": "x/a.vfs", "source": "pak.pk3:maps/a.bsp"},
                                            {"name": "b", "file": "/data/b.vfs"}],
                                   "dds": {"security": "identity"}, "http": {"token_file": "token"}})");
    EXPECT_EQ(config.dds.security, "/etc/director/identity");
    EXPECT_EQ(config.http.token_file, "/etc/director/token");
    EXPECT_EQ(config.maps[0].file, "/etc/director/x/a.vfs");
    EXPECT_EQ(config.maps[0].source, "/etc/director/pak.pk3:maps/a.bsp");
    EXPECT_EQ(config.maps[1].file, "/data/b.vfs");
    EXPECT_EQ(config.maps[1].source, "");
}

TEST(Config, ReportsEveryProblem) {
    const std::string problems =
        problem(R"({"dds": {"domain": 999, "domian": 1}, "http": {"port": "x"}, "mapps": []})");
    EXPECT_THAT(problems, AllOf(HasSubstr("test: /dds/domain: 999: expected an integer from 0 to 230\n"),
                                HasSubstr("test: /dds/domian: unknown key, did you mean \"domain\"?"),
                                HasSubstr("test: /http/port: \"x\": expected an integer from 0 to 65535"),
                                HasSubstr("test: /mapps: unknown key, did you mean \"maps\"?")));
}

TEST(Config, SuggestsOnlySimilarKeys) {
    EXPECT_THAT(problem(R"({"http": {"completely_else": 1}})"),
                AllOf(HasSubstr("/http/completely_else: unknown key"), Not(HasSubstr("did you mean"))));
}

TEST(Config, RefusesDuplicates) {
    EXPECT_THAT(problem(R"({"http": {"port": 1, "port": 2}})"), HasSubstr("duplicate key \"port\""));
    EXPECT_THAT(problem(R"({"maps": [{"name": "a", "file": "1"}, {"name": "a", "file": "2"}]})"),
                HasSubstr("/maps/1/name: \"a\": expected a name that no other map has"));
    EXPECT_THAT(problem(R"({"maps": [{"name": "a", "file": "1"}, {"name": "b", "file": "1"}]})"),
                HasSubstr("/maps/1/file: \"1\": expected a file that no other map has"));
    EXPECT_THAT(problem(R"({"maps": [{"name": "a", "file": "1"}, {"name": "b", "file": "x/../1"}]})"),
                HasSubstr("/maps/1/file: \"x/../1\": expected a file that no other map has"));
}

TEST(Config, RefusesToBakeOverASource) {
    for (const char* source : {"a.bsp", "./a.bsp", "a.bsp:maps/a.bsp"})
        EXPECT_THAT(problem(R"({"maps": [{"name": "a", "file": "a.bsp", "source": ")" + std::string(source) +
                            R"("}]})"),
                    HasSubstr("/maps/0/file: \"a.bsp\": expected a file that is not a map's source"));
    EXPECT_THAT(problem(R"({"maps": [{"name": "a", "file": "a.vfs", "source": "p.pk3:maps/a.bsp"},
                                     {"name": "b", "file": "p.pk3"}]})"),
                HasSubstr("/maps/1/file: \"p.pk3\": expected a file that is not a map's source"));
    const auto absolute =
        parse(R"({"maps": [{"name": "a", "file": "/etc/director/a.bsp", "source": "a.bsp"}]})", "test",
              "/etc/director");
    ASSERT_FALSE(absolute);
    EXPECT_THAT(absolute.error().message, HasSubstr("expected a file that is not a map's source"));
}

TEST(Config, ADirectorOfShardsHasOneOfItsOwn) {
    EXPECT_EQ(problem(R"({"dds": {"shards": ["a", "b"], "shard": "a"}})"), "no problem");
    EXPECT_EQ(problem(R"({"dds": {"shards": ["a", "b"], "shard": "gone"}})"), "no problem")
        << "it is drained";
    EXPECT_THAT(problem(R"({"dds": {"shards": ["a", "b"]}})"),
                HasSubstr("/dds/shard: \"\": expected the name of this director's shard"));
    EXPECT_THAT(problem(R"({"dds": {"shard": "a"}})"),
                HasSubstr("/dds/shard: \"a\": expected an empty string where there are no shards"));
    EXPECT_THAT(problem(R"({"dds": {"shards": ["a", "b", "a"], "shard": "a"}})"),
                HasSubstr("/dds/shards: [\"a\",\"b\",\"a\"]: expected names that differ"));
}

TEST(Config, AShardFromElsewhereTakesThePlaceOfTheFiles) {
    for (const char* text :
         {R"({"dds": {"shards": ["a", "b"]}})", R"({"dds": {"shards": ["a", "b"], "shard": "a"}})"}) {
        const auto config = parse(text, "test", "", "b");
        ASSERT_TRUE(config) << config.error().message;
        EXPECT_EQ(config->dds.shard, "b");
    }
    const auto without_shards = parse("{}", "test", "", "b");
    ASSERT_FALSE(without_shards);
    EXPECT_THAT(without_shards.error().message,
                HasSubstr("/dds/shard: \"b\": expected an empty string where there are no shards"));
}

TEST(Config, RefusesMissingKeys) {
    EXPECT_THAT(problem(R"({"maps": [{"file": "1"}]})"),
                HasSubstr("/maps/0/name: missing: expected a string"));
}

TEST(Config, RefusesWrongShapes) {
    EXPECT_THAT(problem("[]"), HasSubstr("expected an object"));
    EXPECT_THAT(problem(R"({"maps": {}})"), HasSubstr("/maps: {}: expected a list"));
    EXPECT_THAT(problem(R"({"maps": [1]})"), HasSubstr("/maps/0: 1: expected an object"));
    EXPECT_THAT(problem(R"({"profiles": {"a": 1}})"), HasSubstr("/profiles/a: 1: expected an object"));
    EXPECT_THAT(problem(R"({"dds": 1})"), HasSubstr("/dds: 1: expected an object"));
}

TEST(Config, RefusesBrokenText) {
    EXPECT_THAT(problem("{\"dds\": }"), AllOf(HasSubstr("test: "), HasSubstr("line 1, column 9")));
    EXPECT_NE(problem(""), "no problem");
    EXPECT_NE(problem("{} {}"), "no problem");
    EXPECT_NE(problem("{\"http\": {\"address\": \"\xff\"}}"), "no problem");
    EXPECT_THAT(problem(std::string(100000, '[')), Not(HasSubstr("no problem")));
    EXPECT_THAT(problem(std::string(1000, '[') + std::string(1000, ']')), HasSubstr("nested deeper"));
    EXPECT_NE(problem(R"({"dds": {"domain": 1e999}})"), "no problem");
}

TEST(Config, RefusesAnUnknownDefaultProfile) {
    EXPECT_THAT(problem(R"({"matches": {"default_profile": "x"}})"),
                HasSubstr("/matches/default_profile: \"x\": expected the name of a profile"));
}

TEST(Config, RefusesProfileNamesThatDoNotFitIntoARequest) {
    EXPECT_THAT(problem(R"({"profiles": {"": {}}})"),
                HasSubstr("/profiles/: \"\": expected a name of 1 to 31 bytes"));
    EXPECT_NE(problem("{\"profiles\": {\"" + std::string(32, 'p') + "\": {}}}"), "no problem");
}

TEST(Config, EscapesPointers) {
    EXPECT_THAT(problem(R"({"profiles": {"a/b~c": {"distance": "x"}}})"),
                HasSubstr("/profiles/a~1b~0c/distance: "));
    EXPECT_THAT(problem(R"({"\u001b[31mred\n": 1})"), HasSubstr("/?[31mred?: "));
    EXPECT_THAT(problem("{\"" + std::string(100000, 'x') + "\": 1}"),
                HasSubstr("/" + std::string(60, 'x') + "...: "));
}

TEST(Config, NamesTheKeysWhereNoneIsLikeIt) {
    EXPECT_THAT(problem(R"({"moments": {"kill": {"weight": 1}}})"),
                HasSubstr("/moments/kill/weight: unknown key, expected one of trigger, "));
}

TEST(Config, LeavesOutErrorsBeyondWhatPeopleRead) {
    std::string many = "{";
    for (int i = 0; i < 1000; ++i)
        many += "\"key " + std::to_string(i) + "\": 1, ";
    EXPECT_THAT(problem(many + "\"last\": 1}"), HasSubstr("errors left out: 961"));
}

TEST(Config, SurvivesMutations) {
    const std::string seed =
        R"({"dds": {"domain": 7, "peers": ["a"]}, "maps": [{"name": "a", "file": "b", "d0": 2.5}],
                                 "profiles": {"p": {"distance": 60}}, "log": {"level": "info"}})";
    std::mt19937 random(20260105);
    std::size_t refused = 0;
    for (int round = 0; round < 2000; ++round) {
        std::string text = seed;
        for (int change = 0; change < 3; ++change)
            text[random() % text.size()] = static_cast<char>(random() % 256);
        const auto config = parse(text, "test", "");
        if (config) continue;
        ++refused;
        EXPECT_THAT(config.error().message, HasSubstr("test: "));
    }
    EXPECT_GT(refused, 1000U);
}

TEST(Overrides, ChangeWhatTheyName) {
    camera::Profile base;
    base.distance = 200.0F;
    const auto profile = override_profile(base, R"({"vertical_fov": 40})", std::nullopt);
    ASSERT_TRUE(profile) << profile.error().message;
    EXPECT_EQ(profile->distance, 200.0F);
    EXPECT_EQ(profile->vertical_fov, 40.0F);
    EXPECT_EQ(override_profile(base, "", std::nullopt)->distance, 200.0F);
}

TEST(Overrides, AreRefusedInOneLine) {
    const auto profile = override_profile({}, R"({"distanse": 1, "vertical_fov": 1000})", std::nullopt);
    ASSERT_FALSE(profile);
    EXPECT_THAT(profile.error().message,
                AllOf(HasSubstr("/distanse: unknown key, did you mean \"distance\"?"),
                      HasSubstr("; /vertical_fov: 1000: expected a number from"), Not(HasSubstr("\n"))));
    EXPECT_FALSE(override_profile({}, "[]", std::nullopt));
    EXPECT_FALSE(override_profile({}, "{", std::nullopt));
}

TEST(Overrides, KeepToTheRangesOfTheFile) {
    const Config config = good(R"({"overrides": {"distance": [80, 200], "solver": ["planner"]}})");
    const auto refusal = [&](const std::string& overrides) {
        const auto profile = override_profile({}, overrides, config.overrides);
        return profile ? "" : profile.error().message;
    };
    for (const char* allowed : {"", "{}", R"({"distance": 80})", R"({"distance": 200, "solver": "planner"})"})
        EXPECT_EQ(refusal(allowed), "") << allowed;
    EXPECT_EQ(refusal(R"({"distance": 79.5})"),
              "/distance: 79.5: expected a number from 80.0 to 200.0, the range here");
    EXPECT_EQ(refusal(R"({"distance": 201})"),
              "/distance: 201: expected a number from 80.0 to 200.0, the range here");
    EXPECT_EQ(refusal(R"({"solver": "paper"})"),
              R"(/solver: "paper": expected one of ["planner"], the choice here)");
    EXPECT_EQ(refusal(R"({"elevation": 1})"),
              "/elevation: may not be overridden here; may be: distance, solver");

    const Config nothing = good(R"({"overrides": {}})");
    EXPECT_EQ(override_profile({}, R"({"distance": 100})", nothing.overrides).error().message,
              "/distance: may not be overridden here; may be: nothing");
}

TEST(Overrides, RangesThatMakeNoSenseAreErrors) {
    EXPECT_EQ(problem(R"({"overrides": 3})"), "test: /overrides: 3: expected an object of ranges by key");
    for (const char* range :
         {"5", "[]", "[80]", "[80, 90, 100]", "[90, 80]", "[1, 80]", "[80, 3000]", R"(["a", "b"])"})
        EXPECT_THAT(problem(std::string(R"({"overrides": {"distance": )") + range + "}}"),
                    AllOf(HasSubstr("test: /overrides/distance: "),
                          HasSubstr("expected [min, max], each a number from 20 to 2000")))
            << range;
    for (const char* choices : {"5", "[]", R"(["plan"])", "[1, 2]"})
        EXPECT_THAT(problem(std::string(R"({"overrides": {"solver": )") + choices + "}}"),
                    HasSubstr("test: /overrides/solver: "))
            << choices;
    EXPECT_THAT(problem(R"({"overrides": {"distanse": [80, 90]}})"),
                HasSubstr("test: /overrides/distanse: unknown key, did you mean \"distance\"?"));
    EXPECT_THAT(problem(R"({"overrides": {"completely_else": [80, 90]}})"),
                HasSubstr("test: /overrides/completely_else: unknown key, expected one of "));
}

TEST(Profiles, ThatShipAreThereAndAFileChangesSingleKeysOfThem) {
    const Config config = good(R"({"profiles": {"tactical": {"vertical_fov": 80}}})");
    for (const auto& [name, use, profile] : camera::shipped_profiles()) {
        const auto found = config.profiles.find(name);
        ASSERT_NE(found, config.profiles.end()) << name;
        EXPECT_EQ(found->second.distance, profile.distance) << name;
        for (const camera::ProfileKey& key : camera::profile_keys()) {
            EXPECT_GE(profile.*key.member, key.minimum) << name << ' ' << key.name;
            EXPECT_LE(profile.*key.member, key.maximum) << name << ' ' << key.name;
        }
    }
    EXPECT_EQ(config.profiles.at("tactical").vertical_fov, 80.0F);
}

TEST(Changes, NamesOnlyKeysThatNeedARestart) {
    const Config running = good("{}");
    const Config loaded = good(R"({"http": {"port": 1}, "limits": {"workers": 3}, "log": {"level": "debug"},
                                   "profiles": {"x": {}}, "maps": [{"name": "a", "file": "b"}]})");
    EXPECT_THAT(changes_for_restart(running, loaded), ElementsAre("/http/port", "/limits/workers"));
    EXPECT_TRUE(changes_for_restart(running, running).empty());
}

TEST(Moments, ChangeSingleKeysOfARuleOrAddOne) {
    const Config config = good(R"({"direction": {"preferred_shot_s": 4.5},
        "moments": {"kill": {"worth": 9}, "duel": {"trigger": "sight", "range": 300, "worth": 0.5}}})");
    const direction::Rules shipped = direction::default_rules();
    EXPECT_EQ(config.direction.grammar.preferred_shot_s, 4.5);
    EXPECT_EQ(config.direction.grammar.cut, shipped.grammar.cut);
    ASSERT_EQ(config.direction.moments.size(), shipped.moments.size() + 1);
    const auto rule = [](const direction::Rules& rules, const std::string& name) {
        return *std::ranges::find(rules.moments, name, &direction::Rule::name);
    };
    EXPECT_EQ(rule(config.direction, "kill").worth, 9.0);
    EXPECT_EQ(rule(config.direction, "kill").before_s, rule(shipped, "kill").before_s);
    EXPECT_EQ(rule(config.direction, "duel").trigger, direction::Trigger::sight);
    EXPECT_EQ(rule(config.direction, "duel").range, 300.0);
}

TEST(Moments, ErrorsSayWhatARuleNeeds) {
    EXPECT_THAT(problem(R"({"moments": []})"),
                HasSubstr("/moments: []: expected an object of rules by name"));
    EXPECT_THAT(problem(R"({"moments": {"duel": {"worth": 1}}})"),
                HasSubstr("/moments/duel/trigger: missing: expected one of \"sight\""));
    EXPECT_THAT(problem(R"({"moments": {"multi_kill": {"worth": 1}}})"),
                HasSubstr(", for no such rule ships, did you mean \"multi-kill\"?"));
    EXPECT_THAT(problem(R"({"moments": {"\u001b[31mboom1": {}, "\u001b[31mboom2": {}}})"),
                AllOf(HasSubstr("did you mean \"?[31mboom1\"?"), Not(HasSubstr("\x1b"))));
    EXPECT_THAT(problem(R"({"moments": {"kill": {"trigger": "boredom"}}})"),
                HasSubstr("/moments/kill/trigger: \"boredom\": expected one of \"sight\""));
    EXPECT_THAT(problem(R"({"moments": {"kill": {"wort": 1}}})"), HasSubstr("did you mean \"worth\"?"));
    EXPECT_EQ(
        problem(R"({"moments": {"kill": {"range": 300, "facing": 90}}})"),
        "test: /moments/kill/range: 300: expected nothing, for the trigger of the rule is not \"sight\"\n"
        "test: /moments/kill/facing: 90: expected nothing, for the trigger of the rule is not \"sight\"");
    EXPECT_THAT(problem(R"({"moments": {"duel": {"trigger": "sigth", "range": 300}}})"),
                AllOf(HasSubstr("/moments/duel/trigger: \"sigth\""), Not(HasSubstr("/range"))));
    EXPECT_EQ(problem(R"({"moments": {"lost sight": {"trigger": "kill"}}})"),
              "test: /moments/lost sight: \"lost sight\": expected another name: the director's own reasons "
              "have this one");
    EXPECT_EQ(problem(R"({"moments": {"frag \u00e9": {"trigger": "kill"}}})"), "no problem");
    for (const char* name : {"", "a,b", "a\\\"b", "a\\nb", "a\\u007f", "12345678901234567890123456789012"})
        EXPECT_THAT(problem(R"({"moments": {")" + std::string(name) + R"(": {"trigger": "kill"}}})"),
                    HasSubstr("expected a name of 1 to 31 bytes without commas"))
            << name;
    EXPECT_THAT(problem(R"({"matches": {"automatic_hold_s": 4}})"),
                HasSubstr("/matches/automatic_hold_s: no longer a key: use /direction/minimum_shot_s"));
    std::string many;
    for (int i = 0; i < 60; ++i)
        many += (i > 0 ? ", \"rule " : "\"rule ") + std::to_string(i) + R"(": {"trigger": "kill"})";
    EXPECT_THAT(problem(R"({"moments": {)" + many + "}}"), HasSubstr("expected at most 64"));
}

}  // namespace
}  // namespace camdir::config
