#include "recording/playback.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "recording/archive.hpp"

namespace camdir::recording {
namespace {

// Both may be anything.
std::int64_t later(std::int64_t time, double ns) {
    constexpr auto most = std::numeric_limits<std::int64_t>::max();
    const double sum = static_cast<double>(time) + ns;
    if (!(std::abs(sum) < 9e18 && std::abs(ns) < 9e18)) return sum < 0.0 ? -most : most;
    return time + static_cast<std::int64_t>(ns);
}

}  // namespace

Result<Playback> Playback::open(const std::filesystem::path& folder) {
    auto reader = Reader::open(folder);
    if (!reader) return tl::unexpected(reader.error());
    const Start& start = reader->start();
    const std::int64_t recorded = reader->begin_time(reader->first_fragment()).value_or(0);
    // Another id for every playback: caches may know the folder's name with other content.
    Channel channel{new_recording_id(recorded),    folder,
                    start.match.map_name,          1e-9 * static_cast<double>(start.fragment_duration),
                    start.match.spectator_delay_s, {reader->first_fragment(), reader->last_fragment()},
                    Channel::Clock::now(),         false};
    return Playback(std::move(*reader), std::move(channel));
}

double Playback::length_s() const {
    const double fragments = 1.0 + reader_.last_fragment() - reader_.first_fragment();
    return fragments * channel_.fragment_duration_s;
}

Channel Playback::whole() const {
    return channel_;
}

Result<void> Playback::go_on(double from_s, double speed) {
    if (auto found = find_readable(); !found) return found;
    begin_ = later(begin_of(reader_.first_fragment()), from_s * 1e9);
    speed_ = speed;
    channel_.sync.last = reader_.fragment_at(begin_);
    return {};
}

Channel Playback::at(double elapsed_s) {
    const std::int64_t time = later(begin_, elapsed_s * speed_ * 1e9);
    const auto& fragments = reader_.fragments();
    for (auto next = std::ranges::upper_bound(fragments, channel_.sync.last);
         next != fragments.end() && begin_of(*next) <= time; ++next) {
        channel_.sync.last = *next;
        channel_.complete_at = Channel::Clock::now();
    }
    channel_.is_live = channel_.sync.last < reader_.last_fragment();
    return channel_;
}

Result<void> Playback::find_readable() {
    Result<std::int64_t> begin;
    for (const std::uint32_t fragment : reader_.fragments()) {
        begin = reader_.begin_time(fragment);
        if (!begin) continue;
        known_ = fragment;
        known_begin_ = *begin;
        return {};
    }
    return tl::unexpected(begin.error());
}

// Of one that cannot be read about when it should.
std::int64_t Playback::begin_of(std::uint32_t fragment) {
    if (fragment != known_) {
        if (const auto begin = reader_.begin_time(fragment)) {
            known_ = fragment;
            known_begin_ = *begin;
        }
    }
    const double fragments = static_cast<double>(fragment) - known_;
    return later(known_begin_, fragments * static_cast<double>(reader_.start().fragment_duration));
}

}  // namespace camdir::recording
