// Where a camera looks so that its picture holds several points.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "camera/view.hpp"

namespace camdir::camera {

// Half of a picture's width and height, or of a part in its middle, as tangents.
struct PictureShape {
    float half_width;
    float half_height;

    // Of the format 16:9; `share` of it, 0 .. 1. `vertical_fov` in radians.
    [[nodiscard]] static PictureShape of(float vertical_fov, float share);

    bool operator==(const PictureShape&) const = default;
};

// The smallest rectangle of the picture that has all points, as tangents from its middle.
struct PictureExtent {
    float left, right, bottom, top;  // left and bottom are negative left of and below the middle

    [[nodiscard]] bool within(const PictureShape& shape) const;
};

// None without points, and when one of them is not before the camera.
[[nodiscard]] std::optional<PictureExtent> extent_of(const Vec3f& position, const Look& look,
                                                     std::span<const Vec3f> points);

// The look that has the points in the middle; none when the picture cannot hold them so.
[[nodiscard]] std::optional<Look> look_at_all(const Vec3f& position, std::span<const Vec3f> points,
                                              const PictureShape& shape);

// Whether look_at_all() finds one; faster where it does not. False without points.
[[nodiscard]] bool fits_one_picture(const Vec3f& position, std::span<const Vec3f> points,
                                    const PictureShape& shape);

// The dead zone: `look` while it has the points within `shape`, else turned by as little as brings them back
// there, or to the middle when they need more room. Points behind the camera are looked for.
[[nodiscard]] Look look_within(const Vec3f& position, const Look& look, std::span<const Vec3f> points,
                               const PictureShape& shape);

}  // namespace camdir::camera
