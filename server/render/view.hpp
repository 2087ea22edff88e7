// The viewpoint of a picture: a camera at `position` that looks along `forward`.
#pragma once

#include <limits>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "base/geometry.hpp"

namespace camdir::render {

struct View {
    Vec3d position = Vec3d::Zero();
    Vec3d forward = Vec3d::UnitX();  // length 1
    Vec3d up = Vec3d::UnitZ();       // length 1, orthogonal to forward
    // Half the picture's height: as a tangent for a perspective view, in map units for a parallel one.
    double half_height = 0.5;
    bool parallel = false;
    // Hide the back faces of obstacles, so that rooms are visible from outside.
    bool cut_away = false;
    // Everything above this height is hidden, map units.
    double top = std::numeric_limits<double>::infinity();
};

struct Ray {
    Vec3d origin;
    Vec3d direction;  // length 1
};

// The ray through the picture's point (x, y): -1 .. 1 from left to right times `aspect` (width / height),
// -1 .. 1 from bottom to top.
[[nodiscard]] Ray ray_through(const View& view, double x, double y, double aspect);

// The position of a point in the picture, in ray_through's x and y; nothing when it is behind the camera.
[[nodiscard]] std::optional<Eigen::Vector2d> project(const View& view, const Vec3d& point, double aspect);

// Width of a pixel at the point in map units; the picture has `height` rows.
[[nodiscard]] double units_per_pixel(const View& view, const Vec3d& point, int height);

// From straight above, north (y) up, with the whole box in the picture.
[[nodiscard]] View plan_view(const Box3d& box, double aspect);

// From above at an angle, with the whole box in the picture.
[[nodiscard]] View overview(const Box3d& box, double aspect);

// `text` is plan, auto, or x,y,z,yaw,pitch: a viewpoint in map units, yaw counter-clockwise from x and
// pitch upwards in degrees, seen with a vertical angle of 75 degrees. `box` is not empty.
[[nodiscard]] Result<View> parse_view(const std::string& text, const Box3d& box, double aspect);

}  // namespace camdir::render
