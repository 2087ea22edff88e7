// A recorded match on a real map: what every camera of both solvers, and group shots, must keep, by exact
// geometry.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <optional>

#include "bake/bake.hpp"
#include "evaluation/group_figures.hpp"
#include "evaluation/group_recording.hpp"
#include "evaluation/metrics.hpp"
#include "evaluation/recording.hpp"
#include "freespace/freespace.hpp"
#include "freespace/lookouts.hpp"
#include "freespace/visibility.hpp"
#include "oracle/oracle.hpp"
#include "scene/load.hpp"

namespace camdir::evaluation {
namespace {

constexpr const char* archive = "/usr/share/games/openarena/baseoa/pak1-maps.pk3";
constexpr std::int64_t duration = 12'000'000'000;  // ns

Trace beginning_of(Trace trace) {
    std::size_t frames = 0;
    while (frames < trace.frames.size() && trace.frames[frames].time - trace.frames[0].time < duration)
        ++frames;
    trace.frames.resize(frames);
    trace.poses.resize(trace.frames.back().first_pose + trace.frames.back().pose_count);
    return trace;
}

class RealMatch : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        if (!std::filesystem::exists(archive)) return;
        auto scene = scene::load(std::string(archive) + ":maps/oa_dm1.bsp");
        ASSERT_TRUE(scene) << scene.error().message;
        const auto baked = bake::bake(*scene, {}, {}, {});
        ASSERT_TRUE(baked) << baked.error().message;
        auto freespace = freespace::Freespace::parse(freespace::encode(baked->contents), "oa_dm1");
        ASSERT_TRUE(freespace) << freespace.error().message;
        auto trace = read_trace(MATCH);
        ASSERT_TRUE(trace) << trace.error().message;
        scene_ = std::move(*scene);
        freespace_ = std::move(*freespace);
        trace_ = beginning_of(std::move(*trace));
        oracle_.emplace(*scene_);
    }
    static void TearDownTestSuite() {
        oracle_.reset();
        freespace_.reset();
        scene_.reset();
    }
    void SetUp() override {
        if (!oracle_) GTEST_SKIP() << "needs the package openarena-081-maps";
    }

    [[nodiscard]] static Metrics measured(camera::Solver solver, double look_ahead) {
        camera::Profile profile;
        profile.solver = solver;
        const auto recording =
            record(*freespace_, profile, trace_, {}, trace_, look_ahead, [](auto, auto) {}, {});
        EXPECT_TRUE(recording);
        return *measure(*scene_, *oracle_, trace_, recording->cameras, [](auto) {}, {});
    }
    static void expect_promises(const Metrics& metrics) {
        EXPECT_GE(metrics.visible_head, 99.9);
        EXPECT_EQ(metrics.in_solid, 0.0);
        EXPECT_EQ(metrics.fly_through, 0.0);
        EXPECT_EQ(metrics.pops, 0.0);
        EXPECT_EQ(metrics.cuts, 0.0);
        EXPECT_LE(metrics.max_rotation, 11.01);
    }

    static inline std::optional<scene::Scene> scene_;
    static inline std::optional<freespace::Freespace> freespace_;
    static inline std::optional<oracle::Oracle> oracle_;
    static inline Trace trace_;
};

TEST_F(RealMatch, BothSolversKeepThePromisesAndThePlannerIsBetter) {
    const Metrics paper = measured(camera::Solver::paper, 0.0);
    const Metrics causal = measured(camera::Solver::planner, 0.0);
    const Metrics ahead = measured(camera::Solver::planner, 1.0);
    expect_promises(paper);
    expect_promises(causal);
    expect_promises(ahead);
    EXPECT_EQ(causal.clearance_lt4, 0.0);
    EXPECT_EQ(ahead.clearance_lt4, 0.0);
    EXPECT_GT(causal.good, paper.good);
    EXPECT_LT(causal.acc.p95, paper.acc.p95);
    EXPECT_LT(ahead.acc.p95, causal.acc.p95);
    EXPECT_LT(ahead.ang_speed.p95, causal.ang_speed.p95);
}

TEST_F(RealMatch, AGroupIsShownTogetherNearlyWhereverAPlaceAllowsIt) {
    const auto places = freespace_->lookouts().positions();
    const auto proves = [&](const Vec3f& from, const Vec3f& to) {
        return freespace::sight(*freespace_, from, to).clear;
    };
    double possible = 0.0, together = 0.0;
    for (const auto& members : {std::array{0U, 2U}, {0U, 3U}, {1U, 2U}, {2U, 3U}}) {
        const auto made = record_group(*freespace_, {}, trace_, {}, trace_, members, 3.0, {});
        ASSERT_TRUE(made);
        const auto figures = judge_group(*oracle_, scene_->metres_per_unit, trace_, members, made->cameras,
                                         places, proves, {}, {});
        ASSERT_TRUE(figures);
        EXPECT_EQ(figures->fly_through, 0.0);
        EXPECT_EQ(figures->pops, 0.0);
        const double frames = static_cast<double>(figures->frames) * figures->possible / 100.0;
        possible += frames;
        together += frames * figures->together_of_possible / 100.0;
        EXPECT_LE(figures->provable, figures->possible);
        EXPECT_GE(figures->provable, 0.8 * figures->possible);
    }
    EXPECT_GT(possible, 500.0);
    EXPECT_GE(together, 0.92 * possible);
}

}  // namespace
}  // namespace camdir::evaluation
