// The representation of a real map against exact queries on its source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <ostream>
#include <random>

#include "bake/bake.hpp"
#include "evaluation/trace.hpp"
#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"
#include "oracle/oracle.hpp"
#include "scene/load.hpp"
#include "support/freespace_meshes.hpp"
#include "support/freespace_twins.hpp"

namespace camdir::freespace {
namespace {

constexpr const char* archive = "/usr/share/games/openarena/baseoa/pak1-maps.pk3";

// Baked with a loss of 0, which keeps the whole mesh, and with the default.
struct Expected {
    double loss;
    double tightness;  // of reported distances, at least
    double missed;     // share of the clear sights, at most

    friend std::ostream& operator<<(std::ostream& out, const Expected& expected) {
        return out << "loss " << expected.loss;
    }
};

class RealMap : public testing::TestWithParam<Expected> {
  public:
    static constexpr std::array<Expected, 2> meshes{
        {{0.0, 0.9, 0.008}, {bake::Parameters().loss, 0.85, 0.012}}};

  protected:
    static void SetUpTestSuite() {
        if (!std::filesystem::exists(archive)) return;
        const auto scene = scene::load(std::string(archive) + ":maps/oa_dm1.bsp");
        ASSERT_TRUE(scene) << scene.error().message;
        for (const Expected& mesh : meshes) {
            const auto baked = bake::bake(*scene, {.loss = mesh.loss}, {}, {});
            ASSERT_TRUE(baked) << baked.error().message;
            freespaces_.emplace(mesh.loss, test::make_freespace(baked->contents));
        }
        oracle_.emplace(*scene);
    }
    static void TearDownTestSuite() {
        freespaces_.clear();
        oracle_.reset();
    }
    void SetUp() override {
        if (!std::filesystem::exists(archive)) GTEST_SKIP() << "needs the package openarena-081-maps";
        ASSERT_TRUE(oracle_) << "not baked";
        freespace_ = &freespaces_.at(GetParam().loss);
    }

    // Another covered point at most `reach` away.
    Vec3f covered_point_near(const Vec3f& from, float reach) {
        std::uniform_real_distribution<float> offset(-reach, reach);
        while (true) {
            const Vec3f to = from + Vec3f(offset(random_), offset(random_), offset(random_));
            if ((to - from).norm() <= reach && distance(*freespace_, to).covered()) return to;
        }
    }

    static std::map<double, Freespace> freespaces_;
    static std::optional<oracle::Oracle> oracle_;
    const Freespace* freespace_ = nullptr;
    std::mt19937 random_{1};
};

std::map<double, Freespace> RealMap::freespaces_;
std::optional<oracle::Oracle> RealMap::oracle_;

TEST_P(RealMap, DistanceNeverExceedsTheClearance) {
    double reported = 0.0;
    double exact = 0.0;
    for (int i = 0; i < 3'000; ++i) {
        const Vec3f point = test::covered_point(random_, *freespace_);
        const double clearance = oracle_->clearance(point.cast<double>());
        const float value = distance(*freespace_, point).value;
        ASSERT_LE(value, clearance + 0.02) << point.transpose();
        reported += value;
        exact += clearance;
    }
    EXPECT_GT(reported, GetParam().tightness * exact);
}

// Within 2 % of the largest of all slabs is what cameras need; the index is far better.
TEST_P(RealMap, DistanceIsTheLargestOfAllSlabs) {
    std::vector<Vec3f> points;
    const auto trace = evaluation::read_trace(CAMDIR_DEMO_TRACE);
    ASSERT_TRUE(trace) << trace.error().message;
    for (std::size_t i = 0; i < trace->poses.size(); i += trace->poses.size() / 10)
        points.push_back(trace->poses[i].eye.cast<float>());
    for (int i = 0; i < 10; ++i)
        points.push_back(test::covered_point(random_, *freespace_));
    for (const Vec3f& point : points) {
        const double exact = test::exact_distance(*freespace_, point.cast<double>());
        const Distance found = distance(*freespace_, point);
        ASSERT_LE(found.value, exact + 1e-6) << point.transpose();
        ASSERT_TRUE(exact <= 0.01 || found.value >= 0.999 * exact) << point.transpose();
    }
}

TEST_P(RealMap, NothingIsSeenThroughAWallAndLittleIsMissed) {
    int visible = 0;
    int missed = 0;
    for (int i = 0; i < 10'000; ++i) {
        const Vec3f from = test::covered_point(random_, *freespace_);
        const Vec3f to = covered_point_near(from, 128.0F);
        const bool truly = oracle_->segment_clear(from.cast<double>(), to.cast<double>());
        const bool seen = sight(*freespace_, from, to).clear;
        ASSERT_TRUE(truly || !seen) << from.transpose() << " to " << to.transpose();
        visible += truly ? 1 : 0;
        missed += truly && !seen ? 1 : 0;
    }
    EXPECT_GT(visible, 5'000);
    EXPECT_LE(missed, GetParam().missed * visible) << missed << " of " << visible;
}

INSTANTIATE_TEST_SUITE_P(Losses, RealMap, testing::ValuesIn(RealMap::meshes), [](const auto& tested) {
    return tested.param.loss == 0.0 ? "unreduced" : "reduced";
});

}  // namespace
}  // namespace camdir::freespace
