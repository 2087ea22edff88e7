#include "recording/playback.hpp"

#include "recording/archive.hpp"

namespace camdir::recording {
namespace {

// From a player's input.
constexpr double max_s = 1e9;

std::int64_t nanoseconds(double seconds) {
    return static_cast<std::int64_t>(std::min(seconds, max_s) * 1e9);
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
    begin_ = begin_of(reader_.first_fragment()) + nanoseconds(from_s);
    speed_ = speed;
    channel_.sync.last = reader_.fragment_at(begin_);
    return {};
}

Channel Playback::at(double elapsed_s) {
    const std::int64_t time = begin_ + nanoseconds(elapsed_s * speed_);
    while (channel_.sync.last < reader_.last_fragment() && begin_of(channel_.sync.last + 1) <= time) {
        ++channel_.sync.last;
        channel_.complete_at = Channel::Clock::now();
    }
    channel_.is_live = channel_.sync.last < reader_.last_fragment();
    return channel_;
}

Result<void> Playback::find_readable() {
    Result<std::int64_t> begin;
    for (std::uint64_t n = reader_.first_fragment(); n <= reader_.last_fragment(); ++n) {
        known_ = static_cast<std::uint32_t>(n);
        begin = reader_.begin_time(known_);
        if (begin) {
            known_begin_ = *begin;
            return {};
        }
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
    return known_begin_ + (std::int64_t{fragment} - known_) * reader_.start().fragment_duration;
}

}  // namespace camdir::recording
