#include "direction/grammar.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace camdir::direction {
namespace {

constexpr Beat idle_after = 20;
// Sine: a camera that moves and is foreseen to be no farther off the line of action may come to be on its
// other side.
constexpr float uncertain_side = 0.5F;

// Of the line through both, seen from above: the sine of the angle at `from`; its sign tells the side.
float side_of(const Vec3f& from, const Vec3f& to, const Vec3f& point) {
    const Eigen::Vector2f line = (to - from).head<2>();
    const Eigen::Vector2f offset = (point - from).head<2>();
    const float lengths = std::sqrt(line.squaredNorm() * offset.squaredNorm());
    return lengths > 0.0F ? (line.x() * offset.y() - line.y() * offset.x()) / lengths : 0.0F;
}

// Between the subjects of two rushes, and where their cameras are.
struct LineOfAction {
    bool in_sight;
    float side_before, side_after;
};

// None but between two living enemies.
std::optional<LineOfAction> line_between(const Footage& footage, Beat beat, std::size_t from,
                                         std::size_t to) {
    const auto takes = footage.takes_at(beat);
    const Take& before = takes[from];
    const Take& after = takes[to];
    const Index a = before.subject;
    const Index b = after.subject;
    if (a == nobody || b == nobody || a == b) return {};
    const auto players = footage.players_at(beat);
    const PlayerState& one = players[a];
    const PlayerState& other = players[b];
    if (!one.alive || !other.alive || !enemies(one, other)) return {};
    return LineOfAction{one.sees[b], side_of(one.eye, other.eye, before.position),
                        side_of(one.eye, other.eye, after.position)};
}

bool sees_an_enemy(const Footage& footage, Beat beat, std::size_t player) {
    const PlayerState& state = footage.player(beat, player);
    for (std::size_t other = 0; other < footage.players(); ++other)
        if (state.sees[other] && footage.player(beat, other).alive &&
            enemies(state, footage.player(beat, other)))
            return true;
    return false;
}

// From `begin` to before `end`.
bool jumps_between(const Footage& footage, std::size_t rush, Beat begin, Beat end) {
    const std::vector<Beat>& jumps = footage.jumps(rush);
    const auto next = std::ranges::lower_bound(jumps, begin);
    return next != jumps.end() && *next < end;
}

// At the subject of either rush, whom both have.
bool looks_the_same_way(const Footage& footage, const Grammar& grammar, Beat beat, std::size_t from,
                        std::size_t to, PlayerSet Take::*has) {
    const auto takes = footage.takes_at(beat);
    const auto players = footage.players_at(beat);
    const Take& before = takes[from];
    const Take& after = takes[to];
    const auto near = static_cast<float>(grammar.jump_cosine);
    for (const Index player : {before.subject, after.subject}) {
        if (player == nobody || !(before.*has)[player] || !(after.*has)[player]) continue;
        const Vec3f& eye = players[player].eye;
        const Vec3f one = eye - before.position;
        const Vec3f other = eye - after.position;
        if (one.dot(other) > near * std::sqrt(one.squaredNorm() * other.squaredNorm())) return true;
    }
    return false;
}

}  // namespace

double length_cost(const Grammar& grammar, Beat length) {
    const double ratio = static_cast<double>(length) * beat_s / grammar.preferred_shot_s;
    const double deviation = std::log(std::max(ratio, 1e-3));
    return grammar.length * deviation * deviation;
}

bool jump_cut(const Footage& footage, const Grammar& grammar, Beat beat, std::size_t from, std::size_t to) {
    return looks_the_same_way(footage, grammar, beat, from, to, &Take::shown);
}

bool may_be_jump_cut(const Footage& footage, const Grammar& grammar, Beat beat, std::size_t from,
                     std::size_t to) {
    return looks_the_same_way(footage, grammar, beat, from, to, &Take::framed);
}

bool crosses_line(const Footage& footage, Beat beat, std::size_t from, std::size_t to) {
    const auto line = line_between(footage, beat, from, to);
    return line && line->in_sight && line->side_before * line->side_after < 0.0F;
}

bool may_cross_line(const Footage& footage, Beat beat, std::size_t from, std::size_t to) {
    const auto line = line_between(footage, beat, from, to);
    if (!line) return false;
    const bool gives_way = !footage.is_fixed(to) || footage.is_fixed(from);
    if (!gives_way && std::abs(line->side_before) < uncertain_side) return true;
    return line->side_before * line->side_after < 0.0F;
}

bool jumped_just_before(const Footage& footage, Beat beat, std::size_t rush) {
    return jumps_between(footage, rush, beat - shortest_piece + 1, beat);
}

bool jumps_soon_after(const Footage& footage, Beat beat, std::size_t rush) {
    return footage.jumps_late(beat, rush) || jumps_between(footage, rush, beat + 1, beat + shortest_piece);
}

bool stands_idle(const Footage& footage, Beat beat, std::size_t player, double slow) {
    if (!footage.player(beat, player).alive) return false;
    const Beat first = std::max(footage.first(), beat - idle_after + 1);
    if (beat - first + 1 < idle_after) return false;
    for (Beat b = first; b <= beat; ++b)
        if (footage.player(b, player).speed > static_cast<float>(slow)) return false;
    return !sees_an_enemy(footage, beat, player);
}

}  // namespace camdir::direction
