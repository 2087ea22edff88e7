// Properties of every key of the table.
#include "config/keys.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace camdir::config {
namespace {

using nlohmann::json;
using testing::HasSubstr;

// A valid document in which `key` has `value`.
json document_with(const Key& key, const json& value) {
    json document = {{"maps", json::array({{{"name", "m"}, {"file", "m.vfs"}}})},
                     {"profiles", {{"p", json::object()}}}};
    if (key.section == "/maps/*")
        document["maps"][0][key.name] = value;
    else if (key.section == "/profiles/*")
        document["profiles"]["p"][key.name] = value;
    else if (key.section == "/moments/*")
        document["moments"]["sight"][key.name] = value;
    else
        document[json::json_pointer(key.section + "/" + key.name)] = value;
    return document;
}

std::string pointer_of(const Key& key) {
    if (key.section == "/maps/*") return "/maps/0/" + key.name;
    if (key.section == "/profiles/*") return "/profiles/p/" + key.name;
    if (key.section == "/moments/*") return "/moments/sight/" + key.name;
    return key.section + "/" + key.name;
}

Result<Config> parsed(const Key& key, const json& value) {
    return parse(document_with(key, value).dump(), "test", "");
}

void expect_refused(const Key& key, const json& value) {
    const auto config = parsed(key, value);
    ASSERT_FALSE(config) << pointer_of(key) << " = " << value;
    EXPECT_THAT(config.error().message, HasSubstr("test: " + pointer_of(key) + ": " + value.dump()));
    EXPECT_THAT(config.error().message, HasSubstr(expected(key)));
}

bool is_number(const Key& key) {
    return type_name(key) == "integer" || type_name(key) == "number";
}

json number_of(const Key& key, double number) {
    return type_name(key) == "integer" ? json(static_cast<std::int64_t>(number)) : json(number);
}

TEST(EveryKey, AcceptsItsDefault) {
    for (const Key& key : keys()) {
        if (key.required) continue;
        const auto config = parsed(key, default_of(key));
        ASSERT_TRUE(config) << config.error().message;
    }
}

TEST(EveryKey, AcceptsItsBoundsAndNothingBeyond) {
    for (const Key& key : keys()) {
        if (!is_number(key)) continue;
        const bool whole = type_name(key) == "integer";
        ASSERT_LE(key.minimum, key.maximum);
        for (const double inside : {key.minimum, key.maximum}) {
            const auto config = parsed(key, number_of(key, inside));
            EXPECT_TRUE(config) << config.error().message;
        }
        const double step = whole ? 1.0 : 0.001 * (1.0 + std::abs(key.maximum));
        expect_refused(key, number_of(key, key.minimum - step));
        expect_refused(key, number_of(key, key.maximum + step));
    }
}

TEST(EveryKey, AcceptsZeroForItsDefaultButNothingBetweenItAndTheMinimum) {
    for (const Key& key : keys()) {
        if (!key.zero_is_default) continue;
        ASSERT_GT(key.minimum, 0.0);
        EXPECT_EQ(default_of(key), 0.0);
        for (const double between : {1e-300, key.minimum / 2.0, std::nextafter(key.minimum, 0.0)})
            expect_refused(key, between);
        expect_refused(key, -key.minimum);
    }
}

TEST(EveryKey, RefusesOtherTypes) {
    for (const Key& key : keys()) {
        const std::string type = type_name(key);
        expect_refused(key, json());
        expect_refused(key, json::object());
        if (type != "boolean") expect_refused(key, true);
        if (type != "list of strings") expect_refused(key, json::array());
        if (type != "string") expect_refused(key, "string");
        if (!is_number(key)) expect_refused(key, 1);
        if (type == "integer") expect_refused(key, key.minimum + 0.5);
        if (type == "list of strings") {
            expect_refused(key, json::array({1}));
            expect_refused(key, json::array({""}));
        }
    }
}

TEST(EveryKey, RefusesStringsThatAreTooLongOrNotAChoice) {
    for (const Key& key : keys()) {
        if (type_name(key) != "string") continue;
        expect_refused(key, std::string(1, '\0'));
        if (!key.choices.empty()) {
            expect_refused(key, "no such choice");
            continue;
        }
        const auto config = parsed(key, std::string(static_cast<std::size_t>(key.maximum) + 1, 'x'));
        ASSERT_FALSE(config);
        EXPECT_THAT(config.error().message, HasSubstr(pointer_of(key) + ": \"xxx"));
        if (key.minimum > 0) expect_refused(key, "");
    }
}

Target target_in(const Key& key, Config& config) {
    if (key.section == "/maps/*") return {&config, &config.maps.at(0)};
    if (key.section == "/profiles/*") return {&config, nullptr, &config.profiles.at("p")};
    if (key.section == "/moments/*")
        return {&config, nullptr, nullptr,
                &*std::ranges::find(config.direction.moments, "sight", &direction::Rule::name)};
    return {&config};
}

TEST(EveryKey, TakesEffectInAReloadIfItSaysSo) {
    for (const Key& key : keys()) {
        if (!is_number(key)) continue;
        auto running = parsed(key, number_of(key, key.minimum));
        auto loaded = parsed(key, number_of(key, key.maximum));
        ASSERT_TRUE(running && loaded) << pointer_of(key);
        const json before = value_of(key, target_in(key, *running));
        const json after = value_of(key, target_in(key, *loaded));
        reload(*running, *loaded);
        EXPECT_EQ(value_of(key, target_in(key, *running)), key.reloads ? after : before) << pointer_of(key);
    }
}

TEST(EveryKey, HasAHelpText) {
    for (const Key& key : keys()) {
        EXPECT_GT(key.help.size(), 10U);
    }
}

TEST(Keys, AreDistinct) {
    std::set<std::string> names;
    for (const Key& key : keys())
        EXPECT_TRUE(names.insert(key.section + "/" + key.name).second) << key.name;
}

TEST(Keys, WhatIsAssignedIsRead) {
    for (const Key& key : keys()) {
        if (type_name(key) != "integer") continue;
        Config config;
        Map map;
        camera::Profile profile;
        const Target target{&config, &map, &profile};
        ASSERT_TRUE(assign(key, static_cast<std::int64_t>(key.maximum), target));
        EXPECT_EQ(value_of(key, target), static_cast<std::int64_t>(key.maximum)) << key.name;
    }
}

}  // namespace
}  // namespace camdir::config
