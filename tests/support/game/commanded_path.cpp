#include "support/game/commanded_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::test {
namespace {

enum { teleport_flag = 4 };
constexpr int snapshots_back = 8;           // as far as a client may lag
constexpr int longest_extrapolation = 500;  // ms
constexpr double unit_of_a_turn = 0.7;      // map units: how much a degree counts beside an offset
constexpr double negligible = 0.01;         // map units

// What a client decides for the view that it is sent.
bool is_interpolated(const witness_player& from, const witness_player& to) {
    return ((from.view_flags ^ to.view_flags) & teleport_flag) == 0 && from.client_num == to.client_num;
}

Vec3d vector(const float* values) {
    return Eigen::Map<const Eigen::Vector3f>(values).cast<double>();
}

GameView drawn_view(const drawn_record& picture) {
    const Eigen::Matrix4d matrix = Eigen::Map<const Eigen::Matrix4f>(picture.view).cast<double>();
    const Eigen::Matrix3d rotation = matrix.topLeftCorner<3, 3>();  // rows: right, up, back
    GameView view;
    view.position = -rotation.transpose() * matrix.topRightCorner<3, 1>();
    view.axes.col(0) = -rotation.row(2);
    view.axes.col(1) = -rotation.row(0);
    view.axes.col(2) = rotation.row(1);
    return view;
}

double turn_between(const GameView& a, const GameView& b) {
    return Eigen::AngleAxisd(Eigen::Matrix3d(a.axes.transpose() * b.axes)).angle();
}

std::vector<Vec3d> models_of(const drawn_record& picture, const GameView& view) {
    Eigen::Matrix3d from_eye;
    from_eye << -view.axes.col(1), view.axes.col(2), -view.axes.col(0);
    std::vector<Vec3d> models;
    for (int i = 0; i < picture.entity_count; ++i)
        models.push_back(view.position + from_eye * vector(picture.entities[i]));
    return models;
}

// By how much the nearest model misses a place, squared; farther ones than the limit are something else.
double misfit_of(const Vec3d& place, const std::vector<Vec3d>& models) {
    constexpr double limit = 2.0;
    double nearest = limit * limit;
    for (const Vec3d& model : models)
        nearest = std::min(nearest, (model - place).squaredNorm());
    return nearest;
}

// The motion of a player that explains the models drawn best, and how badly it does.
struct Fit {
    Motion motion;
    double misfit;
};
Fit fit_of_player(const CommandedPath& path, int slot, int time, std::size_t newest,
                  const std::vector<Vec3d>& models) {
    Fit best{Motion::interpolated, std::numeric_limits<double>::infinity()};
    for (const Motion motion : {Motion::interpolated, Motion::extrapolated}) {
        const double misfit = misfit_of(path.player(slot, time, newest, motion), models);
        if (misfit < best.misfit) best = {motion, misfit};
    }
    return best;
}

// How badly the players' places at a time explain the models drawn.
double misfit_of_players(const CommandedPath& path, int time, std::size_t newest,
                         const std::vector<Vec3d>& models) {
    double sum = 0.0;
    const auto& players = path.snapshots()[path.snapshot_at(time, newest)].frame.players;
    for (int slot = 0; slot < witness_slots; ++slot)
        if (players[slot].bot && players[slot].in_game)
            sum += fit_of_player(path, slot, time, newest, models).misfit;
    return sum;
}

}  // namespace

Vec3d eye_of(const witness_player& player) {
    return vector(player.origin) + player.view_height * Vec3d::UnitZ();
}

Deviation deviation(const drawn_record& picture, const GameView& commanded) {
    const GameView drawn = drawn_view(picture);
    return {(drawn.position - commanded.position).norm(),
            turn_between(drawn, commanded) / radians_of_a_degree<double>};
}

