#include "dds/gateway.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <thread>

namespace camdir::dds {
namespace {

std::uint64_t random_id() {
    std::random_device random;
    return (static_cast<std::uint64_t>(random()) << 32U | random()) | 1U;
}

// Of `all` places those that one participant may take.
std::size_t share(std::int64_t limit, std::int64_t all) {
    return static_cast<std::size_t>(limit != 0 ? limit : std::max<std::int64_t>(all / 2, 1));
}

Subscriber::Options subscriber_options(const config::Dds& config, const config::Limits& limits,
                                       std::uint64_t director_id) {
    return {.leadership = {.rank = static_cast<std::uint32_t>(config.strength),
                           .lease = std::chrono::milliseconds(config.lease_ms)},
            .director_id = director_id,
            .partitions = config.partitions,
            .shards = {config.shard, config.shards},
            .limits = {.matches = static_cast<std::size_t>(limits.matches),
                       .participant_matches = share(limits.participant_matches, limits.matches),
                       .participant_match_rate = limits.participant_match_rate},
            .participant_observers = share(limits.participant_observers, limits.observers)};
}

}  // namespace

Result<std::unique_ptr<Gateway>> Gateway::open(const config::Dds& config, const config::Limits& limits) {
    auto participant = Participant::open(config);
    if (!participant) return tl::unexpected(participant.error());
    std::unique_ptr<Gateway> gateway(new Gateway(std::move(*participant), config, limits));
    if (auto opened = gateway->subscriber_.open(); !opened) return tl::unexpected(opened.error());
    return gateway;
}

Gateway::Gateway(Participant participant, const config::Dds& config, const config::Limits& limits)
    : participant_(std::move(participant)),
      director_id_(config.director_id != 0 ? static_cast<std::uint64_t>(config.director_id) : random_id()),
      subscriber_(participant_, subscriber_options(config, limits, director_id_), table_, counters_) {}

Gateway::~Gateway() {
    stop_receiving();
    close();
}

void Gateway::stop_receiving() {
    subscriber_.stop();
    for (const auto& match : table_.all())
        match->resign();
}

bool Gateway::leads(const std::string& match_id) const {
    const auto match = table_.find(match_id);
    return match && match->is_leading();
}

Gateway::HandOver Gateway::hand_over() {
    HandOver done;
    for (const auto& match : table_.all()) {
        if (!match->is_leading()) continue;
        ++done.led;
        if (!match->hand_over()) ++done.kept;
    }
    return done;
}

void Gateway::reshard(const config::Dds& config) {
    subscriber_.reshard({config.shard, config.shards});
}

void Gateway::close() {
    const auto matches = table_.all();
    if (matches.empty()) return;
    table_.clear();
    for (const auto& match : matches)
        match->release_ownership();
    // Deleting the participant now could overtake samples that the readers have not acknowledged.
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
}

void Gateway::publish(const director::MatchInfo& shown) {
    const auto match = table_.find(shown.match_id);
    if (!match) return;
    count(match->write(shown), counters_.shown_matches_written, Topic::shown_match, shown.match_id);
}

void Gateway::end(const std::string& match_id) {
    const auto match = table_.find(match_id);
    if (!match) return;
    count(match->end_shown(), counters_.shown_matches_written, Topic::shown_match, match_id);
}

void Gateway::publish(const std::string& match_id, const director::CameraFrame& frame) {
    const auto match = table_.find(match_id);
    if (!match) return;
    count(match->write(frame), counters_.camera_frames_written, Topic::camera_frame, match_id);
}

bool Gateway::publish(const director::ObserverStatus& status) {
    const auto match = table_.find(status.match_id);
    if (!match) return false;
    return match->write(status);
}

void Gateway::withdraw(const std::string& match_id, const std::string& observer_id) {
    const auto match = table_.find(match_id);
    if (match) match->withdraw(observer_id);
}

void Gateway::count(Written written, WireCounter& counter, Topic topic, const std::string& match_id) {
    if (!written) return;
    if (*written >= 0) {
        ++counter;
        return;
    }
    ++counters_.write_failures;
    if (const auto failures = failure_log_.due()) {
        spdlog::error("{} of match '{}' not written: {} ({} failures since the last such line)",
                      topic_name(topic), match_id, dds_strretcode(*written), *failures);
    }
}

}  // namespace camdir::dds
