#include <algorithm>
#include <cassert>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stream.hpp"

namespace {

using camdir::qtv::Answer;
using camdir::qtv::Match;
using camdir::qtv::Stream;
using camdir::quakeworld::TrackedFrame;

// What of an update must be as it should.
std::int64_t checked(const Answer& answer) {
    assert((answer.kind == Answer::Kind::begin) == answer.reason.empty());
    return 0;
}

std::int64_t checked(const Match& match) {
    assert(match.level > 0 && !match.map.empty() && match.rate_hz >= 1.0F);
    assert(match.players.size() <= camdir::quakeworld::max_slots);
    for (const auto& player : match.players)
        assert(!player.name.empty() && player.name.size() < 64);
    return match.level;
}

std::int64_t checked(const TrackedFrame& frame) {
    assert(!frame.poses.empty() && frame.poses.size() <= camdir::quakeworld::max_slots);
    for (const auto& pose : frame.poses)
        assert(pose.eye.allFinite() && pose.velocity.allFinite() && pose.orientation.coeffs().allFinite());
    return frame.time;
}

// In pieces of `size` bytes: the kinds of the updates with a number of each, and how many errors there are.
std::vector<std::int64_t> read(std::span<const std::byte> bytes, std::size_t size) {
    Stream stream;
    std::vector<std::int64_t> updates;
    while (!bytes.empty()) {
        const auto piece = bytes.first(std::min(size, bytes.size()));
        stream.append(piece);
        bytes = bytes.subspan(piece.size());
        while (true) {
            const auto update = stream.next();
            if (!update) {
                assert(!update.error().message.empty());
                updates.push_back(-1);
                return updates;
            }
            if (!*update) break;
            updates.push_back(static_cast<std::int64_t>((*update)->index()));
            updates.push_back(std::visit([](const auto& said) { return checked(said); }, **update));
        }
    }
    return updates;
}

}  // namespace

// Whatever the bytes, the first of which is the size of the pieces: updates that are as promised, the same as
// when all arrives at once.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    if (size < 2) return 0;
    const auto bytes = std::as_bytes(std::span(data, size)).subspan(1);
    const auto updates = read(bytes, 1U + data[0]);
    assert(updates == read(bytes, bytes.size()));
    return 0;
}
