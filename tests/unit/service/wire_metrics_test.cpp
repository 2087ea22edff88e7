#include "service/wire_metrics.hpp"

#include <gtest/gtest.h>

#include "support/metric_families.hpp"

namespace camdir::service {
namespace {

using test::family;

TEST(WireMetrics, ShowStrengthMatchesLedAndReception) {
    dds::WireCounters counters;
    counters.matches_led = 3;
    counters.reception.add(400'000);
    counters.reception.add(600'000'000);
    const auto families = wire_metrics(counters, 250, std::nullopt);
    EXPECT_EQ(family(families, "strength").metric.at(0).gauge.value, 250.0);
    EXPECT_EQ(family(families, "matches_led").metric.at(0).gauge.value, 3.0);
    const auto& reception = family(families, "reception_seconds").metric.at(0).histogram;
    EXPECT_EQ(reception.sample_count, 2U);
    EXPECT_NEAR(reception.sample_sum, 0.6004, 1e-9);
    for (const auto& bucket : reception.bucket)
        EXPECT_EQ(bucket.cumulative_count, bucket.upper_bound < 0.0004 ? 0U
                                           : bucket.upper_bound < 0.6  ? 1U
                                                                       : 2U)
            << bucket.upper_bound;
}

TEST(WireMetrics, LabelDroppedSamplesWithTopicAndDefect) {
    dds::WireCounters counters;
    counters.of(dds::Topic::match_info)
        .dropped[static_cast<std::size_t>(dds::ValidationError::participant_limit)] = 7;
    const auto families = wire_metrics(counters, 0, std::nullopt);
    std::size_t found = 0;
    for (const auto& metric : family(families, "wire_dropped_total").metric) {
        const bool is_it =
            metric.label.at(0).value == "MatchInfo" && metric.label.at(1).value == "participant_limit";
        EXPECT_EQ(metric.counter.value, is_it ? 7.0 : 0.0);
        found += is_it ? 1 : 0;
    }
    EXPECT_EQ(found, 1U);
}

}  // namespace
}  // namespace camdir::service
