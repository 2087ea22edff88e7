#include "base/disjoint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace camdir {
namespace {

TEST(DisjointSets, TheRepresentativeIsTheSmallestMember) {
    std::mt19937 random(6);
    constexpr std::uint32_t count = 60;
    std::uniform_int_distribution<std::uint32_t> member(0, count - 1);
    DisjointSets sets(count);
    std::vector<std::uint32_t> labels(count);
    for (std::uint32_t i = 0; i < count; ++i)
        labels[i] = i;
    for (int round = 0; round < 80; ++round) {
        const std::uint32_t a = member(random);
        const std::uint32_t b = member(random);
        sets.unite(a, b);
        const std::uint32_t kept = std::min(labels[a], labels[b]);
        const std::uint32_t lost = std::max(labels[a], labels[b]);
        std::replace(labels.begin(), labels.end(), lost, kept);
        for (std::uint32_t i = 0; i < count; ++i)
            ASSERT_EQ(sets.find(i), labels[i]) << "round " << round;
    }
}

}  // namespace
}  // namespace camdir
