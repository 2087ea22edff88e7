#include "service/wire_metrics.hpp"

#include <chrono>
#include <limits>

#include "http/metrics.hpp"

namespace camdir::service {
namespace {

constexpr dds::Topic received_topics[] = {dds::Topic::match_info,   dds::Topic::pose_frame,
                                          dds::Topic::match_event,  dds::Topic::mover_info,
                                          dds::Topic::mover_frame,  dds::Topic::observer_request,
                                          dds::Topic::camera_frame, dds::Topic::director_sign};

prometheus::MetricFamily counter(const std::string& name, const std::string& help,
                                 const dds::WireCounter& value) {
    prometheus::MetricFamily family = http::counter_family(name, help);
    http::add_metric(family, static_cast<double>(value.load()));
    return family;
}

prometheus::MetricFamily gauge(const std::string& name, const std::string& help, double value) {
    prometheus::MetricFamily family = http::gauge_family(name, help);
    http::add_metric(family, value);
    return family;
}

director::Durations durations(const director::DurationCounter& counter) {
    director::Durations sum;
    counter.add_to(sum);
    return sum;
}

// In seconds since 1970.
double expiry(const std::optional<dds::Identity>& identity) {
    if (!identity) return std::numeric_limits<double>::infinity();
    return std::chrono::duration<double>(identity->expires.time_since_epoch()).count();
}

}  // namespace

std::vector<prometheus::MetricFamily> wire_metrics(const dds::WireCounters& counters, std::int64_t strength,
                                                   const std::optional<dds::Identity>& identity) {
    auto accepted = http::counter_family("wire_received_total", "Valid samples received, by topic.");
    auto dropped = http::counter_family("wire_dropped_total",
                                        "Samples dropped on receipt, by topic and validation error.");
    for (const dds::Topic topic : received_topics) {
        const char* name = dds::topic_name(topic);
        const auto& of_topic = counters.of(topic);
        http::add_metric(accepted, static_cast<double>(of_topic.accepted.load()), {{"topic", name}});
        for (std::size_t error = 0; error < dds::validation_error_names.size(); ++error)
            http::add_metric(dropped, static_cast<double>(of_topic.dropped[error].load()),
                             {{"topic", name}, {"defect", dds::validation_error_names[error]}});
    }
    return {
        accepted,
        dropped,
        http::histogram(
            "reception_seconds",
            "Time from sampling a pose frame to receiving it, by the clocks of both hosts: at least "
            "0, at most 10 s.",
            durations(counters.reception)),
        counter("wire_shown_matches_total", "Changes of what matches show written to DDS.",
                counters.shown_matches_written),
        counter("wire_camera_frames_total", "Camera frames written to DDS.", counters.camera_frames_written),
        counter("wire_statuses_total", "Buckets of observer statuses written to DDS.",
                counters.statuses_written),
        counter("wire_write_failures_total", "Samples that DDS did not accept.", counters.write_failures),
        counter("wire_endpoint_failures_total", "Matches whose endpoints could not be created.",
                counters.endpoint_failures),
        counter(
            "wire_liveliness_withheld_total",
            "Signs of life omitted because a worker or the housekeeping had been busy with one turn, or no "
            "worker free for one, for 3/4 of dds.lease_ms.",
            counters.liveliness_withheld),
        gauge("matches_led", "Matches that this director leads; for the others it stands by.",
              counters.matches_led),
        gauge("strength", "Of directors that begin a match together, the strongest leads it.",
              static_cast<double>(strength)),
        gauge("matches_leaving", "Matches of other shards that this director serves until these do.",
              counters.matches_leaving),
        gauge("identity_expiry_timestamp_seconds",
              "When the identity for DDS Security expires, in Unix time; infinite for plain DDS.",
              expiry(identity))};
}

}  // namespace camdir::service
