#include "camera/group/framing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace camdir::camera {
namespace {

constexpr float format = 16.0F / 9.0F;
constexpr float least_depth = 0.05F;  // of the distance: what is farther to the side is not looked at
constexpr int centrings = 4;          // which converge quadratically

// Along the middle of the points' directions.
Look first_look(const Vec3f& position, std::span<const Vec3f> points) {
    Vec3f sum = Vec3f::Zero();
    for (const Vec3f& point : points)
        sum += (point - position).normalized();
    return look_along(sum, 0.0F);
}

Look shifted(const Look& look, float left, float upwards) {
    constexpr float steepest = 1.4F;  // rad
    const float level = std::max(std::cos(look.pitch), 0.2F);
    return {wrapped(look.yaw + left / level), std::clamp(look.pitch + upwards, -steepest, steepest)};
}

// The angle to the middle of two tangents.
float middle(float low, float high) {
    return (std::atan(low) + std::atan(high)) / 2.0F;
}

// By what angle [low, high] has to turn into [-half, half], or to its middle when it is larger; tangents.
float turn_into(float low, float high, float half) {
    if (high - low >= 2.0F * half) return middle(low, high);
    return std::max(std::atan(high) - std::atan(half), 0.0F) +
           std::min(std::atan(low) + std::atan(half), 0.0F);
}

}  // namespace

PictureShape PictureShape::of(float vertical_fov, float share) {
    const float half_height = share * std::tan(vertical_fov / 2.0F);
    return {format * half_height, half_height};
}

bool PictureExtent::within(const PictureShape& shape) const {
    return left >= -shape.half_width && right <= shape.half_width && bottom >= -shape.half_height &&
           top <= shape.half_height;
}

std::optional<PictureExtent> extent_of(const Vec3f& position, const Look& look,
                                       std::span<const Vec3f> points) {
    if (points.empty()) return std::nullopt;
    const Vec3f forward = direction_of(look);
    const Vec3f right(std::sin(look.yaw), -std::cos(look.yaw), 0.0F);
    const Vec3f up = right.cross(forward);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    PictureExtent extent{infinity, -infinity, infinity, -infinity};
    for (const Vec3f& point : points) {
        const Vec3f way = point - position;
        const float depth = way.dot(forward);
        if (!(depth > least_depth * way.norm())) return std::nullopt;
        const float x = way.dot(right) / depth;
        const float y = way.dot(up) / depth;
        extent = {std::min(extent.left, x), std::max(extent.right, x), std::min(extent.bottom, y),
                  std::max(extent.top, y)};
    }
    return extent;
}

std::optional<Look> look_at_all(const Vec3f& position, std::span<const Vec3f> points,
                                const PictureShape& shape) {
    Look look = first_look(position, points);
    for (int i = 0; i < centrings; ++i) {
        const auto extent = extent_of(position, look, points);
        if (!extent) return std::nullopt;
        look = shifted(look, -middle(extent->left, extent->right), middle(extent->bottom, extent->top));
    }
    const auto extent = extent_of(position, look, points);
    if (!extent || !extent->within(shape)) return std::nullopt;
    return look;
}

bool fits_one_picture(const Vec3f& position, std::span<const Vec3f> points, const PictureShape& shape) {
    // From corner to corner: of the angle 2 atan(d) the cosine.
    const float diagonal2 = shape.half_width * shape.half_width + shape.half_height * shape.half_height;
    const float widest_cosine = (1.0F - diagonal2) / (1.0F + diagonal2);
    for (std::size_t i = 0; i < points.size(); ++i)
        for (std::size_t j = 0; j < i; ++j) {
            const Vec3f one = points[i] - position;
            const Vec3f other = points[j] - position;
            if (one.dot(other) < widest_cosine * std::sqrt(one.squaredNorm() * other.squaredNorm()))
                return false;
        }
    return look_at_all(position, points, shape).has_value();
}

Look look_within(const Vec3f& position, const Look& look, std::span<const Vec3f> points,
                 const PictureShape& shape) {
    if (points.empty()) return look;
    Look moved = look;
    for (int i = 0; i < centrings; ++i) {
        const auto extent = extent_of(position, moved, points);
        if (!extent) {
            moved = first_look(position, points);
            continue;
        }
        if (extent->within(shape)) break;
        moved = shifted(moved, -turn_into(extent->left, extent->right, shape.half_width),
                        turn_into(extent->bottom, extent->top, shape.half_height));
    }
    return moved;
}

}  // namespace camdir::camera
