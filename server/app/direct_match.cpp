#include "app/direct_match.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <string_view>

#include "base/parallel.hpp"
#include "director/clock.hpp"
#include "director/edit.hpp"
#include "director/messages.hpp"
#include "director/scout.hpp"
#include "evaluation/picture.hpp"
#include "evaluation/recording.hpp"
#include "evaluation/replay.hpp"

namespace camdir::app {
namespace {

using direction::Beat;
using direction::EventKind;
using direction::Index;
using direction::PlayerState;
using direction::Take;
using evaluation::CameraPath;
using evaluation::Trace;
using evaluation::TraceFrame;
using evaluation::TracePose;

// Of the footage that is kept, gigabytes. A beat of a rush has some figures, and one more for each player.
constexpr double max_figures = 4e8;
constexpr double figures_of_a_rush = 32.0;

Index index_of(const Trace& trace, std::uint32_t player) {
    return static_cast<Index>(std::ranges::lower_bound(trace.players, player) - trace.players.begin());
}

double seconds_from_start(const Trace& trace, std::int64_t time) {
    return director::seconds_between(trace.frames.front().time, time);
}

void read_players(const Trace& trace, std::span<const TracePose> poses, std::vector<PlayerState>& players) {
    for (const TracePose& pose : poses) {
        PlayerState& state = players[index_of(trace, pose.player)];
        state.eye = pose.eye.cast<float>();
        state.facing = (pose.orientation * Vec3d::UnitX()).cast<float>();
        state.speed = static_cast<float>(pose.velocity.norm());
        state.team = pose.team;
        state.present = true;
        state.alive = pose.alive;
    }
}

// Calls read(frames, players, takes) for each beat, from several threads. A beat without a frame repeats the
// one before, without its cuts.
template <class Read>
Result<direction::Footage> read_beats(const Trace& trace, const std::stop_token& stop, const Read& read) {
    std::vector<std::vector<TraceFrame>> beats;
    for (const TraceFrame& frame : trace.frames) {
        const auto beat = static_cast<std::size_t>(beat_at(trace, frame.time));
        beats.resize(std::max(beats.size(), beat + 1));
        beats[beat].push_back(frame);
    }
    std::vector<std::vector<PlayerState>> players(beats.size());
    std::vector<std::vector<Take>> takes(beats.size());
    parallel_for(std::size_t{0}, beats.size(), [&](std::size_t beat) {
        if (!stop.stop_requested()) read(beats[beat], players[beat], takes[beat]);
    });
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    std::vector<Index> followed;  // and the fixed ones behind them
    for (std::size_t player = 0; player < trace.players.size(); ++player)
        followed.push_back(static_cast<Index>(player));
    followed.resize(takes.front().size(), direction::nobody);
    direction::Footage footage(trace.players.size(), std::move(followed));
    std::size_t filled = 0;
    for (std::size_t beat = 0; beat < beats.size(); ++beat) {
        if (!beats[beat].empty()) filled = beat;
        footage.append(players[filled], takes[filled]);
        for (Take& take : takes[filled])
            take.forget_jumps();  // of the beats that repeat this one
    }
    return footage;
}

// Who sees whom in one frame.
class FrameSight {
  public:
    FrameSight(const ClearLine& clear, evaluation::PlacedMovers movers)
        : clear_(clear), movers_(std::move(movers)) {}

    [[nodiscard]] bool operator()(const Vec3d& from, const Vec3d& to) const {
        return clear_(from, to) && !movers_.hide(from, to);
    }

  private:
    const ClearLine& clear_;
    evaluation::PlacedMovers movers_;
};

// One beat, from its frames.
class BeatReader {
  public:
    BeatReader(const Trace& trace, const RecordedMovers& movers, const CameraPath& cameras,
               std::span<const freespace::FixedShot> fixed, double unit, const ClearLine& clear)
        : trace_(trace), movers_(movers), cameras_(cameras), fixed_(fixed), unit_(unit), clear_(clear) {}

    void read(std::span<const TraceFrame> frames, std::vector<PlayerState>& players,
              std::vector<Take>& takes) const {
        players.assign(trace_.players.size(), {});
        takes.assign(players.size() + fixed_.size(), {});
        for (Index rush = 0; rush < players.size(); ++rush)
            takes[rush].subject = rush;
        for (const TraceFrame& frame : frames)
            read_frame(frame, &frame == &frames.front(), players, takes);
        for (Take& take : std::span(takes).subspan(players.size()))
            take.subject = direction::subject_in(take, players);
    }

