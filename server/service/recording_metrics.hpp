// The recorder's statistics as Prometheus metrics.
#pragma once

#include <prometheus/metric_family.h>

#include <vector>

#include "recording/recorder.hpp"

namespace camdir::service {

[[nodiscard]] std::vector<prometheus::MetricFamily> recording_metrics(
    const recording::RecorderStatistics& statistics);

}  // namespace camdir::service
