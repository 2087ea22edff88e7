#include "render/draw.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <new>
#include <numbers>

#include "base/parallel.hpp"
#include "render/ray_scene.hpp"

namespace camdir::render {
namespace {

constexpr int samples_per_side = 2;  // per side of a pixel
constexpr int shade_rays = 4;        // per sample; each sample of a pixel has its own directions
constexpr int directions = samples_per_side * samples_per_side * shade_rays;
constexpr int max_layers = 64;              // transparent surfaces along a ray
constexpr float invisible = 0.02F;          // remaining share of light below which a ray ends
constexpr float shade_reach_share = 0.04F;  // of the map's diagonal
constexpr Colour background{1.0F, 1.0F, 1.0F};
constexpr Colour stone{0.88F, 0.87F, 0.85F};

// Cosine-weighted about z: a spiral, so that every number of directions covers the half sphere evenly.
std::array<Vec3f, directions> shade_directions() {
    std::array<Vec3f, directions> result;
    const double golden = std::numbers::pi * (3.0 - std::sqrt(5.0));
    for (std::size_t i = 0; i < result.size(); ++i) {
        const double square = (static_cast<double>(i) + 0.5) / directions;
        const double turn = golden * static_cast<double>(i);
        result[i] = Vec3d(std::sqrt(square) * std::cos(turn), std::sqrt(square) * std::sin(turn),
                          std::sqrt(1.0 - square))
                        .cast<float>();
    }
    return result;
}

class Painter {
  public:
    Painter(const Layers& layers, const View& view, int width, int height)
        : layers_(layers), view_(view), width_(width), height_(height), rays_(layers, view) {
        if (layers.map == nullptr) return;
        bottom_ = static_cast<float>(layers.map->bounds.min().z());
        rise_ = std::max(1e-6F, static_cast<float>(layers.map->bounds.sizes().z()));
        shade_reach_ = static_cast<float>(layers.map->bounds.diagonal().norm()) * shade_reach_share;
    }

    [[nodiscard]] Colour pixel(int x, int y) const {
        Colour sum;
        for (int i = 0; i < samples_per_side * samples_per_side; ++i) {
            const double px = x + (i % samples_per_side + 0.5) / samples_per_side;
            const int row = i / samples_per_side;
            const double py = y + (row + 0.5) / samples_per_side;
            const Ray ray = ray_through(view_, 2.0 * px / width_ - 1.0, 1.0 - 2.0 * py / height_,
                                        static_cast<double>(width_) / height_);
            sum = sum + blend_along(ray, i);
        }
        return sum * (1.0F / (samples_per_side * samples_per_side));
    }

  private:
    struct Surface {
        Colour colour;
        float opacity;
    };

    // Blends the surfaces along the ray front to back.
    [[nodiscard]] Colour blend_along(const Ray& ray, int sample) const {
        Colour sum;
        float left = 1.0F;
        float from = 0.0F;
        for (int layer = 0; layer < max_layers && left > invisible; ++layer) {
            const Hit hit = rays_.first_hit(ray, from);
            if (hit.kind == Hit::nothing) break;
            const auto [colour, opacity] = surface(hit, ray, sample);
            sum = sum + colour * (left * opacity);
            left *= 1.0F - opacity;
            from = hit.distance + std::max(1e-3F, hit.distance * 1e-6F);
        }
        return sum + background * left;
    }

    [[nodiscard]] Surface surface(const Hit& hit, const Ray& ray, int sample) const {
        switch (hit.kind) {
            case Hit::map:
                return {stone * shade(hit, ray, sample), 1.0F};
            case Hit::cloud:
                return {stone * (facing(hit, ray) * depth_cue(ray, hit)), 1.0F};
            case Hit::mesh:
                return mesh_surface(hit, ray);
            case Hit::roadmap:
                return {colour_scale(rays_.free_distance(hit) / layers_.free_distance_maximum) * 0.9F, 1.0F};
            default:
                return {rays_.colour(hit) * facing(hit, ray), 1.0F};
        }
    }

