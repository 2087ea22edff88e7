// Match: whom its automatic shots follow.
#include <spdlog/spdlog.h>

#include <algorithm>

#include "director/match.hpp"

namespace camdir::director {
namespace {

std::string text_of(const Reason& reason) {
    std::string text = reason.why;
    if (reason.actor != no_player) text += " " + std::to_string(reason.actor);
    if (reason.subject != no_player)
        text += (reason.actor != no_player ? "-" : " ") + std::to_string(reason.subject);
    return text;
}

std::string text_of(const AutomaticShot& shot) {
    if (shot.fixed != freespace::none) return "shows the map's fixed shot " + std::to_string(shot.fixed);
    return "follows player " + std::to_string(shot.player);
}

}  // namespace

Edit::Setting Match::edit_setting() const {
    return {space_shown(), config_->direction, static_cast<std::size_t>(config_->limits.players),
            delay_.state().delay_s, static_cast<double>(camera_rate_hz())};
}

void Match::choose_targets(const PoseFrame& frame, CameraFrame& cameras) {
    cameras.reasons.clear();
    std::vector<Shot>& shots = requests_.shots();
    if (std::ranges::any_of(shots, &Shot::is_automatic))
        edit_.show(frame, delay_, edit_setting());
    else
        edit_.clear();
    for (Shot& shot : shots) {
        const bool cuts = shot.is_automatic() && choose_automatic_target(shot, cameras);
        const std::uint32_t target = shot.is_automatic()  ? shot.automatic.player
                                     : shot.is_of_group() ? shot.key.group.front()
                                                          : shot.key.target;
        const std::uint32_t fixed = shot.is_automatic() ? shot.automatic.fixed : freespace::none;
        if (target != shot.target || fixed != shot.fixed) {
            // Only of a cut of its own: where another director's is followed, its camera has a place already.
            const auto line = cuts ? line_to_keep(shot, target) : std::nullopt;
            shot.restart();
            shot.state.line = line;
        }
        shot.target = target;
        shot.fixed = fixed;
    }
}

// The line of action of a cut to the player `next`. Two living enemies have one whether or not the freespace
// lets them see each other: it takes some for hidden who are not.
std::optional<camera::LineOfAction> Match::line_to_keep(const Shot& shot, std::uint32_t next) const {
    const std::uint32_t before = shot.fixed == freespace::none ? shot.target : edit_.subject_of(shot.fixed);
    if (before == no_player || next == no_player || before == next) return {};
    const PlayerPose* one = roster_.pose(before);
    const PlayerPose* other = roster_.pose(next);
    if (one == nullptr || other == nullptr || (one->flags & other->flags & pose_alive) == 0) return {};
    if (!direction::enemies(roster_.team(before), roster_.team(next))) return {};
    return camera::LineOfAction{one->eye, shot.position};
}

bool Match::choose_automatic_target(Shot& shot, CameraFrame& cameras) {
    AutomaticShot& automatic = shot.automatic;
    const bool begins = edit_.choose(automatic, {shot.key.group, shot.key.team}, roster_, edit_setting());
    if (!automatic.is_on_air()) return false;
    if (begins || edit_.repeats_reasons()) cameras.reasons.push_back({shot.camera_id, automatic.reason});
    if (!begins) return false;
    if (const auto left_out = cuts_logged_.take(std::chrono::steady_clock::now()))
        spdlog::debug("match {}: camera {} {}: {}{}", match_id_, shot.camera_id, text_of(automatic),
                      text_of(automatic.reason),
                      *left_out == 0 ? "" : fmt::format(" ({} cuts before it left out)", *left_out));
    return true;
}

}  // namespace camdir::director
