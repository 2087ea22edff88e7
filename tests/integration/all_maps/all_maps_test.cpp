// bench-all-maps on made maps.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "support/child_process.hpp"
#include "support/q3_maps.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

namespace fs = std::filesystem;
namespace q3 = scene::q3;
using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

class AllMaps : public testing::Test {
  protected:
    void SetUp() override { fs::create_directory(folder_ / "maps"); }

    // Two rooms without a door between them, a spawn point in the first or in both.
    void add_rooms(const std::string& name, bool both) const {
        q3::Bsp bsp = test::room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(512.0, 256.0, 128.0)));
        test::add_box(bsp, Box3d(Vec3d(248.0, 0.0, 0.0), Vec3d(264.0, 256.0, 128.0)), test::stone);
        test::add_spawn_point(bsp, Vec3d(128.0, 128.0, 40.0));
        if (both) test::add_spawn_point(bsp, Vec3d(384.0, 128.0, 40.0));
        ASSERT_TRUE(write_file(folder_ / "maps" / (name + ".bsp"), test::encode(bsp)));
    }

    [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more) const {
        std::vector<std::string> words{BENCH_ALL_MAPS, folder_ / "maps", "--openarena",    "",
                                       "--work",       folder_ / "work", "--balls",        "1000",
                                       "--points",     "1000",           "--bake-options", "--d0 16"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    test::TemporaryFolder folder_;
};

TEST_F(AllMaps, PassesWhenEveryLimitHolds) {
    add_rooms("one", false);
    test::ChildProcess process(command({"--check-threads"}));
    EXPECT_EQ(process.wait(), 0) << process.errors();
    EXPECT_THAT(process.output(), AllOf(HasSubstr("| one | "), HasSubstr("| **median** |"),
                                        HasSubstr("Every limit holds on all maps.")));
    EXPECT_TRUE(fs::exists(folder_ / "work" / "one.vfs"));
    EXPECT_FALSE(fs::exists(folder_ / "work" / "one.vfs.again"));
}

TEST_F(AllMaps, NamesEveryLimitThatDoesNotHold) {
    add_rooms("one", false);
    add_rooms("two", true);
    ASSERT_TRUE(write_file(folder_ / "maps" / "broken.bsp", std::string("no map")));
    ASSERT_TRUE(write_file(folder_ / "maps" / "notes.txt", std::string("no map either")));
    test::ChildProcess process(command({}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.output(),
                AllOf(HasSubstr("- two: 1 spawn points apart from the others"),
                      ContainsRegex("- broken: bake: .*unknown format"), HasSubstr("| broken | |")));
    EXPECT_THAT(process.output(), testing::Not(testing::AnyOf(HasSubstr("- one"), HasSubstr("notes"))));
}

TEST_F(AllMaps, BadUsageExitsWith2AndAMissingFolderWith1) {
    test::ChildProcess usage({BENCH_ALL_MAPS, "--balls", "many"});
    EXPECT_EQ(usage.wait(), 2);
    test::ChildProcess missing({BENCH_ALL_MAPS, "--openarena", "", folder_ / "nowhere"});
    EXPECT_EQ(missing.wait(), 1);
    EXPECT_THAT(missing.errors(), HasSubstr("nowhere: no such file or folder"));
}

}  // namespace
}  // namespace camdir
