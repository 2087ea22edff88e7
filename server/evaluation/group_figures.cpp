#include "evaluation/group_figures.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/parallel.hpp"
#include "camera/group/framing.hpp"
#include "evaluation/figures.hpp"
#include "evaluation/judgement.hpp"
#include "evaluation/picture.hpp"

namespace camdir::evaluation {
namespace {

constexpr std::int64_t group_settling = 500'000'000;  // ns after an event in which nothing is counted
constexpr double shown_share = 0.9;                   // of the picture
constexpr float picture_fov = 1.02468F;               // rad: 2 atan(9 / 16), the height of 90 degrees across

// The poses of all members in one frame; empty when the frame does not count.
using Together = std::vector<const TracePose*>;

std::vector<Together> counted_frames(const Trace& trace, std::span<const std::uint32_t> members) {
    std::vector<Together> counted(trace.frames.size());
    std::vector<std::int64_t> last_event(members.size(), trace.frames.front().time - group_settling - 1);
    for (std::size_t f = 0; f < trace.frames.size(); ++f) {
        const TraceFrame& frame = trace.frames[f];
        for (std::size_t m = 0; m < members.size(); ++m) {
            const std::uint32_t pose = pose_of(trace, frame, members[m]);
            const bool alive = pose != absent && trace.poses[pose].alive;
            if (!alive || trace.poses[pose].discontinuity) last_event[m] = frame.time;
            if (frame.time - last_event[m] > group_settling) counted[f].push_back(&trace.poses[pose]);
        }
        if (counted[f].size() != members.size()) counted[f].clear();
    }
    return counted;
}

// What the map and, in one frame, the movers let be seen.
class GroupSight {
  public:
    GroupSight(const oracle::Oracle& oracle, const MoversAt& movers, std::int64_t time)
        : oracle_(oracle), movers_(movers ? movers(time) : PlacedMovers()) {}

    [[nodiscard]] bool shows(const CameraSample& camera, const Vec3d& eye) const {
        return in_picture(camera, eye, shown_share) && oracle_.segment_clear(camera.position, eye) &&
               !movers_.hide(camera.position, eye);
    }
    [[nodiscard]] bool shows_all(const CameraSample& camera, const Together& together) const {
        return std::ranges::all_of(together, [&](const TracePose* pose) { return shows(camera, pose->eye); });
    }
    [[nodiscard]] bool shows_none(const CameraSample& camera, const Together& together) const {
        return std::ranges::none_of(together,
                                    [&](const TracePose* pose) { return shows(camera, pose->eye); });
    }