Eigen::Matrix3d axes_of(const float angles[3]) {
    const Vec3d radians = vector(angles) * radians_of_a_degree<double>;
    return (Eigen::AngleAxisd(radians.y(), Vec3d::UnitZ()) * Eigen::AngleAxisd(radians.x(), Vec3d::UnitY()) *
            Eigen::AngleAxisd(radians.z(), Vec3d::UnitX()))
        .toRotationMatrix();
}

std::optional<PixelBox> picture_of_ball(const GameView& camera, const Vec3d& centre, double radius, int width,
                                        int height) {
    const Vec3d seen = camera.axes.transpose() * (centre - camera.position);  // forward, left, up
    const double focal_length = width / 2.0;
    // Tangents of the directions that touch the ball in one plane through the forward axis.
    const auto bounds = [&](double across) -> std::optional<std::pair<double, double>> {
        const double distance = std::hypot(seen.x(), across);
        if (distance <= radius) return std::nullopt;
        const double direction = std::atan2(across, seen.x()), half_angle = std::asin(radius / distance);
        constexpr double quarter_turn = std::numbers::pi / 2;
        if (std::abs(direction) + half_angle >= quarter_turn) return std::nullopt;
        return std::pair{focal_length * std::tan(direction - half_angle),
                         focal_length * std::tan(direction + half_angle)};
    };
    const auto horizontal = bounds(-seen.y()), vertical = bounds(-seen.z());
    if (!horizontal || !vertical) return std::nullopt;
    return PixelBox{width / 2.0 + horizontal->first, height / 2.0 + vertical->first,
                    width / 2.0 + horizontal->second, height / 2.0 + vertical->second};
}

CommandedPath::CommandedPath(const std::vector<witness_record>& records, int spectator_slot)
    : spectator_(spectator_slot) {
    for (const witness_record& record : records) {
        if (record.kind == witness_starts) snapshots_.clear();
        if (record.kind != witness_ran_frame || !record.sent) continue;
        const witness_player& player = record.players[spectator_];
        const bool cut =
            snapshots_.empty() || !is_interpolated(snapshots_.back().frame.players[spectator_], player);
        snapshots_.push_back({record, cut});
    }
}

std::size_t CommandedPath::snapshot_at(int time, std::size_t newest) const {
    const auto end = snapshots_.begin() + static_cast<std::ptrdiff_t>(newest) + 1;
    const auto after = std::upper_bound(snapshots_.begin(), end, time,
                                        [](int t, const Snapshot& s) { return t < s.frame.level_time; });
    return after == snapshots_.begin() ? 0 : static_cast<std::size_t>(after - snapshots_.begin()) - 1;
}

double CommandedPath::fraction(std::size_t from, int time) const {
    const int begin = snapshots_[from].frame.level_time;
    const int end = snapshots_[from + 1].frame.level_time;
    return std::clamp(static_cast<double>(time - begin) / (end - begin), 0.0, 1.0);
}

GameView CommandedPath::view(int time, std::size_t newest) const {
    const std::size_t index = snapshot_at(time, newest);
    const witness_player& from = snapshots_[index].frame.players[spectator_];
    if (index == newest || snapshots_[index + 1].cut) return {eye_of(from), axes_of(from.angles)};
    const witness_player& to = snapshots_[index + 1].frame.players[spectator_];
    const auto s = static_cast<float>(fraction(index, time));
    float angles[3];
    for (int i = 0; i < 3; ++i)
        angles[i] = from.angles[i] + s * std::remainder(to.angles[i] - from.angles[i], 360.0F);
    const Vec3d step = vector(to.origin) - vector(from.origin);
    return {eye_of(from) + s * step, axes_of(angles)};
}

Vec3d CommandedPath::player(int slot, int time, std::size_t newest, Motion motion) const {
    const std::size_t index = snapshot_at(time, newest);
    const witness_record& frame = snapshots_[index].frame;
    const witness_player& from = frame.players[slot];
    const bool goes_on = motion == Motion::extrapolated || index == newest;
    const witness_player* to = goes_on ? nullptr : &snapshots_[index + 1].frame.players[slot];
    const bool teleports = to && (from.entity_flags & teleport_flag) != (to->entity_flags & teleport_flag);
    if (!to || teleports)
        return vector(from.base) + (time - frame.level_time) / 1000.0 * vector(from.velocity);
    return vector(from.base) + fraction(index, time) * (vector(to->base) - vector(from.base));
}

