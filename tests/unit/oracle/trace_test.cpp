// Players are never in walls: every alive eye of every recorded match is free on its map.
#include <gtest/gtest.h>

#include <string>
#include <tuple>

#include "evaluation/trace.hpp"
#include "oracle/reachability.hpp"
#include "scene/load.hpp"
#include "support/openarena.hpp"
#include "support/shared_files.hpp"

namespace camdir::oracle {
namespace {

class RecordedMatch : public testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(RecordedMatch, EveryAliveEyeIsFreeAndReachable) {
    const auto& [map, rate] = GetParam();
    const std::string name = "traces/" + map + "-" + rate + ".csv.gz";
    const auto path = test::shared_file(name);
    if (!path) GTEST_SKIP() << test::needs_shared_file(name);
    const auto source = test::openarena_map(map);
    if (!source) GTEST_SKIP() << test::needs_openarena_map(map);

    const scene::Scene scene = scene::load(*source).value();
    const Oracle oracle(scene);
    const Reachability reachability = Reachability::explore(oracle, scene, {}, {}).value();
    const evaluation::Trace trace = evaluation::read_trace(*path).value();
    std::size_t eyes = 0;
    for (const evaluation::TracePose& pose : trace.poses) {
        if (!pose.alive) continue;
        ++eyes;
        ASSERT_FALSE(oracle.in_solid(pose.eye)) << "player " << pose.player << " at " << pose.eye.transpose();
        ASSERT_GT(oracle.clearance(pose.eye), 0.0) << pose.eye.transpose();
        ASSERT_TRUE(reachability.reachable(pose.eye)) << pose.eye.transpose();
    }
    EXPECT_GT(eyes, 10'000U);
}

INSTANTIATE_TEST_SUITE_P(Traces, RecordedMatch,
                         testing::Combine(testing::ValuesIn(test::traced_maps()),
                                          testing::Values("20hz", "60hz")));

}  // namespace
}  // namespace camdir::oracle