    // Draws edges darker where the triangles are large enough in the picture.
    [[nodiscard]] Surface mesh_surface(const Hit& hit, const Ray& ray) const {
        const Colour colour = colour_scale(rays_.free_distance(hit) / layers_.free_distance_maximum);
        const float pixel = footprint(hit);
        const auto [to_edge, inner_radius] = rays_.in_triangle(hit);
        if (to_edge < 0.6F * pixel) {
            const float clear = std::clamp((inner_radius / pixel - 1.0F) / 3.0F, 0.0F, 1.0F);
            const float opacity = layers_.mesh_opacity + (0.85F - layers_.mesh_opacity) * clear;
            return {colour * (1.0F - 0.45F * clear), std::max(layers_.mesh_opacity, opacity)};
        }
        return {colour * (0.5F + 0.5F * facing(hit, ray)), layers_.mesh_opacity};
    }

    // Width of a pixel at the hit, map units.
    [[nodiscard]] float footprint(const Hit& hit) const {
        const double height = view_.half_height * 2.0 / height_;
        return static_cast<float>(view_.parallel ? height : height * hit.distance);
    }

    [[nodiscard]] static float facing(const Hit& hit, const Ray& ray) {
        return 0.6F + 0.4F * std::abs(hit.normal.dot(ray.direction.cast<float>()));
    }

    // In a plan lower floors are darker.
    [[nodiscard]] float depth_cue(const Ray& ray, const Hit& hit) const {
        if (!view_.parallel) return 1.0F;
        const auto z = static_cast<float>(ray.origin.z() + ray.direction.z() * hit.distance);
        return 0.72F + 0.28F * std::clamp((z - bottom_) / rise_, 0.0F, 1.0F);
    }

    // Light from above and ambient occlusion: the share of short rays around the normal that hit nothing.
    [[nodiscard]] float shade(const Hit& hit, const Ray& ray, int sample) const {
        const Vec3f along = ray.direction.cast<float>();
        const Vec3f normal = hit.normal.dot(along) > 0.0F ? Vec3f(-hit.normal) : hit.normal;
        const Vec3f side = normal.unitOrthogonal();
        const Vec3f other = normal.cross(side);
        const Vec3f point =
            (ray.origin + ray.direction * hit.distance).cast<float>() + normal * 0.01F * shade_reach_;
        int open = 0;
        for (int i = 0; i < shade_rays; ++i) {
            const Vec3f& local =
                directions_[static_cast<std::size_t>(i * samples_per_side * samples_per_side + sample)];
            const Vec3f direction = side * local.x() + other * local.y() + normal * local.z();
            if (!rays_.map_blocks(point, direction, shade_reach_, along)) ++open;
        }
        const float light = 0.80F + 0.20F * normal.dot(Vec3f(0.35F, -0.45F, 0.82F));
        const float ambient = 0.5F + 0.5F * static_cast<float>(open) / shade_rays;
        return light * ambient * depth_cue(ray, hit);
    }

    const Layers& layers_;
    const View& view_;
    int width_, height_;
    RayScene rays_;
    std::array<Vec3f, directions> directions_ = shade_directions();
    float bottom_ = 0.0F, rise_ = 1.0F;
    float shade_reach_ = 0.0F;
};

Picture paint(const Painter& painter, int width, int height, const ProgressSink& progress,
              const std::stop_token& stop) {
    Picture picture{width, height, {}};
    picture.pixels.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::atomic<std::uint64_t> rows = 0;
    parallel_for(0, height, [&](int y) {
        if (stop.stop_requested()) return;
        const std::size_t row = static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
        for (int x = 0; x < width; ++x)
            picture.pixels[row + static_cast<std::size_t>(x)] = painter.pixel(x, y);
        const std::uint64_t done = ++rows;
        if (progress) progress(done, static_cast<std::uint64_t>(height));
    });
    return picture;
}

}  // namespace

Result<Picture> draw(const Layers& layers, const View& view, int width, int height,
                     const ProgressSink& progress, const std::stop_token& stop) {
    try {
        const Painter painter(layers, view, width, height);
        Picture picture = paint(painter, width, height, progress, stop);
        if (stop.stop_requested()) return fail("interrupted while drawing", ErrorCode::interrupted);
        return picture;
    } catch (const std::bad_alloc&) {
        return fail("drawing: not enough memory for " + std::to_string(width) + " x " +
                    std::to_string(height) + " pixels of this map");
    }
}

}  // namespace camdir::render
