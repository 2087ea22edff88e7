// Sight on every map of OpenArena, baked coarsely, against exact queries on the source.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <random>
#include <vector>

#include "bake/bake.hpp"
#include "bench/map_sources.hpp"
#include "freespace/distance.hpp"
#include "freespace/visibility.hpp"
#include "oracle/oracle.hpp"
#include "scene/load.hpp"
#include "support/freespace_meshes.hpp"

namespace camdir::freespace {
namespace {

constexpr double coarse_d0 = 64.0;
constexpr int start_count = 500;
constexpr float length = 120.0F;

std::vector<bench::MapSource> openarena_maps() {
    const std::filesystem::path folder = "/usr/share/games/openarena/baseoa";
    if (!std::filesystem::exists(folder)) return {};
    return bench::maps_of(folder);
}

class SightOnMap : public testing::TestWithParam<bench::MapSource> {
  protected:
    [[nodiscard]] float uniform(float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random_);
    }
    [[nodiscard]] Vec3f direction() {
        std::normal_distribution<float> normal;
        return Vec3f(normal(random_), normal(random_), normal(random_)).normalized();
    }
    // A point in the ball of a random vertex: most lie in the part of the map that is played in.
    [[nodiscard]] Vec3f start(const Freespace& freespace) {
        const Vertex& vertex = freespace.vertices()[random_() % freespace.vertices().size()];
        return vertex.position() + uniform(0.0F, 1.0F) * std::max(vertex.free_distance, 0.0F) * direction();
    }

    std::mt19937 random_{1};
};

TEST_P(SightOnMap, NeverFailsAtAStartWithRoomAndSeesThroughNoWall) {
    const auto scene = scene::load(GetParam().source);
    ASSERT_TRUE(scene) << scene.error().message;
    const auto baked = bake::bake(*scene, {.d0 = coarse_d0}, {}, {});
    ASSERT_TRUE(baked) << baked.error().message;
    const Freespace freespace = test::make_freespace(baked->contents);
    const oracle::Oracle oracle(*scene);
    const float tolerance = 1e-6F * freespace.bounds().diagonal().norm();
    for (int i = 0; i < start_count; ++i) {
        const Vec3f from = start(freespace);
        const Vec3f to = from + length * direction();
        const float free_distance = distance(freespace, from).value;
        for (const float radius : {0.0F, 5.0F, 0.9F * free_distance}) {
            if (!(free_distance > radius + tolerance)) continue;
            const Sight seen = sight(freespace, from, to, radius);
            ASSERT_GT(seen.free_length, 0.0F) << "from " << from.transpose() << " to " << to.transpose()
                                              << ", radius " << radius << ", free distance " << free_distance;
            if (seen.clear) {
                ASSERT_TRUE(oracle.segment_clear(from.cast<double>(), to.cast<double>()))
                    << "from " << from.transpose() << " to " << to.transpose();
            }
        }
    }
}

std::string name_of(const testing::TestParamInfo<bench::MapSource>& info) {
    std::string name = info.param.name + "_" + std::to_string(info.index);
    std::ranges::replace_if(
        name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
    return name;
}

// None where OpenArena is not installed.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(SightOnMap);
INSTANTIATE_TEST_SUITE_P(OpenArena, SightOnMap, testing::ValuesIn(openarena_maps()), name_of);

}  // namespace
}  // namespace camdir::freespace
