#include "dds/shards.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace camdir::dds {
namespace {

constexpr int match_count = 20'000;

std::string match_id(int number) {
    return "match " + std::to_string(number);
}

// The shard of each match.
std::vector<std::string> shards_of(const std::vector<std::string>& all) {
    std::vector<std::string> found(match_count);
    for (const std::string& own : all) {
        const Shards shards(own, all);
        for (int i = 0; i < match_count; ++i) {
            if (!shards.serves(match_id(i))) continue;
            EXPECT_EQ(found[i], "") << "two shards serve it";
            found[i] = own;
        }
    }
    return found;
}

// At five standard deviations of a fair draw.
void expect_share(std::ptrdiff_t count, double share) {
    const double mean = share * match_count;
    EXPECT_NEAR(static_cast<double>(count), mean, 5.0 * std::sqrt(mean * (1.0 - share)));
}

TEST(Shards, OneServesEveryMatch) {
    EXPECT_TRUE(Shards().serves("cup"));
    EXPECT_TRUE(Shards("a", {"a"}).serves("cup"));
}

TEST(Shards, ShareTheMatchesEqually) {
    const std::vector<std::string> all = {"a", "b", "c", "d", "e"};
    const auto found = shards_of(all);
    for (const std::string& shard : all)
        expect_share(std::ranges::count(found, shard), 0.2);
}

TEST(Shards, OneMoreTakesItsPartAndNothingElseMoves) {
    const auto before = shards_of({"a", "b", "c", "d"});
    const auto after = shards_of({"e", "d", "b", "a", "c"});
    std::ptrdiff_t moved = 0;
    for (int i = 0; i < match_count; ++i) {
        if (after[i] == before[i]) continue;
        ++moved;
        EXPECT_EQ(after[i], "e");
    }
    expect_share(moved, 0.2);
}

TEST(Shards, ADirectorOfNoneServesNothing) {
    const Shards shards("gone", {"a", "b"});
    for (int i = 0; i < 100; ++i)
        EXPECT_FALSE(shards.serves(match_id(i)));
}

}  // namespace
}  // namespace camdir::dds
