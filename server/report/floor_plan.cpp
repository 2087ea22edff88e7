#include "report/floor_plan.hpp"

#include <algorithm>
#include <cmath>

#include "render/draw.hpp"
#include "render/png.hpp"
#include "report/faults.hpp"
#include "report/markup.hpp"
#include "report/runs.hpp"

namespace camdir::report {
namespace {

using evaluation::Judgement;
using evaluation::Trace;

constexpr int plan_width = 1200, min_height = 300, max_height = 1200;  // pixels
// Pixels between two points of a track: more in matches with more poses than those of 8 players in 3 minutes.
constexpr double least_step = 2.5;
constexpr double poses_at_least_step = 100e3;
constexpr double headroom = 16.0;  // over the highest eye or camera, units of 0.0254 m: what is above is cut
constexpr std::size_t max_marks = 1500;

Box3d box_of(const Subject& subject) {
    Box3d box;
    for (const evaluation::TracePose& pose : subject.trace.poses)
        box.extend(pose.eye);
    for (const evaluation::CameraSample& camera : subject.cameras.front().cameras)
        box.extend(camera.position);
    const double unit = evaluation::Thresholds(subject.scene.metres_per_unit).unit;
    const Vec3d margin = unit * Vec3d(64.0, 64.0, headroom);
    const Box3d all(box.min() - margin, box.max() + margin);
    const Box3d on_map = all.intersection(subject.scene.bounds);  // a camera may be lost anywhere
    return on_map.isEmpty() ? all : on_map;
}

class Plan {
  public:
    explicit Plan(const Subject& subject)
        : subject_(subject),
          box_(box_of(subject)),
          view_(render::plan_view(box_, aspect())),
          step_(least_step *
                std::max(1.0, static_cast<double>(subject.trace.poses.size()) / poses_at_least_step)) {
        view_.top = box_.max().z();
    }

    [[nodiscard]] Result<std::string> svg(const std::stop_token& stop) const {
        render::Layers layers;
        layers.map = &subject_.scene;
        layers.map_point_radius = static_cast<float>(subject_.point_radius * 0.5);
        const auto picture = render::draw(layers, view_, plan_width, height(), {}, stop);
        if (!picture) return tl::unexpected(picture.error());
        const auto png = render::to_png(*picture);
        if (!png) return tl::unexpected(png.error());
        std::string svg = "<svg class=\"plan\" viewBox=\"0 0 " + std::to_string(plan_width) + ' ' +
                          std::to_string(height()) +
                          "\" role=\"img\" aria-label=\"floor plan\"><image width=\"" +
                          std::to_string(plan_width) + "\" height=\"" + std::to_string(height()) +
                          "\" href=\"" + png_uri(*png) + "\"/>\n";
        for (std::size_t player = 0; player < subject_.trace.players.size(); ++player)
            svg += tracks_of(player);
        return svg + marks() + "</svg>\n";
    }

  private:
    [[nodiscard]] int height() const {
        const double rows = plan_width * box_.sizes().y() / std::max(box_.sizes().x(), 1e-9);
        return std::clamp(static_cast<int>(rows), min_height, max_height);
    }
    [[nodiscard]] double aspect() const { return static_cast<double>(plan_width) / height(); }

    [[nodiscard]] Eigen::Vector2d pixel(const Vec3d& point) const {
        const Eigen::Vector2d place = *render::project(view_, point, aspect());
        return {(place.x() + 1.0) * 0.5 * plan_width, (1.0 - place.y()) * 0.5 * height()};
    }