  private:
    void read_frame(const TraceFrame& frame, bool first, std::vector<PlayerState>& players,
                    std::vector<Take>& takes) const {
        const auto poses = trace_.poses_of(frame);
        const FrameSight sight(clear_, movers_.exact_at(frame.time));
        if (first) see_each_other(sight, poses, players);
        std::vector<bool> present(players.size());
        for (std::uint32_t i = 0; i < frame.pose_count; ++i) {
            const evaluation::CameraSample& camera = cameras_[frame.first_pose + i];
            const Index rush = index_of(trace_, poses[i].player);
            Take& take = takes[rush];
            present[rush] = true;
            if (first) take.position = camera.position.cast<float>();
            if (camera.cut) take.jump(first);
            look(take, first, sight, camera.position, poses,
                 [&](const Vec3d& point) { return evaluation::in_picture(camera, point, 1.0); });
        }
        for (std::size_t rush = 0; rush < present.size(); ++rush)
            if (!present[rush]) takes[rush].shown.reset();
        for (std::size_t i = 0; i < fixed_.size(); ++i) {
            const freespace::FixedShot& shot = fixed_[i];
            Take& take = takes[present.size() + i];
            take.position = shot.position;
            look(take, first, sight, shot.position.cast<double>(), poses, [&](const Vec3d& point) {
                return freespace::frames(shot, point.cast<float>(), static_cast<float>(unit_));
            });
        }
    }

    void see_each_other(const FrameSight& sight, std::span<const TracePose> poses,
                        std::vector<PlayerState>& players) const {
        read_players(trace_, poses, players);
        for (std::size_t i = 0; i < poses.size(); ++i)
            for (std::size_t j = i + 1; j < poses.size(); ++j) {
                if (!sight(poses[i].eye, poses[j].eye)) continue;
                const Index a = index_of(trace_, poses[i].player);
                const Index b = index_of(trace_, poses[j].player);
                players[a].sees.set(b);
                players[b].sees.set(a);
            }
    }

    // frames(point): it is in the picture.
    template <class Frames>
    void look(Take& take, bool first, const FrameSight& sight, const Vec3d& camera,
              std::span<const TracePose> poses, const Frames& frames) const {
        direction::PlayerSet framed;
        direction::PlayerSet shown;
        for (const TracePose& pose : poses) {
            const Index player = index_of(trace_, pose.player);
            for (const Vec3d& point : {pose.eye, Vec3d(evaluation::player_box(pose, unit_).center())}) {
                if (!frames(point)) continue;
                framed.set(player);
                if (!shown[player] && sight(camera, point)) shown.set(player);
            }
        }
        take.shown = first ? shown : take.shown & shown;
        if (first) take.framed = framed;
    }

    const Trace& trace_;
    const RecordedMovers& movers_;
    const CameraPath& cameras_;
    std::span<const freespace::FixedShot> fixed_;
    double unit_;
    const ClearLine& clear_;
};

// The cameras of a running programme, shot after shot.
class ProgrammeShooter {
  public:
    ProgrammeShooter(const Trace& trace, const RecordedMovers& movers, const freespace::Freespace& freespace,
                     const direction::Footage& footage, std::span<const freespace::FixedShot> fixed,
                     double look_ahead, CameraPath cameras)
        : trace_(trace),
          movers_(movers),
          freespace_(freespace),
          footage_(footage),
          fixed_(fixed),
          look_ahead_(look_ahead),
          tracks_(evaluation::timed_poses_of_all(trace, trace.frames.front().time)),
          cameras_(std::move(cameras)) {}

    void shoot(const direction::Shot& shot, const direction::Shot* before) {
        if (footage_.is_fixed(shot.rush)) return;
        evaluation::FollowShot follow;
        follow.player = trace_.players[shot.rush];
        follow.first = first_frame(shot.begin);
        follow.end = first_frame(shot.end + 1);
        const auto line = before != nullptr ? line_to_keep(*before, shot) : std::nullopt;
        const auto cameras = evaluation::record(freespace_, camera::Profile{}, trace_, tracks_,
                                                movers_.rows(), look_ahead_, follow, line ? &*line : nullptr);
        for (std::size_t i = 0; i < cameras.size(); ++i)
            if (cameras[i])
                cameras_[evaluation::pose_of(trace_, trace_.frames[follow.first + i], follow.player)] =
                    *cameras[i];
    }

