#include "camera/group/glide.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::camera {
namespace {

constexpr float glide_rate = 3.0F;       // 1/s
constexpr float fastest_glide = 350.0F;  // units/s
constexpr float longest_step = 1.0F / 30.0F;

}  // namespace

bool Glide::rests(float unit) const {
    return (goal - position).norm() < 0.01F * unit && velocity.norm() < unit;
}

Vec3f Glide::velocity_after(float dt, float unit) const {
    const Vec3f way = goal - position;
    const float pull = 2.0F * fastest_glide * unit / glide_rate;
    const Vec3f pulled = way.norm() > pull ? Vec3f(way * (pull / way.norm())) : way;
    return velocity + (glide_rate * glide_rate * pulled - 2.0F * glide_rate * velocity) * dt;
}

Glide after(Glide glide, float seconds, float unit) {
    const float steps = std::ceil(seconds / longest_step);
    for (float step = 0.0F; step < steps && !glide.rests(unit); ++step) {
        glide.velocity = glide.velocity_after(seconds / steps, unit);
        glide.position += glide.velocity * (seconds / steps);
    }
    return glide;
}

}  // namespace camdir::camera
