#include "http/metrics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <prometheus/text_serializer.h>

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#include "support/metric_families.hpp"

namespace camdir::http {
namespace {

using director::Counter;
using director::Statistics;
using prometheus::MetricFamily;
using test::family;

TEST(Metrics, ShowEveryCounterOnce) {
    Statistics statistics;
    std::iota(statistics.counters.begin(), statistics.counters.end(), std::uint64_t{1000});
    std::multiset<double> shown;
    for (const MetricFamily& one : director_metrics(statistics))
        if (one.type == prometheus::MetricType::Counter)
            for (const auto& metric : one.metric)
                shown.insert(metric.counter.value);
    for (const std::uint64_t value : statistics.counters)
        EXPECT_EQ(shown.count(static_cast<double>(value)), 1U) << value;
}

TEST(Metrics, LabelDropsWithTheirReason) {
    Statistics statistics;
    statistics.counters[static_cast<std::size_t>(Counter::drop_old_epoch)] = 5;
    const auto families = director_metrics(statistics);
    for (const auto& metric : family(families, "dropped_total").metric)
        EXPECT_EQ(metric.counter.value, metric.label.at(0).value == "old_epoch" ? 5.0 : 0.0);
}

TEST(Metrics, LabelRefusedMatchesWithTheirReason) {
    Statistics statistics;
    statistics.counters[static_cast<std::size_t>(Counter::refused_matches_delay)] = 5;
    const auto families = director_metrics(statistics);
    const auto& metrics = family(families, "refused_matches_total").metric;
    for (const auto& metric : metrics)
        EXPECT_EQ(metric.counter.value, metric.label.at(0).value == "delay" ? 5.0 : 0.0);
    EXPECT_EQ(std::ranges::count_if(metrics, [](const auto& metric) { return metric.counter.value > 0.0; }),
              1);
}

TEST(Metrics, LabelRefusedRequestsWithTheirReason) {
    Statistics statistics;
    statistics.counters[static_cast<std::size_t>(Counter::refused_shots)] = 5;
    const auto families = director_metrics(statistics);
    for (const auto& metric : family(families, "refused_requests_total").metric)
        EXPECT_EQ(metric.counter.value, metric.label.at(0).value == "shots" ? 5.0 : 0.0);
}

TEST(Metrics, ShowTheStagesOfTheLatency) {
    Statistics statistics;
    statistics.waiting.buckets.front() = 1;
    statistics.computing.buckets.front() = 2;
    statistics.writing.buckets.front() = 3;
    const auto families = director_metrics(statistics);
    std::map<std::string, std::uint64_t> counts;
    for (const auto& metric : family(families, "stage_seconds").metric)
        counts[metric.label.at(0).value] = metric.histogram.sample_count;
    EXPECT_EQ(counts,
              (std::map<std::string, std::uint64_t>{{"waiting", 1}, {"computing", 2}, {"writing", 3}}));
}

TEST(Metrics, HistogramsAreCumulative) {
    Statistics statistics;
    statistics.step.buckets.front() = 3;
    statistics.step.buckets.back() = 2;
    statistics.step.sum_s = 1.5;
    const auto families = director_metrics(statistics);
    const auto& histogram = family(families, "step_seconds").metric.at(0).histogram;
    EXPECT_EQ(histogram.sample_count, 5U);
    EXPECT_EQ(histogram.sample_sum, 1.5);
    EXPECT_EQ(histogram.bucket.front().cumulative_count, 3U);
    EXPECT_EQ(histogram.bucket[histogram.bucket.size() - 2].cumulative_count, 3U);
    EXPECT_EQ(histogram.bucket.back().cumulative_count, 5U);
    EXPECT_EQ(histogram.bucket.back().upper_bound, std::numeric_limits<double>::infinity());
}

TEST(Metrics, ShowMatchesByTheirIdWhateverItHolds) {
    const auto match = [](const std::string& id, std::uint64_t frames) {
        director::MatchStatistics one{id, {}};
        one.statistics.counters[static_cast<std::size_t>(Counter::pose_frames)] = frames;
        one.statistics.observers = 2 * frames;
        one.statistics.latency.buckets.front() = frames;
        return one;
    };
    const auto families = match_metrics({match("a \"cup\"", 3), match("\xff", 4), match("\xfe", 5)});
    const auto& frames = family(families, "match_pose_frames_total").metric;
    ASSERT_EQ(frames.size(), 2U) << "of ids that look the same, the first";
    EXPECT_EQ(frames[0].label.at(0).name, "match");
    EXPECT_EQ(frames[0].label.at(0).value, "a \"cup\"");
    EXPECT_EQ(frames[0].counter.value, 3.0);
    EXPECT_EQ(frames[1].label.at(0).value, "?");
    EXPECT_EQ(frames[1].counter.value, 4.0);
    EXPECT_EQ(family(families, "match_observers").metric[0].gauge.value, 6.0);
    EXPECT_EQ(family(families, "match_latency_seconds").metric[1].histogram.sample_count, 4U);
    const std::string text = prometheus::TextSerializer().Serialize(families);
    EXPECT_NE(text.find(R"re(camera_director_match_superseded_total{match="a \"cup\""} 0)re"),
              std::string::npos)
        << text;
}

TEST(Metrics, ShowEveryMap) {
    director::MapEntry entry;
    entry.bake_seconds = 2.5;
    entry.state = director::LoadState::failed;
    const auto families = map_metrics({{"a", entry}, {"b", {}}});
    ASSERT_EQ(family(families, "map_loaded").metric.size(), 2U);
    EXPECT_EQ(family(families, "map_loaded").metric[0].gauge.value, 0.0);
    EXPECT_EQ(family(families, "map_failed").metric[0].gauge.value, 1.0);
    EXPECT_EQ(family(families, "map_failed").metric[1].gauge.value, 0.0);
    EXPECT_EQ(family(families, "map_bake_seconds").metric[0].gauge.value, 2.5);
    EXPECT_EQ(family(families, "map_bake_seconds").metric[1].label.at(0).value, "b");
}

}  // namespace
}  // namespace camdir::http