    [[nodiscard]] CameraPath cameras() && { return std::move(cameras_); }

  private:
    // Of the beat, or after it.
    [[nodiscard]] std::uint32_t first_frame(Beat beat) const {
        const auto is_before = [&](const TraceFrame& frame) { return beat_at(trace_, frame.time) < beat; };
        return static_cast<std::uint32_t>(std::ranges::partition_point(trace_.frames, is_before) -
                                          trace_.frames.begin());
    }

    // As the running director keeps it, but that it knows the camera before of the last frame, not of this
    // one.
    [[nodiscard]] std::optional<camera::LineOfAction> line_to_keep(const direction::Shot& before,
                                                                   const direction::Shot& shot) const {
        const Index subject = footage_.take(shot.begin, before.rush).subject;
        if (subject == direction::nobody || subject == shot.rush) return {};
        const PlayerState& one = footage_.player(shot.begin, subject);
        const PlayerState& other = footage_.player(shot.begin, shot.rush);
        if (!one.alive || !other.alive || !direction::enemies(one, other)) return {};
        const auto camera = position(before.rush, first_frame(shot.begin));
        if (!camera) return {};
        return camera::LineOfAction{one.eye, *camera};
    }

    [[nodiscard]] std::optional<Vec3f> position(std::size_t rush, std::uint32_t frame) const {
        if (footage_.is_fixed(rush)) return fixed_[rush - trace_.players.size()].position;
        const std::uint32_t pose = evaluation::pose_of(trace_, trace_.frames[frame], trace_.players[rush]);
        if (pose == evaluation::absent) return {};
        return cameras_[pose].position.cast<float>();
    }

