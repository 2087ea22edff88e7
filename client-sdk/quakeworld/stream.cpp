#include "stream.hpp"

#include <cmath>
#include <limits>
#include <utility>

namespace camdir::qtv {
namespace {

constexpr std::size_t longest_name = 63;        // bytes, of the client library
constexpr std::int64_t time_to_measure = 2000;  // ms of frames for their rate
constexpr std::int64_t longest_interval = 500;  // ms: a longer one is a pause
constexpr float different_rate = 0.1F;          // share of a rate from which on another one is said
constexpr std::size_t least_blocks_to_judge = 100;

}  // namespace

void Stream::Rate::count(std::int64_t time) {
    if (!since_ || time - last_ > longest_interval) {
        since_ = time;
        frames_ = 0;
    }
    last_ = time;
    const std::int64_t passed = time - *since_;
    if (passed >= time_to_measure) {
        const float measured = 1000.0F * static_cast<float>(frames_) / static_cast<float>(passed);
        if (std::abs(measured - hz_) > different_rate * hz_) hz_ = std::max(1.0F, std::round(measured));
        since_ = time;
        frames_ = 0;
    }
    ++frames_;
}

void Stream::append(std::span<const std::byte> bytes) {
    if (begun_)
        blocks_.append(bytes);
    else
        answer_.insert(answer_.end(), bytes.begin(), bytes.end());
}

Result<std::optional<Update>> Stream::next() {
    if (!begun_)
        if (const auto read = begin(); !read) return tl::unexpected(read.error());
    while (updates_.empty()) {
        const auto block = blocks_.next();
        if (!block) return tl::unexpected(block.error());
        if (!*block) return std::nullopt;
        if (const auto taken = take(**block); !taken) return tl::unexpected(taken.error());
    }
    Update update = std::move(updates_.front());
    updates_.pop_front();
    return std::optional(std::move(update));
}

Result<void> Stream::begin() {
    auto answer = read_answer(answer_);
    if (!answer) return tl::unexpected(answer.error());
    if (!*answer) return {};
    begun_ = true;
    blocks_.append(std::span(answer_).subspan((*answer)->size));
    answer_ = {};
    updates_.emplace_back(std::move(**answer));
    return {};
}

Result<void> Stream::take(const quakeworld::Block& block) {
    if (auto frame = frames_.read(block)) {
        if (!frame->poses.empty() && (level_ == 0 || match_.level != level_))
            return fail("byte " + std::to_string(block.offset) +
                        ": players, but of no map; expected that a level begins with a list of models whose "
                        "first is maps/NAME.bsp");
        tracker_.add(std::move(*frame));
        take_frames();
    }
    if (frames_.levels() != level_) begin_level();
    describe();
    if (frames_.blocks() < least_blocks_to_judge) return {};
    return frames_.expect_readable();
}

void Stream::take_frames() {
    while (auto frame = tracker_.next()) {
        rate_.count(frame->time);
        updates_.emplace_back(std::move(*frame));
    }
}

// The frames of the level before are complete.
void Stream::begin_level() {
    tracker_.finish();
    take_frames();
    tracker_ = {};
    teams_.clear();
    level_ = frames_.levels();
}

// Nothing before it is known what the level's map is.
void Stream::describe() {
    if (frames_.map().empty()) return;
    Match now{frames_.levels(), frames_.map(), players(), rate_.hz()};
    if (now == match_) return;
    match_ = now;
    updates_.emplace_back(std::move(now));
}

std::vector<Player> Stream::players() {
    std::vector<Player> players;
    for (std::size_t slot = 0; slot < quakeworld::max_slots; ++slot) {
        const quakeworld::Client& client = frames_.clients()[slot];
        if (client.name.empty() || client.spectator) continue;
        players.push_back({static_cast<quakeworld::Slot>(slot),
                           frames_.teamplay() ? team_of(client.team) : std::uint8_t{0},
                           client.name.substr(0, longest_name)});
    }
    return players;
}

// Numbered as they appear; beyond 255 of a level, which are made up, everyone's enemies.
std::uint8_t Stream::team_of(const std::string& name) {
    constexpr std::size_t most = std::numeric_limits<std::uint8_t>::max();
    if (teams_.size() == most && !teams_.contains(name)) return 0;
    return teams_.emplace(name, static_cast<std::uint8_t>(teams_.size() + 1)).first->second;
}

}  // namespace camdir::qtv
