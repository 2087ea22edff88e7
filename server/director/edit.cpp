#include "director/edit.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <utility>

#include "camera/evade.hpp"
#include "direction/editor.hpp"
#include "director/clock.hpp"
#include "freespace/fixed_shots.hpp"

namespace camdir::director {
namespace {

using direction::beat_of;
using direction::beat_s;
using direction::cut_every;
using direction::Index;
using direction::nobody;

constexpr double longest_foresight_s = 10.0;
// What is not here so long before it is shown may come any time later.
constexpr double arrival_s = 0.3;
constexpr direction::Beat catches_up = 3;  // beats in one
// That are looked at before they are known to decisions, so that no decision waits for them.
constexpr direction::Beat scouted_ahead = catches_up;
constexpr double longest_step_back_s = 1.0;
constexpr double longest_gap_s = 30.0;
constexpr double slowest_rate_hz = 10.0;
constexpr double threat_every_s = 0.25;  // as far as camera::is_threatened() looks
constexpr std::int64_t cut_every_ns = 200'000'000;

double unit_of(const freespace::Freespace& freespace) {
    return metres_of_nominal_unit / static_cast<double>(freespace.metadata().metres_per_unit);
}

// A multiple of the time between cuts, at or before; without overflow.
std::int64_t aligned(std::int64_t time) {
    if (time < std::numeric_limits<std::int64_t>::min() + cut_every_ns) return time;
    const std::int64_t rest = time % cut_every_ns;
    return time - (rest < 0 ? rest + cut_every_ns : rest);
}

bool in_group(std::uint32_t player, std::span<const std::uint32_t> group) {
    return group.empty() || std::ranges::binary_search(group, player);
}

std::size_t fixed_shots_of(const Edit::Setting& setting) {
    return setting.rules.grammar.fixed_shots ? setting.space.map().fixed_shots().size() : 0;
}

}  // namespace

std::optional<direction::EventKind> directed_kind(MatchEventKind kind, std::string_view detail) {
    using direction::EventKind;
    switch (kind) {
        case MatchEventKind::kill:
            return EventKind::kill;
        case MatchEventKind::flag_taken:
            return EventKind::flag_taken;
        case MatchEventKind::flag_captured:
            return EventKind::flag_captured;
        case MatchEventKind::objective:
            return EventKind::objective;
        case MatchEventKind::damage:
            return EventKind::damage;
        case MatchEventKind::award:
            return EventKind::award;
        case MatchEventKind::item:
            return EventKind::item;
        case MatchEventKind::round:
            if (detail != "end") return {};
            return EventKind::round_won;
        case MatchEventKind::spawn:
            return EventKind::spawn;
        default:
            return {};
    }
}

void AutomaticShot::follow(std::uint32_t target, std::uint32_t fixed_shot, std::int64_t frame_time,
                           const Reason* why) {
    player = target;
    fixed = fixed_shot;
    since = frame_time;
    reason = why != nullptr ? *why : Reason{};
    edit = 0;
}

double Edit::foresight_s(double delay_s) {
    return std::clamp(delay_s - arrival_s, 0.0, longest_foresight_s);
}

void Edit::clear() {
    if (!begun_) return;
    Edit next;
    next.generation_ = generation_ + 1;
    next.teams_ = std::move(teams_);
    *this = std::move(next);
}

void Edit::set_players(std::span<const Player> players) {
    if (!foresees_) take_teams(players);
}

void Edit::take_teams(std::span<const Player> players) {
    teams_.clear();
    for (const Player& player : players)
        teams_[player.id] = player.team;
}

void Edit::record(const MatchEvent& event) {
    if (begun_ && !foresees_) add(event);
}

double Edit::seconds(std::int64_t frame_time) const {
    return seconds_between(start_, frame_time);
}

void Edit::begin(const PoseFrame& frame, const Setting& setting) {
    clear();
    begun_ = true;
    fixed_ = fixed_shots_of(setting);
    material_ = direction::Material(0, std::vector(fixed_, nobody));
    start_ = aligned(frame.frame_time);
    newest_ = shown_ = seconds(frame.frame_time) - beat_s;
    shown_beat_ = beat_of(seconds(frame.frame_time));
    end_ = shown_beat_ + catches_up;
    obstacles_.set_map(&setting.space.map());
}

void Edit::show(const PoseFrame& frame, const DelayBuffer& delay, const Setting& setting) {
    const double time = seconds(frame.frame_time);
    if (!begun_ || is_full_ || fixed_ != fixed_shots_of(setting) || time < shown_ - longest_step_back_s ||
        time > newest_ + longest_gap_s)
        begin(frame, setting);
    shown_ = std::max(shown_, seconds(frame.frame_time));
    const direction::Beat before = std::exchange(shown_beat_, beat_of(shown_));
    const direction::Beat foresight = beat_of(foresight_s(setting.delay_s));
    end_ = std::min(shown_beat_ + foresight, std::max(end_, before) + catches_up * (shown_beat_ - before));
    frame_time_ = frame.frame_time;

    foresees_ = delay.look_ahead(
        position_,
        [&](const PoseFrame& later) {
            if (later.epoch != frame.epoch) return later.epoch < frame.epoch;
            const bool past = static_cast<std::int32_t>(later.frame_number - frame.frame_number) < 0;
            return past || take(later, setting);
        },
        [&](const auto& heard) {
            if (heard.epoch == frame.epoch) add(heard);
        });
    if (newest_ < shown_) take(frame, setting);

    const direction::Beat cut = shown_beat_ - shown_beat_ % cut_every;
    due_ = cut > decided_;
    if (!due_) return;
    decided_ = cut;
    finish(setting);
    material_.forget_before(cut);
    moments_ = material_.moments(setting.rules, unit_of(setting.space.map()), cut);
}

// Returns false for a frame that is to be known later.
bool Edit::take(const PoseFrame& frame, const Setting& setting) {
    const double time = seconds(frame.frame_time);
    if (time < newest_ - longest_step_back_s || time > newest_ + longest_gap_s) return false;
    if (time <= newest_) return true;
    const direction::Beat number = beat_of(time);
    if (!beats_.empty() && number > beats_.back().number) beats_.back().ended = true;
    if (number >= end_ + scouted_ahead && number > shown_beat_) return false;
    newest_ = time;
    const auto poses = std::span(frame.poses).first(std::min(frame.poses.size(), setting.max_players));
    const bool known = beats_.empty() ? number < material_.footage().beats() : number <= beats_.back().number;
    if (!known) begin_beat(number, frame, poses);
    for (const PlayerPose& pose : poses) {
        const Index place = place_of(pose.player_id);
        if (continuity_.broken(pose) && place != nobody && !beats_.empty())
            beats_.back().scout.takes[fixed_ + place].jump(!known);
    }
    return true;
}

void Edit::begin_beat(direction::Beat number, const PoseFrame& frame, std::span<const PlayerPose> poses) {
    for (const PlayerPose& pose : poses) {
        if ((pose.flags & pose_spectator) != 0 || places_.contains(pose.player_id)) continue;
        is_full_ = players_.size() == direction::max_players;
        if (is_full_) break;
        places_[pose.player_id] = static_cast<Index>(players_.size());
        players_.push_back(pose.player_id);
        material_.add_player();
        for (PendingBeat& beat : beats_)
            beat.scout.add_player();
    }
    PendingBeat& beat = beats_.emplace_back(number, seconds(frame.frame_time), frame.movers, fixed_);
    while (beat.scout.players.size() < players_.size())
        beat.scout.add_player();
    for (const PlayerPose& pose : poses) {
        const Index place = place_of(pose.player_id);
        if (place == nobody || (pose.flags & pose_spectator) != 0 || beat.scout.players[place].present)
            continue;
        beat.scout.players[place] = state_of(pose, place);
        beat.scout.present.push_back(place);
    }
}

direction::PlayerState Edit::state_of(const PlayerPose& pose, Index place) const {
    direction::PlayerState state;
    state.eye = pose.eye;
    state.facing = pose.orientation * Vec3f::UnitX();
    state.speed = pose.velocity.isZero() ? speed_over_beat(pose.eye, place) : pose.velocity.norm();
    const auto team = teams_.find(pose.player_id);
    state.team = team == teams_.end() ? std::uint8_t{0} : team->second;
    state.present = true;
    state.alive = (pose.flags & pose_alive) != 0;
    return state;
}

// Of a game that sends no velocities.
float Edit::speed_over_beat(const Vec3f& eye, Index place) const {
    const direction::Beat last = material_.footage().beats() - 1;
    const bool pending = beats_.size() > 1;  // the last one is this
    if (!pending && last < material_.footage().first()) return 0.0F;
    const direction::PlayerState& before =
        pending ? std::prev(beats_.end(), 2)->scout.players[place] : material_.footage().player(last, place);
    return before.present ? (eye - before.eye).norm() / static_cast<float>(beat_s) : 0.0F;
}

Index Edit::place_of(std::uint32_t player) const {
    const auto found = places_.find(player);
    return found == places_.end() ? nobody : found->second;
}

void Edit::look(const Setting& setting) {
    const double frames_per_beat = std::max(setting.rate_hz, slowest_rate_hz) * beat_s;
    const auto waiting =
        std::ranges::count_if(beats_, [](const PendingBeat& beat) { return !beat.scout.finished(); });
    const double share = static_cast<double>(std::min(waiting, std::ptrdiff_t{catches_up})) / frames_per_beat;
    auto most = static_cast<std::size_t>(std::ceil(share * static_cast<double>(players_.size())));
    for (PendingBeat& beat : beats_)
        for (; most > 0 && !beat.scout.finished(); --most)
            look_at_next(beat, setting);
    append_finished();
}

// One beat after the other: each has the movers of its own frame.
void Edit::look_at_next(PendingBeat& beat, const Setting& setting) {
    if (beat.scout.done == 0) obstacles_.add(beat.time, beat.movers);
    const freespace::Space space(setting.space.map(), &obstacles_.movers());
    beat.scout.look(space.at(beat.time), static_cast<float>(unit_of(space.map())));
}

void Edit::finish(const Setting& setting) {
    for (PendingBeat& beat : beats_)
        while (beat.number < end_ && beat.ended && !beat.scout.finished())
            look_at_next(beat, setting);
    append_finished();
}

// A beat without a frame is as the one before.
void Edit::append_finished() {
    const direction::Footage& footage = material_.footage();
    const auto is_known = [&](const PendingBeat& beat) {
        return beat.number < end_ && beat.ended && beat.scout.finished();
    };
    for (; !beats_.empty() && is_known(beats_.front()); beats_.pop_front()) {
        const PendingBeat& beat = beats_.front();
        while (footage.beats() < beat.number) {
            const direction::Beat last = footage.beats() - 1;
            std::vector players = beat.scout.players;  // of the first beat, if none is known
            std::vector takes = beat.scout.takes;
            if (last >= footage.first()) {
                players.assign(footage.players_at(last).begin(), footage.players_at(last).end());
                takes.assign(footage.takes_at(last).begin(), footage.takes_at(last).end());
            }
            for (direction::Take& take : takes)
                take.forget_jumps();
            material_.append(players, takes);
        }
        material_.append(beat.scout.players, beat.scout.takes);
    }
}

void Edit::add(const MatchEvent& event) {
    const auto kind = directed_kind(static_cast<MatchEventKind>(event.kind), event.detail);
    const double time = seconds(event.frame_time);
    if (!kind || time < 0.0 || time > newest_ + longest_gap_s) return;
    material_.add(
        {time, *kind, place_of(event.actor), place_of(event.subject), static_cast<double>(event.value)});
}

void Edit::add(const MatchInfo& info) {
    take_teams(info.players);
}

bool Edit::choose(AutomaticShot& shot, const Among& among, const Roster& roster,
                  const Setting& setting) const {
    const std::size_t on_air = rush_of(shot);
    const bool stays = may_stay(on_air, among, roster, setting);
    if (stays && !due_) return false;
    std::vector<std::size_t> choice = choice_of(on_air, among, roster, setting);
    if (choice.empty()) {
        if (!stays && shot.player != no_player && !roster.is_of(shot.player, among.team))
            shot.follow(no_player, freespace::none, frame_time_, nullptr);  // nobody of the team is to be had
        return false;
    }
    if (shot.edit != generation_) {
        shot.cutter = {};
        shot.edit = generation_;
        const double begun = seconds(shot.since);  // before the material began: its length counts anew
        const direction::Beat since = begun < 0.0 ? decided_ : std::min(beat_of(begun), decided_);
        if (stays) shot.cutter.cut_to({on_air, since, since, {}});
    }
    if (!stays) keep_living(choice, roster);
    const auto begun = shot.cutter.decide(material_, moments_, setting.rules, unit_of(setting.space.map()),
                                          decided_, choice);
    if (!begun) return false;
    const bool is_fixed = begun->rush < fixed_;
    shot.player = is_fixed ? no_player : players_[begun->rush - fixed_];
    shot.fixed = is_fixed ? static_cast<std::uint32_t>(begun->rush) : freespace::none;
    shot.since = frame_time_;
    shot.reason = reason_of(begun->reason, setting.rules);
    return true;
}

bool Edit::may_stay(std::size_t rush, const Among& among, const Roster& roster,
                    const Setting& setting) const {
    if (rush >= material_.footage().rushes()) return false;
    if (rush >= fixed_) return is_to_be_had(rush, among, roster);
    return has_fixed(among) && !is_threatened(setting.space, rush);
}

std::vector<std::size_t> Edit::choice_of(std::size_t on_air, const Among& among, const Roster& roster,
                                         const Setting& setting) const {
    std::vector<std::size_t> choice;
    for (std::size_t rush = fixed_; rush < fixed_ + players_.size(); ++rush)
        if (is_to_be_had(rush, among, roster)) choice.push_back(rush);
    if (choice.empty() || !has_fixed(among)) return choice;
    for (std::size_t rush = 0; rush < fixed_; ++rush)
        if (rush == on_air ? !is_threatened(setting.space, rush) : may_begin(rush, roster, setting))
            choice.push_back(rush);
    return choice;
}

bool Edit::is_to_be_had(std::size_t rush, const Among& among, const Roster& roster) const {
    const std::uint32_t player = players_[rush - fixed_];
    return in_group(player, among.group) && roster.is_of(player, among.team) &&
           roster.pose(player) != nullptr;
}

bool Edit::has_fixed(const Among& among) const {
    return among.all() && material_.footage().beats() != material_.footage().first();
}

// The material knows whom movers hide, not whether they come to the camera: none is near it for as long as a
// shot lasts at least, as far as the delay lets it be known, and none is between it and whom it would show in
// this very frame.
bool Edit::may_begin(std::size_t fixed, const Roster& roster, const Setting& setting) const {
    const freespace::Space& now = setting.space;
    if (!now.has_movers()) return true;
    const double ahead = std::min(setting.rules.grammar.minimum_shot_s, setting.delay_s);
    for (double later = 0.0; later <= ahead; later += threat_every_s)
        if (is_threatened(now.at(now.time() + later), fixed)) return false;
    const std::uint32_t subject = subject_of(static_cast<std::uint32_t>(fixed));
    const PlayerPose* pose = subject == no_player ? nullptr : roster.pose(subject);
    return pose == nullptr || now.mover_sweep(now.map().fixed_shots()[fixed].position, pose->eye, 0.0F).clear;
}

std::uint32_t Edit::subject_of(std::uint32_t fixed) const {
    const direction::Footage& footage = material_.footage();
    if (footage.beats() == footage.first() || fixed >= fixed_) return no_player;
    const direction::Beat seen = std::clamp(decided_, footage.first(), footage.beats() - 1);
    const Index subject = footage.take(seen, fixed).subject;
    return subject == nobody ? no_player : players_[subject];
}

bool Edit::is_threatened(const freespace::Space& space, std::size_t fixed) {
    const float room = freespace::fixed_shot_room * static_cast<float>(unit_of(space.map()));
    return camera::is_threatened(space, space.map().fixed_shots()[fixed].position, room);
}

void Edit::keep_living(std::vector<std::size_t>& choice, const Roster& roster) const {
    const auto is_of = [&](std::size_t rush, bool alive) {
        return rush >= fixed_ && ((roster.pose(players_[rush - fixed_])->flags & pose_alive) != 0) == alive;
    };
    if (std::ranges::any_of(choice, [&](std::size_t rush) { return is_of(rush, true); }))
        std::erase_if(choice, [&](std::size_t rush) { return is_of(rush, false); });
}

std::size_t Edit::rush_of(const AutomaticShot& shot) const {
    const std::size_t none = material_.footage().rushes();
    if (shot.fixed < fixed_) return shot.fixed;
    const Index place = place_of(shot.player);
    return place == nobody ? none : fixed_ + place;
}

Reason Edit::reason_of(const direction::Reason& reason, const direction::Rules& rules) const {
    const auto id = [&](Index place) { return place == nobody ? no_player : players_[place]; };
    return {id(reason.actor), id(reason.subject), std::string(direction::name_of(reason, rules))};
}

}  // namespace camdir::director
