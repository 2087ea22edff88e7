#include "service/recording_metrics.hpp"

#include "http/metrics.hpp"

namespace camdir::service {

std::vector<prometheus::MetricFamily> recording_metrics(const recording::RecorderStatistics& statistics) {
    std::vector<prometheus::MetricFamily> families = {
        http::gauge_family("recordings", "Matches that are recorded now."),
        http::gauge_family("recording_bytes", "Disk that all recordings take."),
        http::counter_family("recording_fragments_total", "Fragments of recordings that are complete."),
        http::counter_family("recording_dropped_total",
                             "Messages of matches not recorded because the disk was too slow."),
        http::counter_family("recording_failures_total",
                             "Recordings that could not begin, or that an error of the disk ended.")};
    const std::uint64_t values[] = {statistics.running, statistics.bytes, statistics.fragments,
                                    statistics.dropped, statistics.failures};
    for (std::size_t i = 0; i < families.size(); ++i)
        http::add_metric(families[i], static_cast<double>(values[i]));
    return families;
}

}  // namespace camdir::service
