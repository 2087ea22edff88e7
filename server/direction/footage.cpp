#include "direction/footage.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace camdir::direction {
namespace {

float cosine_of_aim(const PlayerState& a, const PlayerState& b) {
    return a.facing.dot((b.eye - a.eye).normalized());
}

std::vector<Meeting> meetings_of(std::span<const PlayerState> players) {
    std::vector<Meeting> meetings;
    for (Index a = 0; a < players.size(); ++a) {
        const PlayerState& one = players[a];
        if (!one.alive || one.sees.none()) continue;
        for (Index b = a + 1; b < players.size(); ++b) {
            const PlayerState& other = players[b];
            if (!one.sees[b] || !other.alive || !enemies(one, other)) continue;
            meetings.push_back({a, b, (one.eye - other.eye).norm(),
                                std::max(cosine_of_aim(one, other), cosine_of_aim(other, one))});
        }
    }
    return meetings;
}

// Blocks of so many words get more of them, of zeros.
void widen(std::vector<Footage::Word>& blocks, std::size_t from, std::size_t to) {
    const std::size_t count = from > 0 ? blocks.size() / from : 0;
    std::vector<Footage::Word> wide(count * to, 0);
    for (std::size_t block = 0; block < count; ++block)
        std::copy_n(blocks.begin() + static_cast<std::ptrdiff_t>(block * from), from,
                    wide.begin() + static_cast<std::ptrdiff_t>(block * to));
    blocks = std::move(wide);
}

}  // namespace

Beat beat_of(double seconds) {
    constexpr double rounding = 1e-6;  // of times that are multiples of a beat
    return static_cast<Beat>(std::floor(seconds / beat_s + rounding));
}

bool enemies(std::uint8_t team, std::uint8_t other) {
    return team != other || team == 0;
}

bool enemies(const PlayerState& a, const PlayerState& b) {
    return enemies(a.team, b.team);
}

Index subject_in(const Take& take, std::span<const PlayerState> players) {
    const auto meets = [&](const PlayerState& player) {
        for (std::size_t other = 0; other < players.size(); ++other)
            if (player.sees[other] && players[other].alive && enemies(player, players[other])) return true;
        return false;
    };
    Index subject = nobody;
    float least = 0.0F;
    bool fights = false;
    for (Index player = 0; player < players.size(); ++player) {
        const PlayerState& state = players[player];
        if (!take.shown[player] || !state.alive) continue;
        const bool is_fighting = meets(state);
        const float distance = (state.eye - take.position).norm();
        if (subject != nobody && (fights != is_fighting ? fights : distance >= least)) continue;
        subject = player;
        least = distance;
        fights = is_fighting;
    }
    return subject;
}

Footage::Footage(std::size_t players, std::vector<Index> followed)
    : players_(players), followed_(std::move(followed)), jumps_(followed_.size()) {
    assert(players_ <= max_players);
}

void Footage::append(std::span<const PlayerState> players, std::span<const Take> takes) {
    assert(players.size() == players_ && takes.size() == followed_.size());
    for (std::size_t rush = 0; rush < takes.size(); ++rush)
        if (takes[rush].cut) jumps_[rush].push_back(beats());
    Row& row = rows_.emplace_back();
    row.players.assign(players.begin(), players.end());
    row.takes.assign(takes.begin(), takes.end());
    row.meetings = meetings_of(players);
    look_up_showing(row);
}

void Footage::look_up_showing(Row& row) const {
    row.showing.assign((players_ + 1) * words(), 0);
    for (std::size_t rush = 0; rush < row.takes.size(); ++rush)
        for (std::size_t player = 0; player < players_; ++player)
            if (row.takes[rush].shown[player])
                row.showing[player * words() + rush / word_bits] |= Word{1} << rush % word_bits;
}

// Nothing before shows them, and their rush shows nobody.
void Footage::add_player() {
    assert(players_ < max_players);
    const std::size_t words_before = words();
    const auto player = static_cast<Index>(players_++);
    followed_.push_back(player);
    jumps_.emplace_back();
    for (Row& row : rows_) {
        row.players.emplace_back();
        row.takes.emplace_back().subject = player;
        if (words() > words_before) widen(row.showing, words_before, words());
        row.showing.resize((players_ + 1) * words(), 0);
    }
}

std::size_t Footage::rush_following(Index player) const {
    const auto found = std::ranges::find(followed_, player);
    assert(found != followed_.end());
    return static_cast<std::size_t>(found - followed_.begin());
}

void Footage::forget_before(Beat beat) {
    for (; first_ < std::min(beat, beats()); ++first_)
        rows_.pop_front();
    for (std::vector<Beat>& jumps : jumps_)
        jumps.erase(jumps.begin(), std::ranges::lower_bound(jumps, first_));
}

}  // namespace camdir::direction