    const Trace& trace_;
    const RecordedMovers& movers_;
    const freespace::Freespace& freespace_;
    const direction::Footage& footage_;
    std::span<const freespace::FixedShot> fixed_;
    double look_ahead_;
    std::vector<std::vector<camera::TimedPose>> tracks_;
    CameraPath cameras_;
};

// The beats in which a mover is near to the place of each fixed camera, ascending.
std::vector<std::vector<Beat>> beats_with_movers_near(const Trace& trace, const RecordedMovers& movers,
                                                      const freespace::Freespace& freespace,
                                                      std::span<const freespace::FixedShot> fixed,
                                                      double unit, const std::stop_token& stop) {
    const float room = freespace::fixed_shot_room * static_cast<float>(unit);
    const Beat end = beat_at(trace, trace.frames.back().time) + 1;
    std::vector<std::vector<Beat>> near(fixed.size());
    for (Beat beat = 0; beat < end && !stop.stop_requested(); ++beat) {
        const auto since = static_cast<std::int64_t>(1e9 * direction::beat_s * static_cast<double>(beat));
        const freespace::Movers now = movers.baked_at(trace.frames.front().time + since);
        const freespace::Space space(freespace, &now);
        for (std::size_t i = 0; i < fixed.size(); ++i)
            if (space.mover_distance(fixed[i].position, room).value < room) near[i].push_back(beat);
    }
    return near;
}

// What a QuakeWorld server's automatic tracking thinks of an item, in kills.
double item_value(std::string_view item) {
    if (item == "quad" || item == "pent" || item == "ring") return 30.0;
    if (item == "rl" || item == "lg") return 8.0;
    return 0.0;
}

}  // namespace

Beat beat_at(const Trace& trace, std::int64_t time) {
    return direction::beat_of(seconds_from_start(trace, time));
}

Result<void> check_length(const Trace& trace) {
    const double length = seconds_from_start(trace, trace.frames.back().time);
    const auto players = static_cast<double>(trace.players.size());
    const double figures_of_a_beat =
        (players + static_cast<double>(freespace::max_fixed_shots)) * (players + figures_of_a_rush);
    const double longest = max_figures / figures_of_a_beat * direction::beat_s;
    if (length <= longest) return {};
    return fail("the match lasts " + std::to_string(std::llround(length)) + " s with " +
                std::to_string(trace.players.size()) + " players, expected at most " +
                std::to_string(std::llround(longest)) + " s with so many");
}

Result<direction::Footage> footage_of(const Trace& trace, const RecordedMovers& movers,
                                      const CameraPath& cameras, std::span<const freespace::FixedShot> fixed,
                                      double unit, const ClearLine& clear, const std::stop_token& stop) {
    assert(cameras.size() == trace.poses.size() && trace.players.size() <= direction::max_players);
    const BeatReader reader(trace, movers, cameras, fixed, unit, clear);
    return read_beats(trace, stop, [&](std::span<const TraceFrame> frames, auto& players, auto& takes) {
        reader.read(frames, players, takes);
    });
}

Result<direction::Footage> scouted_footage_of(const Trace& trace, const RecordedMovers& movers,
                                              const freespace::Freespace& freespace, std::size_t fixed_shots,
                                              double unit, const std::stop_token& stop) {
    return read_beats(trace, stop, [&](std::span<const TraceFrame> frames, auto& players, auto& takes) {
        director::Scout scout(fixed_shots);
        while (scout.players.size() < trace.players.size())
            scout.add_player();
        freespace::Movers now;
        if (!frames.empty()) {
            read_players(trace, trace.poses_of(frames.front()), scout.players);
            now = movers.baked_at(frames.front().time);
        }
        for (Index player = 0; player < scout.players.size(); ++player)
            if (scout.players[player].present) scout.present.push_back(player);
        while (!scout.finished())
            scout.look({freespace, &now}, static_cast<float>(unit));
        for (const TraceFrame& frame : frames)
            for (const TracePose& pose : trace.poses_of(frame))
                if (pose.discontinuity)
                    scout.takes[scout.fixed + index_of(trace, pose.player)].jump(&frame == &frames.front());
        players = std::move(scout.players);
        takes = std::move(scout.takes);
        std::ranges::rotate(takes, takes.begin() + static_cast<std::ptrdiff_t>(scout.fixed));
    });
}

direction::MayShow out_of_the_way(const Trace& trace, const RecordedMovers& movers,
                                  const freespace::Freespace& freespace,
                                  std::span<const freespace::FixedShot> fixed, double unit,
                                  const direction::Grammar& grammar, double delay_s,
                                  const std::stop_token& stop) {
    if (movers.rows().empty() || fixed.empty()) return {};
    const Beat known = direction::beat_of(delay_s);
    const Beat whole_shot = std::min(direction::beat_of(grammar.minimum_shot_s), known);
    const Beat until_next_cut = std::min(direction::cut_every - 1, known);
    return [whole_shot, until_next_cut, players = trace.players.size(),
            near = beats_with_movers_near(trace, movers, freespace, fixed, unit, stop)](
               std::size_t rush, Beat now, bool on_air) {
        if (rush < players) return true;
        const std::vector<Beat>& beats = near[rush - players];
        const auto next = std::ranges::lower_bound(beats, now);
        return next == beats.end() || *next > now + (on_air ? until_next_cut : whole_shot);
    };
}

evaluation::CameraPath cameras_of_programme(const Trace& trace, const RecordedMovers& movers,
                                            const freespace::Freespace& freespace,
                                            const direction::Footage& footage,
                                            std::span<const freespace::FixedShot> fixed,
                                            std::span<const direction::Shot> shots, double look_ahead,
                                            CameraPath cameras, const std::stop_token& stop) {
    ProgrammeShooter shooter(trace, movers, freespace, footage, fixed, look_ahead, std::move(cameras));
    for (std::size_t i = 0; i < shots.size() && !stop.stop_requested(); ++i)
        shooter.shoot(shots[i], i > 0 ? &shots[i - 1] : nullptr);
    return std::move(shooter).cameras();
}

bool directs_by(std::string_view kind) {
    const auto known = director::event_kind_named(kind);
    constexpr std::string_view of_a_round = "end";
    return known && director::directed_kind(*known, of_a_round);
}

std::vector<direction::Event> events_of(const Trace& trace,
                                        const std::vector<evaluation::TraceEvent>& events) {
    std::vector<direction::Event> known;
    for (const evaluation::TraceEvent& event : events) {
        const auto named = director::event_kind_named(event.kind);
        const auto kind = named ? director::directed_kind(*named, event.detail) : std::nullopt;
        if (!kind || event.time < trace.frames.front().time) continue;
        const auto index = [&](const std::optional<std::uint32_t>& player) {
            return player ? index_of(trace, *player) : direction::nobody;
        };
        const double value = *kind == EventKind::item ? item_value(event.detail) : 0.0;
        known.push_back(
            {seconds_from_start(trace, event.time), *kind, index(event.actor), index(event.subject), value});
    }
    return known;
}

}  // namespace camdir::app
