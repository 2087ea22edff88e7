#include "maps/memory.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "support/q3_maps.hpp"

namespace camdir::maps {
namespace {

namespace q3 = scene::q3;

TEST(EstimateMemory, GrowsWithAreaOverD0Squared) {
    const auto need = [](double side, double d0) {
        q3::Bsp bsp = test::room_map(Box3d(Vec3d(0.0, 0.0, 0.0), Vec3d(side, side, side)));
        test::add_spawn_point(bsp, Vec3d(side / 2.0, side / 2.0, 40.0));
        return static_cast<double>(estimate_memory(test::scene_of(bsp), d0));
    };
    const double fixed = need(1024.0, 1e9);
    EXPECT_NEAR((need(1024.0, 8.0) - fixed) / (need(1024.0, 16.0) - fixed), 4.0, 0.01);
    EXPECT_GT(need(2048.0, 16.0), need(1024.0, 16.0));
    EXPECT_LT(need(1024.0, 1e-9), 1e16) << "bounded: sums of estimates do not overflow";
}

TEST(AvailableMemory, IsThatOfAMachine) {
    const std::uint64_t memory = available_memory();
    EXPECT_GT(memory, 1'000'000U);
    EXPECT_LT(memory, std::uint64_t{1} << 50U);
}

TEST(AvailableMemory, IsLessByWhatTheProcessHolds) {
    constexpr std::size_t held = std::size_t{256} << 20U;
    const std::uint64_t before = available_memory();
    const std::vector<char> bytes(held, 'x');
    const std::uint64_t after = available_memory();
    EXPECT_EQ(bytes.back(), 'x');
    EXPECT_LT(after, before - held / 2);
}

}  // namespace
}  // namespace camdir::maps