    // point_of(pose), interrupted where breaks(pose), with points that are at least step_ apart.
    template <class PointOf, class Breaks>
    [[nodiscard]] std::string path(const std::vector<std::uint32_t>& track, const PointOf& point_of,
                                   const Breaks& breaks) const {
        std::string path;
        Eigen::Vector2d last = Eigen::Vector2d::Zero();
        bool pen_down = false;
        for (const std::uint32_t pose : track) {
            if (pose == evaluation::absent || breaks(pose)) pen_down = false;
            if (pose == evaluation::absent) continue;
            const Eigen::Vector2d now = pixel(point_of(pose));
            if (!path.empty() && (now - last).norm() < step_) continue;
            path += (pen_down ? 'L' : 'M') + decimal(now.x(), 0) + ' ' + decimal(now.y(), 0);
            last = now;
            pen_down = true;
        }
        return path;
    }

    [[nodiscard]] std::string tracks_of(std::size_t player) const {
        const auto& poses = subject_.trace.poses;
        const auto& cameras = subject_.cameras.front().cameras;
        const std::uint32_t number = subject_.trace.players[player];
        const auto track = evaluation::track_of(subject_.trace, number);
        const auto eyes = path(
            track, [&](std::uint32_t pose) { return poses[pose].eye; },
            [&](std::uint32_t pose) { return poses[pose].discontinuity || !poses[pose].alive; });
        const auto views = path(
            track, [&](std::uint32_t pose) { return cameras[pose].position; },
            [&](std::uint32_t pose) { return cameras[pose].cut; });
        return "<g data-player=\"" + std::to_string(number) + "\" class=\"player-" +
               std::to_string(player % 8) + "\"><path class=\"eye\" d=\"" + eyes +
               "\"/><path class=\"view\" d=\"" + views + "\"/></g>\n";
    }

    // A disc at the camera for each run of frames that are not good, larger for longer ones.
    [[nodiscard]] std::string marks() const {
        struct Mark {
            double seconds;
            std::string svg;
        };
        std::vector<Mark> marks;
        for (const std::uint32_t player : subject_.trace.players) {
            const auto track = evaluation::track_of(subject_.trace, player);
            const auto& judgements = subject_.cameras.front().judgements;
            const auto bad = [&](std::size_t frame) {
                return track[frame] != evaluation::absent && judgements[track[frame]].faults != 0;
            };
            for (const Run& run : runs_where(track.size(), bad)) {
                FaultCounts faults{};
                for (std::size_t frame = run.first; frame < run.last; ++frame)
                    count(judgements[track[frame]].faults, faults);
                const double begin = seconds_at(subject_.trace, run.first);
                const double end = seconds_at(subject_.trace, std::min(run.last, track.size() - 1));
                const std::uint32_t middle = track[(run.first + run.last) / 2];
                marks.push_back({end - begin, mark(player, middle, begin, end, faults)});
            }
        }
        std::ranges::stable_sort(marks, std::greater<>(), &Mark::seconds);
        marks.resize(std::min(marks.size(), max_marks));
        std::string svg;
        for (const Mark& mark : marks)
            svg += mark.svg;
        return svg;
    }

    [[nodiscard]] std::string mark(std::uint32_t player, std::uint32_t pose, double begin, double end,
                                   const FaultCounts& faults) const {
        const Eigen::Vector2d place = pixel(subject_.cameras.front().cameras[pose].position);
        const double radius = std::clamp(3.0 + 5.0 * std::sqrt(end - begin), 3.0, 14.0);
        const FaultName& fault = most_frequent(faults);
        return "<circle data-player=\"" + std::to_string(player) + "\" class=\"fault-" + fault.key +
               "\" cx=\"" + decimal(place.x(), 0) + "\" cy=\"" + decimal(place.y(), 0) + "\" r=\"" +
               decimal(radius, 1) + "\"><title>player " + std::to_string(player) + ", " + decimal(begin, 2) +
               " to " + decimal(end, 2) + " s: " + fault.text + "</title></circle>\n";
    }

    const Subject& subject_;
    Box3d box_;
    render::View view_;
    double step_;
};

}  // namespace

Result<std::string> floor_plan(const Subject& subject, const std::stop_token& stop) {
    return Plan(subject).svg(stop);
}

}  // namespace camdir::report
