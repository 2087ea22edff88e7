// Metrics by their names.
#pragma once

#include <prometheus/metric_family.h>

#include <stdexcept>
#include <string>
#include <vector>

namespace camdir::test {

// The family of this name, without what all names begin with. Throws where there is none.
inline const prometheus::MetricFamily& family(const std::vector<prometheus::MetricFamily>& families,
                                              const std::string& name) {
    for (const prometheus::MetricFamily& one : families)
        if (one.name == "camera_director_" + name) return one;
    throw std::runtime_error("no family " + name);
}

}  // namespace camdir::test
