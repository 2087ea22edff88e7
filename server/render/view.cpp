#include "render/view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace camdir::render {
namespace {

constexpr double margin = 1.04;         // size of the picture relative to the box
constexpr double max_coordinate = 1e7;  // map units

Vec3d direction(double yaw, double pitch) {
    return {std::cos(yaw) * std::cos(pitch), std::sin(yaw) * std::cos(pitch), std::sin(pitch)};
}

Vec3d up_for(const Vec3d& forward, double yaw) {
    const Vec3d left(-std::sin(yaw), std::cos(yaw), 0.0);
    return forward.cross(left).normalized();
}

std::array<Vec3d, 8> corners(const Box3d& box) {
    std::array<Vec3d, 8> result;
    for (int i = 0; i < 8; ++i)
        result[static_cast<std::size_t>(i)] = box.corner(static_cast<Box3d::CornerType>(i));
    return result;
}

// The distance along the view direction from which every corner is inside the picture.
double distance_to_fit(const View& view, const Box3d& box, double aspect) {
    const Vec3d left = view.up.cross(view.forward);
    double distance = 0.0;
    for (const Vec3d& corner : corners(box)) {
        const Vec3d offset = corner - box.center();
        const double wide = std::abs(offset.dot(left)) / (view.half_height * aspect);
        const double high = std::abs(offset.dot(view.up)) / view.half_height;
        distance = std::max(distance, margin * std::max(wide, high) - offset.dot(view.forward));
    }
    return distance;
}

Result<View> viewpoint(const std::string& text) {
    std::array<double, 5> numbers{};
    std::istringstream stream(text);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
        char comma = ',';
        if (i > 0) stream >> comma;
        stream >> numbers[i];
        if (!stream || comma != ',' || !std::isfinite(numbers[i])) {
            return fail("view '" + text + "': expected plan, auto or five numbers x,y,z,yaw,pitch");
        }
    }
    const double distance = std::max({std::abs(numbers[0]), std::abs(numbers[1]), std::abs(numbers[2])});
    if (distance > max_coordinate)
        return fail("view '" + text + "': coordinates are within +-10000000 map units");
    if (std::abs(numbers[3]) > 360.0 || std::abs(numbers[4]) > 90.0)
        return fail("view '" + text + "': yaw is within +-360 degrees, pitch within +-90");
    if (!(stream >> std::ws).eof()) return fail("view '" + text + "': text after the fifth number");
    View view;
    view.position = {numbers[0], numbers[1], numbers[2]};
    const double yaw = numbers[3] * radians_of_a_degree<double>;
    view.forward = direction(yaw, numbers[4] * radians_of_a_degree<double>);
    view.up = up_for(view.forward, yaw);
    view.half_height = std::tan(37.5 * radians_of_a_degree<double>);
    return view;
}

}  // namespace

Ray ray_through(const View& view, double x, double y, double aspect) {
    const Vec3d right = view.forward.cross(view.up);
    const Vec3d offset = (x * aspect * right + y * view.up) * view.half_height;
    if (view.parallel) return {view.position + offset, view.forward};
    return {view.position, (view.forward + offset).normalized()};
}

std::optional<Eigen::Vector2d> project(const View& view, const Vec3d& point, double aspect) {
    const Vec3d offset = point - view.position;
    const double depth = offset.dot(view.forward);
    if (!view.parallel && depth <= 0.0) return std::nullopt;
    const double scale = view.half_height * (view.parallel ? 1.0 : depth);
    return Eigen::Vector2d(offset.dot(view.forward.cross(view.up)) / (scale * aspect),
                           offset.dot(view.up) / scale);
}

double units_per_pixel(const View& view, const Vec3d& point, int height) {
    const double scale = view.parallel ? 1.0 : (point - view.position).norm();
    return 2.0 * view.half_height * scale / height;
}

View plan_view(const Box3d& box, double aspect) {
    View view;
    view.parallel = true;
    view.cut_away = true;
    view.forward = -Vec3d::UnitZ();
    view.up = Vec3d::UnitY();
    view.position = box.center();
    view.position.z() = box.max().z() + 1.0;
    view.half_height = margin * 0.5 * std::max(box.sizes().y(), box.sizes().x() / aspect);
    return view;
}

View overview(const Box3d& box, double aspect) {
    View view;
    view.cut_away = true;
    const double yaw = 60.0 * radians_of_a_degree<double>;
    view.forward = direction(yaw, -50.0 * radians_of_a_degree<double>);
    view.up = up_for(view.forward, yaw);
    view.half_height = std::tan(17.5 * radians_of_a_degree<double>);
    view.position = box.center() - view.forward * distance_to_fit(view, box, aspect);
    return view;
}

Result<View> parse_view(const std::string& text, const Box3d& box, double aspect) {
    if (text == "plan") return plan_view(box, aspect);
    if (text == "auto") return overview(box, aspect);
    return viewpoint(text);
}

}  // namespace camdir::render