  private:
    const oracle::Oracle& oracle_;
    PlacedMovers movers_;
};

// Whether a camera at the place can show all.
bool can_show(const GroupSight& sight, const Vec3f& place, const Together& together) {
    std::vector<Vec3f> eyes;
    for (const TracePose* pose : together)
        eyes.push_back(pose->eye.cast<float>());
    const auto look = camera::look_at_all(
        place, eyes, camera::PictureShape::of(picture_fov, static_cast<float>(shown_share)));
    return look && sight.shows_all(
                       {place.cast<double>(), camera::orientation_of(*look).cast<double>(), false}, together);
}

bool proves_all(const Proves& proves, const Vec3f& place, const Together& together) {
    return std::ranges::all_of(together,
                               [&](const TracePose* pose) { return proves(place, pose->eye.cast<float>()); });
}

// Whether it holds of some place. The one of which it held last, `place`, is tried first.
template <class Holds>
bool holds_of_some(std::span<const Vec3f> places, std::size_t& place, const Holds& holds) {
    for (std::size_t i = 0; i < places.size(); ++i, place = (place + 1) % places.size())
        if (holds(places[place])) return true;
    return false;
}

// What some place would show in a frame.
struct Possible {
    bool all = false;
    bool all_proved = false;
};

// By frame.
std::vector<Possible> possible_frames(const oracle::Oracle& oracle, const Trace& trace,
                                      std::span<const Together> counted, std::span<const Vec3f> places,
                                      const Proves& proves, const MoversAt& movers,
                                      const std::stop_token& stop) {
    std::vector<Possible> possible(counted.size());
    constexpr std::size_t chunk = 64;  // frames in a row
    parallel_for(std::size_t{0}, (counted.size() + chunk - 1) / chunk, [&](std::size_t part) {
        std::size_t shows = 0;
        std::size_t proved = 0;
        const std::size_t end = std::min(counted.size(), (part + 1) * chunk);
        for (std::size_t f = part * chunk; f < end && !stop.stop_requested(); ++f) {
            if (counted[f].empty()) continue;
            const GroupSight sight(oracle, movers, trace.frames[f].time);
            const auto can = [&](const Vec3f& place) { return can_show(sight, place, counted[f]); };
            possible[f].all = holds_of_some(places, shows, can);
            possible[f].all_proved =
                possible[f].all && holds_of_some(places, proved, [&](const Vec3f& place) {
                    return can(place) && proves_all(proves, place, counted[f]);
                });
        }
    });
    return possible;
}

double percent(std::size_t part, std::size_t whole) {
    return whole == 0 ? unmeasured : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

Spread spread_of(const std::vector<double>& values) {
    return {root_mean_square(values), percentile(values, 0.95), percentile(values, 0.99)};
}

// On which side of the line from the first to the second of two the camera is, seen from above.
double side(const Together& together, const CameraSample& camera) {
    if (together.size() != 2) return 0.0;
    return (together[1]->eye - together[0]->eye).cross(camera.position - together[0]->eye).z();
}

void judge_group_motion(const Trace& trace, std::span<const Together> counted,
                        std::span<const CameraSample> cameras, GroupFigures& figures) {
    std::vector<Motion> motions;
    MotionMeter meter;
    for (std::size_t f = 0; f < counted.size(); ++f) {
        if (counted[f].empty() || cameras[f].cut) meter.end_segment();
        if (!counted[f].empty()) motions.push_back(meter.add(trace.frames[f].time, cameras[f]));
    }
    const auto turns = measured(motions, [](const Motion& motion) { return motion.angular_speed; });
    figures.acc = spread_of(measured(motions, [](const Motion& motion) { return motion.acceleration; }));
    figures.ang_speed = spread_of(turns);
    const auto comfortable = std::ranges::count_if(motions, &Motion::comfortable);
    figures.comfort = percent(static_cast<std::size_t>(comfortable), turns.size());
}

void judge_group_steps(const oracle::Oracle& oracle, const Thresholds& limits, const Trace& trace,
                       std::span<const Together> counted, std::span<const CameraSample> cameras,
                       GroupFigures& figures) {
    std::size_t cuts = 0;
    std::size_t crossings = 0;
    std::size_t near = 0;
    std::size_t steps = 0;
    std::size_t through = 0;
    std::size_t pops = 0;
    for (std::size_t f = 0; f < cameras.size(); ++f) {
        near += oracle.clearance(cameras[f].position, limits.largest_clearance) < limits.clearance;
        if (f == 0) continue;
        const CameraSample& before = cameras[f - 1];
        if (cameras[f].cut) {
            ++cuts;
            crossings += side(counted[f], before) * side(counted[f], cameras[f]) < 0.0;
            continue;
        }
        ++steps;
        through += !oracle.segment_clear(before.position, cameras[f].position);
        pops += (cameras[f].position - before.position).norm() > limits.pop;
    }
    const double minutes =
        static_cast<double>(trace.frames.back().time - trace.frames.front().time) * 1e-9 / 60.0;
    const auto a_minute = [&](std::size_t count) {
        return minutes > 0.0 ? static_cast<double>(count) / minutes : unmeasured;
    };
    figures.cuts = a_minute(cuts);
    figures.crossings = a_minute(crossings);
    figures.pops = a_minute(pops);
    figures.clearance_lt4 = percent(near, cameras.size());
    figures.fly_through = percent(through, steps);
}

MoverFigures judge_group_movers(const oracle::Oracle& oracle, const Trace& trace,
                                std::span<const Together> counted, std::span<const CameraSample> cameras,
                                const MoversAt& movers, const std::stop_token& stop) {
    MoverFigures figures;
    PlacedMovers before;
    for (std::size_t f = 0; f < cameras.size() && !stop.stop_requested(); ++f) {
        const Vec3d& position = cameras[f].position;
        PlacedMovers now = movers(trace.frames[f].time);
        figures.frames_inside += now.hold(position);
        if (f > 0 && !cameras[f].cut)
            figures.passages += PlacedMovers::meet(before, cameras[f - 1].position, now, position);
        figures.seen_through +=
            cameras[f].claims_sight && std::ranges::any_of(counted[f], [&](const TracePose* pose) {
                return oracle.segment_clear(position, pose->eye) && now.touch(position, pose->eye);
            });
        before = std::move(now);
    }
    return figures;
}

struct GroupFigure {
    const char* name;
    const char* unit;
    double GroupFigures::*value;
};

constexpr GroupFigure group_figures[] = {
    {"together", "%", &GroupFigures::together},
    {"first", "%", &GroupFigures::first},
    {"empty", "%", &GroupFigures::empty},
    {"possible", "%", &GroupFigures::possible},
    {"together_of_possible", "%", &GroupFigures::together_of_possible},
    {"provable", "%", &GroupFigures::provable},
    {"together_of_provable", "%", &GroupFigures::together_of_provable},
    {"comfort", "%", &GroupFigures::comfort},
    {"cuts", "/min", &GroupFigures::cuts},
    {"crossings", "/min", &GroupFigures::crossings},
    {"clearance_lt4", "%", &GroupFigures::clearance_lt4},
    {"fly_through", "%", &GroupFigures::fly_through},
    {"pops", "/min", &GroupFigures::pops},
};

struct GroupSpread {
    const char* name;
    const char* unit;
    Spread GroupFigures::*value;
};

constexpr GroupSpread group_spreads[] = {{"acc", "units/s^2", &GroupFigures::acc},
                                         {"ang_speed", "deg/s", &GroupFigures::ang_speed}};

std::string group_line(const char* name, const std::string& value, const char* unit) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%-20s %s %s\n", name, value.c_str(), unit);
    return text.data();
}

}  // namespace

Result<GroupFigures> judge_group(const oracle::Oracle& oracle, double metres_per_unit, const Trace& trace,
                                 std::span<const std::uint32_t> members,
                                 std::span<const CameraSample> cameras, std::span<const Vec3f> places,
                                 const Proves& proves, const MoversAt& movers, const std::stop_token& stop) {
    assert(cameras.size() == trace.frames.size());
    const auto counted = counted_frames(trace, members);
    const auto possible = possible_frames(oracle, trace, counted, places, proves, movers, stop);
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    GroupFigures figures;
    std::size_t together = 0;
    std::size_t first = 0;
    std::size_t empty = 0;
    std::size_t possible_count = 0;
    std::size_t possible_together = 0;
    std::size_t provable_count = 0;
    std::size_t provable_together = 0;
    for (std::size_t f = 0; f < counted.size(); ++f) {
        if (counted[f].empty()) continue;
        const GroupSight sight(oracle, movers, trace.frames[f].time);
        const bool all = sight.shows_all(cameras[f], counted[f]);
        ++figures.frames;
        together += all;
        first += sight.shows(cameras[f], counted[f].front()->eye);
        empty += sight.shows_none(cameras[f], counted[f]);
        possible_count += possible[f].all;
        possible_together += all && possible[f].all;
        provable_count += possible[f].all_proved;
        provable_together += all && possible[f].all_proved;
    }
    figures.together = percent(together, figures.frames);
    figures.first = percent(first, figures.frames);
    figures.empty = percent(empty, figures.frames);
    figures.possible = percent(possible_count, figures.frames);
    figures.together_of_possible = percent(possible_together, possible_count);
    figures.provable = percent(provable_count, figures.frames);
    figures.together_of_provable = percent(provable_together, provable_count);
    judge_group_motion(trace, counted, cameras, figures);
    if (movers) figures.movers = judge_group_movers(oracle, trace, counted, cameras, movers, stop);
    judge_group_steps(oracle, Thresholds(metres_per_unit), trace, counted, cameras, figures);
    if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
    return figures;
}

std::string to_json(const GroupFigures& figures) {
    nlohmann::ordered_json json;
    json["frames"] = figures.frames;
    for (const GroupFigure& figure : group_figures)
        json[figure.name] = figures.*figure.value;
    for (const GroupSpread& figure : group_spreads) {
        const Spread& value = figures.*figure.value;
        json[figure.name] = {{"rms", value.rms}, {"p95", value.p95}, {"p99", value.p99}};
    }
    if (figures.movers)
        for (const MoverFigureName& figure : mover_figure_names())
            json[figure.name] = (*figures.movers).*figure.member;
    return json.dump(2) + "\n";
}

std::string to_table(const GroupFigures& figures) {
    std::string table = group_line("frames", std::to_string(figures.frames), "counted");
    for (const GroupFigure& figure : group_figures)
        table += group_line(figure.name, format_value(figures.*figure.value, 2), figure.unit);
    for (const GroupSpread& figure : group_spreads) {
        const Spread& value = figures.*figure.value;
        table += group_line(figure.name,
                            "rms " + format_value(value.rms, 0) + "  p95 " + format_value(value.p95, 0) +
                                "  p99 " + format_value(value.p99, 0),
                            figure.unit);
    }
    if (figures.movers)
        for (const MoverFigureName& figure : mover_figure_names())
            table += group_line(figure.name, std::to_string((*figures.movers).*figure.member), figure.unit);
    return table;
}

}  // namespace camdir::evaluation
