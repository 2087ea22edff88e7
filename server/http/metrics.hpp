// The director's statistics as Prometheus metrics.
#pragma once

#include <prometheus/metric_family.h>

#include <map>
#include <string>
#include <vector>

#include "director/map_library.hpp"
#include "director/view.hpp"
#include "http/bounds.hpp"
#include "live/relay.hpp"

namespace camdir::http {

// A family without metrics. `name` is given without the prefix camera_director_.
[[nodiscard]] prometheus::MetricFamily counter_family(const std::string& name, const std::string& help);
[[nodiscard]] prometheus::MetricFamily gauge_family(const std::string& name, const std::string& help);

[[nodiscard]] prometheus::MetricFamily histogram(const std::string& name, const std::string& help,
                                                 const director::Durations& durations);

// Adds a metric with the labels to a family of counters or gauges.
void add_metric(prometheus::MetricFamily& family, double value,
                std::vector<prometheus::ClientMetric::Label> labels = {});

[[nodiscard]] std::vector<prometheus::MetricFamily> director_metrics(const director::Statistics& statistics);
// With the label `match`; without those whose id looks like another's in UTF-8.
[[nodiscard]] std::vector<prometheus::MetricFamily> match_metrics(
    const std::vector<director::MatchStatistics>& matches);
[[nodiscard]] std::vector<prometheus::MetricFamily> map_metrics(
    const std::map<std::string, director::MapEntry>& maps);
// Of the configuration file, since the last reload: whether it was refused, and how many of its keys take
// effect only after a restart.
[[nodiscard]] std::vector<prometheus::MetricFamily> config_metrics(bool refused,
                                                                   std::size_t keys_for_restart);
[[nodiscard]] std::vector<prometheus::MetricFamily> live_metrics(const live::RelayStatistics& statistics);
[[nodiscard]] prometheus::MetricFamily bound_metrics(const BoundCounters& bounds_reached);

}  // namespace camdir::http
