// The counters of the DDS wire, the director's strength (of the configuration) and the expiry of the identity
// as Prometheus metrics.
#pragma once

#include <prometheus/metric_family.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "dds/counters.hpp"
#include "dds/identity.hpp"

namespace camdir::service {

[[nodiscard]] std::vector<prometheus::MetricFamily> wire_metrics(
    const dds::WireCounters& counters, std::int64_t strength, const std::optional<dds::Identity>& identity);

}  // namespace camdir::service
