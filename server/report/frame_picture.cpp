#include "report/frame_picture.hpp"

#include <algorithm>

#include "evaluation/judgement.hpp"
#include "evaluation/picture.hpp"
#include "render/png.hpp"
#include "report/markup.hpp"

namespace camdir::report {
namespace {

constexpr float figure_radius = 11.0F, head_radius = 7.0F, nose_radius = 3.0F;  // units of 0.0254 m

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

render::Layers layers_of(const Stage& stage, std::size_t frame) {
    const double unit = evaluation::Thresholds(stage.scene.metres_per_unit).unit;
    render::Layers layers;
    layers.map = &stage.scene;
    layers.map_point_radius = static_cast<float>(stage.point_radius * 0.5);
    for (const auto& pose : stage.trace.poses_of(stage.trace.frames[frame])) {
        const auto& players = stage.trace.players;
        const auto player = std::ranges::lower_bound(players, pose.player) - players.begin();
        if (pose.alive) add_figure(pose, static_cast<std::size_t>(player), unit, layers);
    }
    return layers;
}

}  // namespace

render::View view_of(const evaluation::CameraSample& camera) {
    render::View view;
    view.position = camera.position;
    view.forward = camera.orientation * Vec3d::UnitX();
    view.up = camera.orientation * Vec3d::UnitZ();
    view.half_height = 9.0 / 16.0;  // 90 degrees across
    return view;
}

Result<std::string> frame_picture(const Stage& stage, std::size_t frame,
                                  const evaluation::CameraSample& camera, const std::stop_token& stop) {
    const auto picture =
        render::draw(layers_of(stage, frame), view_of(camera), picture_width, picture_height, {}, stop);
    if (!picture) return tl::unexpected(picture.error());
    const auto png = render::to_png(*picture);
    if (!png) return tl::unexpected(png.error());
    return "<image width=\"320\" height=\"180\" href=\"" + png_uri(*png) + "\"/>";
}

}  // namespace camdir::report
