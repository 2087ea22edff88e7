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

Result<Playback> Playback::open(const std::filesystem::path& folder, double from_s, double speed) {
    auto reader = Reader::open(folder);
    if (!reader) return tl::unexpected(reader.error());
    const auto recorded = reader->begin_time(reader->first_fragment());
    if (!recorded) return tl::unexpected(recorded.error());
    const std::int64_t begin = *recorded + nanoseconds(from_s);
    const auto fragment = reader->fragment_at(begin);
    if (!fragment) return tl::unexpected(fragment.error());
    const Start& start = reader->start();
    // Another id for every playback: caches may know the folder's name with other content.
    Channel channel{new_recording_id(*recorded),   folder,
                    start.match.map_name,          1e-9 * static_cast<double>(start.fragment_duration),
                    start.match.spectator_delay_s, {reader->first_fragment(), *fragment},
                    Channel::Clock::now()};
    return Playback(std::move(*reader), std::move(channel), begin, speed);
}

Result<double> Playback::length_s() const {
    const auto first = reader_.begin_time(reader_.first_fragment());
    if (!first) return tl::unexpected(first.error());
    const auto last = reader_.begin_time(reader_.last_fragment());
    if (!last) return tl::unexpected(last.error());
    return 1e-9 * static_cast<double>(*last - *first) + channel_.fragment_duration_s;
}

Channel Playback::whole() const {
    Channel channel = channel_;
    channel.sync.last = reader_.last_fragment();
    channel.is_live = false;
    return channel;
}

Result<Channel> Playback::at(double elapsed_s) {
    const std::int64_t time = begin_ + nanoseconds(elapsed_s * speed_);
    while (channel_.sync.last < reader_.last_fragment()) {
        const auto next = reader_.begin_time(channel_.sync.last + 1);
        if (!next) return tl::unexpected(next.error());
        if (*next > time) break;
        ++channel_.sync.last;
        channel_.complete_at = Channel::Clock::now();
    }
    channel_.is_live = channel_.sync.last < reader_.last_fragment();
    return channel_;
}

}  // namespace camdir::recording
