// The counters of the DDS wire as Prometheus metrics.
#pragma once

#include <prometheus/metric_family.h>

#include <vector>

#include "dds/counters.hpp"

namespace camdir::service {

[[nodiscard]] std::vector<prometheus::MetricFamily> wire_metrics(const dds::WireCounters& counters);

}  // namespace camdir::service
