// The table of brush entities, in the code and in the document.
#include "scene/bsp/brush_classes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>
#include <string>

namespace camdir::scene {
namespace {

std::string table_as_text() {
    std::ostringstream text;
    text << "| classes | games | taken as | why |\n|---|---|---|---|\n";
    for (const BrushClasses& row : brush_classes()) {
        const char* const games = !row.in_quake3 ? "Quake, GoldSrc" : !row.in_quake ? "Quake 3" : "all";
        text << "| `" << row.names << "` | " << games << " | " << name_of(row.use) << " | " << row.reason
             << " |\n";
    }
    return text.str();
}

TEST(BrushClasses, TheDocumentShowsTheTable) {
    std::ifstream file(CAMERA_DIRECTOR_SCENE_README);
    std::ostringstream document;
    document << file.rdbuf();
    EXPECT_THAT(document.str(), testing::HasSubstr(table_as_text()))
        << "expected this table in " << CAMERA_DIRECTOR_SCENE_README;
}

TEST(BrushClasses, EveryRowDecidesForAGame) {
    for (const BrushClasses& row : brush_classes()) {
        EXPECT_TRUE(row.in_quake || row.in_quake3) << row.names;
        EXPECT_NE(row.use, BrushUse::unknown) << row.names;
        std::istringstream names{std::string(row.names)};
        for (std::string name; names >> name;) {
            if (name.ends_with('*')) name.back() = 'x';
            EXPECT_TRUE(!row.in_quake || brush_use(BspFamily::quake, name) == row.use) << name;
            EXPECT_TRUE(!row.in_quake3 || brush_use(BspFamily::quake3, name) == row.use) << name;
        }
    }
}

TEST(BrushClasses, DistinguishesWholeNamesAndPrefixes) {
    EXPECT_EQ(brush_use(BspFamily::quake, "func_detail_wall"), BrushUse::obstacle);
    EXPECT_EQ(brush_use(BspFamily::quake, "func_detail_illusionary"), BrushUse::none);
    EXPECT_EQ(brush_use(BspFamily::quake, "func_tank_of"), BrushUse::mover);
    EXPECT_EQ(brush_use(BspFamily::quake, "func_tankcontrols"), BrushUse::none);
    EXPECT_EQ(brush_use(BspFamily::quake, "func_wall2"), BrushUse::unknown);
    EXPECT_EQ(brush_use(BspFamily::quake, "func_"), BrushUse::unknown);
    EXPECT_EQ(brush_use(BspFamily::quake, ""), BrushUse::unknown);
    EXPECT_EQ(brush_use(BspFamily::quake3, "func_wall"), BrushUse::obstacle);
    EXPECT_EQ(brush_use(BspFamily::quake3, "func_platrot"), BrushUse::unknown);
}

}  // namespace
}  // namespace camdir::scene