std::optional<std::size_t> CommandedPath::newest_at(std::int64_t clock) const {
    const auto after = std::upper_bound(snapshots_.begin(), snapshots_.end(), clock,
                                        [](std::int64_t t, const Snapshot& s) { return t < s.frame.time; });
    if (after == snapshots_.begin()) return std::nullopt;
    return static_cast<std::size_t>(after - snapshots_.begin()) - 1;
}

namespace {

struct Located {
    DrawnView drawn;
    double misfit;  // of camera and players
};

// For a client whose newest snapshot has the index `newest`.
Located locate_with(const CommandedPath& path, const drawn_record& picture, std::size_t newest) {
    const auto& snapshots = path.snapshots();
    const int last = snapshots[newest].frame.level_time;
    const int first = snapshots[newest < snapshots_back ? 0 : newest - snapshots_back].frame.level_time;
    const GameView drawn = drawn_view(picture);

    struct Candidate {
        int time;
        double offset, turn, misfit;
    };
    std::vector<Candidate> candidates;
    double least = std::numeric_limits<double>::infinity();
    for (int time = first; time <= last + longest_extrapolation; ++time) {
        const GameView commanded = path.view(time, newest);
        const auto [offset, turn] = deviation(picture, commanded);
        candidates.push_back({time, offset, turn, offset + unit_of_a_turn * turn});
        least = std::min(least, candidates.back().misfit);
    }
    // The players tell the time while the camera stands still.
    std::erase_if(candidates, [&](const Candidate& c) { return c.misfit > least + negligible; });
    const auto models = models_of(picture, drawn);
    for (Candidate& candidate : candidates)
        candidate.misfit = misfit_of_players(path, candidate.time, newest, models);
    const auto best = std::min_element(candidates.begin(), candidates.end(),
                                       [](const auto& a, const auto& b) { return a.misfit < b.misfit; });
    const auto latest = std::find_if(candidates.rbegin(), candidates.rend(), [&](const Candidate& c) {
        return c.misfit <= best->misfit + negligible;
    });

    const std::size_t shown = path.snapshot_at(latest->time, newest);
    const int since = latest->time - snapshots[shown].frame.level_time;
    const int step =
        shown < newest ? snapshots[shown + 1].frame.level_time - snapshots[shown].frame.level_time : 1;
    const double age =
        shown < newest ? static_cast<double>(newest - shown) - static_cast<double>(since) / step : 0.0;
    DrawnView result{drawn,        best->time, latest->time, best->time, best->time,
                     best->offset, best->turn, age,          newest,     {}};
    for (int slot = 0; slot < witness_slots; ++slot)
        result.motions[static_cast<std::size_t>(slot)] =
            fit_of_player(path, slot, best->time, newest, models).motion;
    constexpr double a_unit = 1.0;
    for (const Candidate& candidate : candidates) {
        if (candidate.misfit > best->misfit + a_unit) continue;
        result.earliest_guess = std::min(result.earliest_guess, candidate.time);
        result.latest_guess = std::max(result.latest_guess, candidate.time);
    }
    return {result, least + best->misfit};
}

}  // namespace

std::optional<DrawnView> locate(const CommandedPath& path, const drawn_record& picture) {
    const auto newest = path.newest_at(picture.packet_time);
    if (!newest) return std::nullopt;
    const Located located = locate_with(path, picture, *newest);
    if (*newest == 0) return located.drawn;
    // The client may have read the packet before after that frame's end: it is sent a little later.
    const Located earlier = locate_with(path, picture, *newest - 1);
    return earlier.misfit + negligible < located.misfit ? earlier.drawn : located.drawn;
}

}  // namespace camdir::test
