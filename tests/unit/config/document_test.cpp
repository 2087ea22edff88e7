#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/file.hpp"
#include "config/keys.hpp"

namespace camdir::config {
namespace {

using nlohmann::json;

TEST(Schema, DescribesEveryKey) {
    const json root = json::parse(schema());
    EXPECT_EQ(root["additionalProperties"], false);
    for (const Key& key : keys()) {
        json object;
        if (key.section == "/maps/*")
            object = root["properties"]["maps"]["items"];
        else if (key.section == "/profiles/*")
            object = root["properties"]["profiles"]["additionalProperties"];
        else if (key.section == "/moments/*")
            object = root["properties"]["moments"]["additionalProperties"];
        else
            object = root["properties"][key.section.substr(1)];
        EXPECT_EQ(object["additionalProperties"], false);
        const json& described = object["properties"][key.name];
        ASSERT_TRUE(described.is_object()) << key.name;
        EXPECT_EQ(described.value("default", json()), key.required ? json() : default_of(key)) << key.name;
        const bool number = type_name(key) == "number" || type_name(key) == "integer";
        const json& range = key.zero_is_default ? described["anyOf"][0] : described;
        EXPECT_EQ(range.contains("minimum"), number) << key.name;
        EXPECT_EQ(range.value("minimum", key.minimum), key.minimum) << key.name;
        EXPECT_EQ(range.value("maximum", key.maximum), key.maximum) << key.name;
        if (key.zero_is_default) {
            EXPECT_EQ(described["anyOf"][1], json({{"const", 0}})) << key.name;
        }
    }
}

TEST(Reference, HasARowForEveryKey) {
    const std::string page = reference();
    for (const Key& key : keys())
        EXPECT_THAT(page, testing::HasSubstr("| `" + key.name + "` | ")) << key.name;
}

TEST(Reference, IsInTheReadme) {
    const Bytes readme = read_file(CAMERA_DIRECTOR_REFERENCE).value();
    const std::string text(reinterpret_cast<const char*>(readme.data()), readme.size());
    std::string page = reference();
    page.pop_back();  // the empty line after the last table
    EXPECT_NE(text.find(page), std::string::npos)
        << "replace the tables by the output of: camera-director serve --print-reference";
}

}  // namespace
}  // namespace camdir::config
