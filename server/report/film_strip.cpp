#include "report/film_strip.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/figures.hpp"
#include "evaluation/picture.hpp"
#include "render/draw.hpp"
#include "render/png.hpp"
#include "report/faults.hpp"
#include "report/markup.hpp"

namespace camdir::report {
namespace {

constexpr int frame_width = 320, frame_height = 180;
constexpr double frame_aspect = static_cast<double>(frame_width) / frame_height;
constexpr double around_run = 0.2, around_peak = 0.25;                          // seconds before and after
constexpr float figure_radius = 11.0F, head_radius = 7.0F, nose_radius = 3.0F;  // units of 0.0254 m

render::View view_of(const evaluation::CameraSample& camera) {
    render::View view;
    view.position = camera.position;
    view.forward = camera.orientation * Vec3d::UnitX();
    view.up = camera.orientation * Vec3d::UnitZ();
    view.half_height = 9.0 / 16.0;  // 90 degrees across
    return view;
}

// A capsule in the player's box, a head at the eye, and a nose that shows where they look.
void add_figure(const evaluation::TracePose& pose, std::size_t player, double unit, render::Layers& layers) {
    const auto scale = static_cast<float>(unit);
    const Box3d box = evaluation::player_box(pose, unit);
    const Vec3d middle = box.center();
    const Vec3d rise(0.0, 0.0, static_cast<double>(figure_radius) * unit);
    const Vec3d low(middle.x(), middle.y(), box.min().z());
    const Vec3d shoulders(middle.x(), middle.y(), pose.eye.z() - 1.5 * rise.z());
    const render::Colour colour = render::player_colour(player);
    layers.paths.push_back(
        {{(low + rise).cast<float>(), shoulders.cast<float>()}, colour, 2.0F * figure_radius * scale});
    layers.balls.push_back({{pose.eye.cast<float>()}, colour, head_radius * scale});
    const Vec3d nose = pose.eye + pose.orientation * Vec3d::UnitX() * static_cast<double>(head_radius) * unit;
    layers.balls.push_back({{nose.cast<float>()}, {0.08F, 0.08F, 0.1F}, nose_radius * scale});
}

class Strip {
  public:
    Strip(const Subject& subject, const Moment& moment)
        : subject_(subject),
          moment_(moment),
          track_(evaluation::track_of(subject.trace, subject.trace.players[moment.player])) {}

    [[nodiscard]] Result<std::string> html(const std::stop_token& stop) const {
        std::string html = "<div class=\"strip\">";
        for (const std::size_t frame : frames()) {
            const auto picture = this->picture(frame, stop);
            if (!picture) return tl::unexpected(picture.error());
            html += *picture;
        }
        return html + "</div>\n";
    }

  private:
    // Evenly in the strip's time, of frames in which the player has a pose.
    [[nodiscard]] std::vector<std::size_t> frames() const {
        const auto [begin, end] = strip_interval(moment_, subject_.trace);
        std::vector<std::size_t> chosen;
        for (int i = 0; i < strip_length; ++i) {
            const double time = begin + (end - begin) * i / (strip_length - 1);
            const std::size_t frame = frame_at(time);
            const bool known = !chosen.empty() && chosen.back() == frame;
            if (!known && track_[frame] != evaluation::absent) chosen.push_back(frame);
        }
        if (moment_.frames.size() == 1 && !chosen.empty()) {
            // At the match's beginning and end it may lie between two of them.
            const auto next = std::ranges::lower_bound(chosen, moment_.frames.first);
            *(next == chosen.end() ? next - 1 : next) = moment_.frames.first;
        }
        return chosen;
    }

    // The last one up to this time.
    [[nodiscard]] std::size_t frame_at(double seconds) const {
        std::size_t below = 0, above = track_.size();
        while (above - below > 1) {
            const std::size_t middle = (below + above) / 2;
            (seconds_at(subject_.trace, middle) <= seconds + 1e-9 ? below : above) = middle;
        }
        return below;
    }

    [[nodiscard]] Result<std::string> picture(std::size_t frame, const std::stop_token& stop) const {
        const std::uint32_t pose = track_[frame];
        const render::View view = view_of(subject_.cameras.front().cameras[pose]);
        const auto picture = render::draw(layers_of(frame), view, frame_width, frame_height, {}, stop);
        if (!picture) return tl::unexpected(picture.error());
        const auto png = render::to_png(*picture);
        if (!png) return tl::unexpected(png.error());
        return "<figure><svg viewBox=\"0 0 320 180\"><image width=\"320\" height=\"180\" href=\"" +
               png_uri(*png) + "\"/><rect class=\"middle\" x=\"64\" y=\"36\" width=\"192\" height=\"108\"/>" +
               ring(view, subject_.trace.poses[pose].eye) + "</svg><figcaption>" + caption(frame) +
               "</figcaption></figure>";
    }

    [[nodiscard]] render::Layers layers_of(std::size_t frame) const {
        const double unit = evaluation::Thresholds(subject_.scene.metres_per_unit).unit;
        render::Layers layers;
        layers.map = &subject_.scene;
        layers.map_point_radius = static_cast<float>(subject_.point_radius * 0.5);
        for (const auto& pose : subject_.trace.poses_of(subject_.trace.frames[frame])) {
            const auto& players = subject_.trace.players;
            const auto player = std::ranges::lower_bound(players, pose.player) - players.begin();
            if (pose.alive) add_figure(pose, static_cast<std::size_t>(player), unit, layers);
        }
        return layers;
    }

    [[nodiscard]] static std::string ring(const render::View& view, const Vec3d& eye) {
        const auto place = render::project(view, eye, frame_aspect);
        if (!place || place->cwiseAbs().maxCoeff() > 1.0) return {};
        return "<circle class=\"ring\" cx=\"" + decimal((place->x() + 1.0) * 0.5 * frame_width, 1) +
               "\" cy=\"" + decimal((1.0 - place->y()) * 0.5 * frame_height, 1) + "\" r=\"9\"/>";
    }

    [[nodiscard]] std::string caption(std::size_t frame) const {
        const evaluation::Judgement& judgement = subject_.cameras.front().judgements[track_[frame]];
        std::string text = "<b>" + evaluation::format_value(seconds_at(subject_.trace, frame), 2) + " s</b>";
        if (!judgement.counted) return text + " not counted";
        for (const FaultName& name : fault_names)
            if ((judgement.faults & name.fault) != 0)
                text +=
                    std::string(" <i class=\"key fault-") + name.key + "\" title=\"" + name.text + "\"></i>";
        return text + (judgement.cut ? " cut" : "") + ' ' +
               decimal(judgement.distance, judgement.distance < 10.0 ? 2 : 0) + " units";
    }

    const Subject& subject_;
    const Moment& moment_;
    std::vector<std::uint32_t> track_;
};

}  // namespace

Interval strip_interval(const Moment& moment, const evaluation::Trace& trace) {
    const double around = moment.frames.size() > 1 ? around_run : around_peak;
    return {std::max(0.0, seconds_at(trace, moment.frames.first) - around),
            std::min(duration(trace), seconds_at(trace, moment.frames.last - 1) + around)};
}

Result<std::string> film_strip(const Subject& subject, const Moment& moment, const std::stop_token& stop) {
    return Strip(subject, moment).html(stop);
}

}  // namespace camdir::report
