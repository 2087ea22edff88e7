// camera-director verify as its users run it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>
#include <nlohmann/json.hpp>
#include <sstream>

#include "base/file.hpp"
#include "support/child_process.hpp"
#include "support/eventually.hpp"
#include "support/freespace_meshes.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

using test::ChildProcess;
using testing::AllOf;
using testing::HasSubstr;

class VerifyCommand : public testing::Test {
  protected:
    // A floor of `side` metres, with a small roof `height` metres above its middle, and a baked file that
    // knows a square of 2 m around the point 2 m above the middle, with balls of `radius`.
    void make_plain(double side, double height, float radius) {
        const double middle = side / 2.0;
        std::ostringstream obj;
        obj << "v 0 0 0\nv " << side << " 0 0\nv " << side << ' ' << side << " 0\nv 0 " << side << " 0\n"
            << "f 1 2 3\nf 1 3 4\n"
            << "v " << middle << ' ' << middle << ' ' << height << "\nv " << middle + 1.0 << ' ' << middle
            << ' ' << height << "\nv " << middle << ' ' << middle + 1.0 << ' ' << height << "\nf 5 6 7\n";
        ASSERT_TRUE(write_file(map_, obj.str()));
        freespace::Contents contents = test::empty_contents();
        contents.metadata.metres_per_unit = 1.0F;
        contents.metadata.d0 = 0.4F;
        const auto at = static_cast<float>(middle);
        contents.vertices = {{at - 1.0F, at - 1.0F, 2.0F, radius},
                             {at + 1.0F, at - 1.0F, 2.0F, radius},
                             {at + 1.0F, at + 1.0F, 2.0F, radius},
                             {at - 1.0F, at + 1.0F, 2.0F, radius}};
        contents.triangles = {{0, 1, 2}, {0, 2, 3}};
        contents.spawn_points = {{Vec3f(at, at, 2.0F), 0.0F}};
        ASSERT_TRUE(write_file(file_, freespace::encode(contents)));
    }

    [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more) const {
        std::vector<std::string> words{CAMERA_DIRECTOR, "verify", file_, "--map", map_};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    test::TemporaryFolder folder_;
    const std::string map_ = folder_ / "plain.obj";
    const std::string file_ = folder_ / "plain.vfs";
};

TEST_F(VerifyCommand, ReportsWhatItFound) {
    make_plain(10.0, 5.0, 1.5F);
    ChildProcess safe(command({"--balls", "1000", "--points", "1000", "--json", "-"}));
    EXPECT_EQ(safe.wait(), 0) << safe.errors();
    EXPECT_THAT(safe.errors(),
                AllOf(HasSubstr("was baked from other bytes"), HasSubstr("no violation found")));
    EXPECT_EQ(nlohmann::json::parse(safe.output()).at("unsafe_balls"), 0);

    make_plain(10.0, 5.0, 2.5F);
    ChildProcess unsafe(command({"--balls", "1000", "--points", "1000", "--json", "-"}));
    EXPECT_EQ(unsafe.wait(), 1);
    EXPECT_THAT(unsafe.errors(), HasSubstr("VIOLATED"));
    EXPECT_GT(nlohmann::json::parse(unsafe.output()).at("unsafe_balls"), 1000);
}

TEST_F(VerifyCommand, RefusesASquareKilometre) {
    make_plain(1000.0, 100.0, 1.5F);
    ChildProcess process(command({}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.errors(),
                AllOf(HasSubstr("plain.obj: the bounds of 1000 x 1000 x 100 map units hold"),
                      HasSubstr("million cells"), HasSubstr("the limit is 2147 MB")));
}

TEST_F(VerifyCommand, InterruptedExitsWith130) {
    make_plain(500.0, 50.0, 1.5F);
    for (const int signal : {SIGINT, SIGTERM}) {
        ChildProcess process(command({"--json", folder_ / "result.json"}));
        // Exploring comes next, and takes far longer than this test.
        ASSERT_TRUE(test::eventually(
            [&] { return process.errors().find("was baked from other bytes") != std::string::npos; }));
        process.send_signal(signal);
        EXPECT_EQ(process.wait_for(test::patience), 130);
        EXPECT_THAT(process.errors(), HasSubstr("camera-director: interrupted\n"));
        EXPECT_FALSE(std::filesystem::exists(folder_ / "result.json"));
    }
}

}  // namespace
}  // namespace camdir
