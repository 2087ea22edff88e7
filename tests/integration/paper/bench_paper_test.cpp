// bench-paper with methods that succeed, fail, and take too long.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "support/child_process.hpp"
#include "support/clouds.hpp"
#include "support/temporary_folder.hpp"

namespace camdir {
namespace {

using testing::AllOf;
using testing::ContainsRegex;
using testing::HasSubstr;

// The walls of a room of 4 x 3 x 2 m, as points: the baker reads them; the paper's rule, which splits the
// edges of triangles, cannot.
class BenchPaper : public testing::Test {
  protected:
    void SetUp() override {
        const auto points = test::walls_of(Box3d(Vec3d::Zero(), Vec3d(4.0, 3.0, 2.0)), 0.1);
        ASSERT_TRUE(write_file(cloud_, test::xyz_of(points)));
    }

    [[nodiscard]] std::vector<std::string> command(const std::vector<std::string>& more) const {
        std::vector<std::string> words{BENCH_PAPER, cloud_, "--d0", "6", "--balls", "1000", "--runs", "1"};
        words.insert(words.end(), more.begin(), more.end());
        return words;
    }

    test::TemporaryFolder folder_;
    const std::string cloud_ = folder_ / "room.xyz";
};

TEST_F(BenchPaper, AMethodThatFailsSaysWhyAndLeavesTheOthersAlone) {
    test::ChildProcess table(command({"--only", "paper,adaptive"}));
    EXPECT_EQ(table.wait(), 1);
    EXPECT_THAT(table.output(),
                AllOf(ContainsRegex("\\| outcome \\| failed: .*room.xyz: has no triangles[^|]* \\| done \\|"),
                      ContainsRegex("\\| reduced triangles \\|  \\| [0-9,]+ \\|"),
                      ContainsRegex("\\| unsafe balls \\|  \\| 0 \\|")))
        << table.errors();

    test::ChildProcess process(command({"--only", "adaptive,engines", "--json"}));
    EXPECT_EQ(process.wait(), 1);
    const auto json = nlohmann::json::parse(process.output());
    EXPECT_EQ(json.at("methods").size(), 1U);
    EXPECT_FALSE(json.at("methods").at(0).contains("failed"));
    EXPECT_THAT(json.at("engines").at("qhull").at("failed"), HasSubstr("no triangles"));
    EXPECT_THAT(json.at("engines").at("cgal").at("failed"), HasSubstr("no triangles"));
}

TEST_F(BenchPaper, ExitsWith0WhenNothingFailed) {
    test::ChildProcess process(command({"--only", "adaptive"}));
    EXPECT_EQ(process.wait(), 0) << process.errors();
    EXPECT_THAT(process.output(), HasSubstr("| outcome | done |"));
}

TEST_F(BenchPaper, AMethodThatTakesTooLongSaysSo) {
    test::ChildProcess process(command({"--only", "adaptive,engines", "--limit", "0.001"}));
    EXPECT_EQ(process.wait(), 1);
    EXPECT_THAT(process.output(), AllOf(HasSubstr("| outcome | failed: more than 0.001 s |"),
                                        HasSubstr("qhull failed: more than 0.001 s; CGAL failed: more than")))
        << process.errors();
}

TEST_F(BenchPaper, BadUsageExitsWith2) {
    for (const char* limit : {"0", "-1", "soon"}) {
        test::ChildProcess process(command({"--limit", limit}));
        EXPECT_EQ(process.wait(), 2);
    }
}

}  // namespace
}  // namespace camdir
