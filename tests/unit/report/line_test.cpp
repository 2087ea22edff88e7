#include "report/line.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "report/runs.hpp"

namespace camdir::report {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::vector<double> values_of(const std::vector<Sample>& samples) {
    std::vector<double> values;
    for (const Sample& sample : samples)
        values.push_back(std::isnan(sample.value) ? -1.0 : sample.value);
    return values;
}

// Two columns of five samples.
TEST(Line, KeepsTheExtremesOfEachColumnInTheirOrder) {
    std::vector<Sample> samples;
    for (const double value : {3.0, 9.0, 4.0, 1.0, 5.0, 7.0, 2.0, 2.5, 8.0, 6.0})
        samples.push_back({static_cast<double>(samples.size()), value});
    EXPECT_THAT(values_of(decimate(samples, 10.0, 2)), testing::ElementsAre(9.0, 1.0, 2.0, 8.0));
}

TEST(Line, IsInterruptedWhereNothingWasMeasured) {
    const std::vector<Sample> samples = {{0, nan}, {1, 1}, {2, nan}, {3, 3}, {4, nan}, {5, nan}, {6, 6}};
    EXPECT_THAT(values_of(decimate(samples, 7.0, 7)), testing::ElementsAre(1, -1, 3, -1, 6));
    EXPECT_TRUE(decimate({}, 7.0, 7).empty());
}

TEST(Line, OfAnySeriesIsShortAndHasItsExtremes) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> value(0.0, 100.0);
    for (const int count : {1, 2, 50, 5000}) {
        std::vector<Sample> samples;
        double low = 1e9, high = -1e9;
        for (int i = 0; i < count; ++i) {
            const double now = random() % 5 == 0 ? nan : value(random);
            samples.push_back({static_cast<double>(i), now});
            if (std::isnan(now)) continue;
            low = std::min(low, now);
            high = std::max(high, now);
        }
        constexpr int columns = 40;
        const auto line = decimate(samples, count, columns);
        EXPECT_LE(line.size(), 3U * columns);
        EXPECT_TRUE(std::ranges::is_sorted(line, {}, &Sample::time));
        const auto measured = [](const Sample& sample) { return !std::isnan(sample.value); };
        if (std::ranges::none_of(line, measured)) continue;
        double line_low = 1e9, line_high = -1e9;
        for (const Sample& sample : line) {
            if (!measured(sample)) continue;
            line_low = std::min(line_low, sample.value);
            line_high = std::max(line_high, sample.value);
        }
        EXPECT_EQ(line_low, low);
        EXPECT_EQ(line_high, high);
    }
}

TEST(Line, IsAPathInWholeSteps) {
    const std::vector<Sample> samples = {{0, 0}, {5, 10}, {5, nan}, {10, 40}};
    EXPECT_EQ(path_of(samples, {10.0, 20.0, 100, 50}), "M0 50l50 -25M100 0");
}

TEST(Runs, AreTheLongest) {
    const std::vector<bool> holds = {true, true, false, true, false, false, true};
    const auto runs = runs_where(holds.size(), [&](std::size_t frame) { return holds[frame]; });
    ASSERT_EQ(runs.size(), 3U);
    EXPECT_EQ(runs[0].first, 0U);
    EXPECT_EQ(runs[0].last, 2U);
    EXPECT_EQ(runs[1].size(), 1U);
    EXPECT_EQ(runs[2].last, 7U);
}

}  // namespace
}  // namespace camdir::report
