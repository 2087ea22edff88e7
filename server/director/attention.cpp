#include "director/attention.hpp"

#include <algorithm>
#include <cmath>

#include "director/clock.hpp"

namespace camdir::director {
namespace {

constexpr double death_hold_s = 1.5;
constexpr double min_score = 1e-3;
constexpr double usual_damage = 50.0;  // hit points
constexpr double most_damage = 100.0;  // that counts

// What an event is worth for its actor and its subject, in kills.
struct Worth {
    double actor;
    double subject;
};

// 1 where the hit points are not known.
double share_of_usual_damage(double hit_points) {
    return hit_points > 0.0 ? std::min(hit_points, most_damage) / usual_damage : 1.0;
}

Worth worth(const MatchEvent& event) {
    switch (event.kind) {
        case 1:
            return {1.0, 0.25};  // kill
        case 2:
            return {1.0, 0.0};  // flag taken
        case 3:
            return {2.0, 0.0};  // flag captured
        case 4:
            return {1.0, 0.0};  // objective
        case 5: {               // damage
            const double share = share_of_usual_damage(event.value);
            return {0.2 * share, 0.1 * share};
        }
        case 6:
            return {0.5, 0.0};  // award
        case 7:
            return {0.25, 0.0};  // item
        default:                 // a round concerns nobody in particular
            return {0.0, 0.0};
    }
}

// 0 when `to` is before `from`.
double seconds_since(std::int64_t from, std::int64_t to) {
    return std::max(0.0, seconds_between(from, to));
}

bool alive(const PlayerPose& pose) {
    return (pose.flags & pose_alive) != 0;
}

bool in_group(std::uint32_t player, std::span<const std::uint32_t> group) {
    return group.empty() || std::binary_search(group.begin(), group.end(), player);
}

}  // namespace

void Attention::record(const MatchEvent& event, double half_life_s) {
    const auto [actor, subject] = worth(event);
    add(event.actor, actor, event.frame_time, half_life_s);
    add(event.subject, subject, event.frame_time, half_life_s);
}

void Attention::add(std::uint32_t player, double value, std::int64_t at, double half_life_s) {
    if (player == no_player || value <= 0.0) return;
    const auto found = std::find_if(scores_.begin(), scores_.end(),
                                    [&](const Score& score) { return score.player == player; });
    if (found != scores_.end()) {
        found->value = score(player, at, half_life_s) + value;
        found->at = at;
        return;
    }
    if (scores_.size() >= max_players)
        std::erase_if(scores_,
                      [&](const Score& old) { return score(old.player, at, half_life_s) < min_score; });
    if (scores_.size() < max_players) scores_.push_back({player, value, at});
}

double Attention::score(std::uint32_t player, std::int64_t now, double half_life_s) const {
    const auto found = std::find_if(scores_.begin(), scores_.end(),
                                    [&](const Score& score) { return score.player == player; });
    if (found == scores_.end()) return 0.0;
    return found->value * std::exp2(-seconds_since(found->at, now) / half_life_s);
}

void Attention::choose(AutomaticTarget& target, std::span<const std::uint32_t> group,
                       std::span<const PlayerPose> poses, const Roster& roster, const config::Matches& rules,
                       std::int64_t now) const {
    const PlayerPose* best = nullptr;
    double best_score = 0.0;
    for (const PlayerPose& candidate : poses) {
        const PlayerPose* pose = roster.pose(candidate.player_id);
        if (pose == nullptr || !in_group(pose->player_id, group)) continue;
        const double candidate_score = score(pose->player_id, now, rules.automatic_half_life_s);
        const bool better =
            best == nullptr || (alive(*pose) != alive(*best)    ? alive(*pose)
                                : candidate_score != best_score ? candidate_score > best_score
                                                                : pose->player_id < best->player_id);
        if (!better) continue;
        best = pose;
        best_score = candidate_score;
    }
    if (best == nullptr) return;  // no candidate is present: the camera waits for its target

    // Game clocks may go back.
    target.chosen_at = std::min(target.chosen_at, now);
    target.died_at = std::min(target.died_at, now);
    const PlayerPose* current = in_group(target.player, group) ? roster.pose(target.player) : nullptr;
    if (current != nullptr && !alive(*current)) {
        if (!target.dead) target.died_at = now;
        target.dead = true;
        if (!alive(*best) || seconds_since(target.died_at, now) < death_hold_s) return;
    } else if (current != nullptr) {
        target.dead = false;
        const double lead = best_score - score(target.player, now, rules.automatic_half_life_s);
        if (seconds_since(target.chosen_at, now) < rules.automatic_hold_s) return;
        if (lead <= 0.0 || lead < rules.automatic_lead) return;
    }
    target = {best->player_id, now, now, !alive(*best)};
}

}  // namespace camdir::director
