#include "camera/moves.hpp"

#include <cmath>
#include <initializer_list>
#include <limits>

#include "freespace/roadmap.hpp"

namespace camdir::camera {
namespace {

struct WeightedMove {
    float weight;
    Vec3f move;
};

Vec3f weighted_average(std::initializer_list<WeightedMove> moves) {
    Vec3f sum = Vec3f::Zero();
    float weight = 0.0F;
    for (const WeightedMove& each : moves) {
        sum += each.weight * each.move;
        weight += each.weight;
    }
    return weight > 0.0F ? Vec3f(sum / weight) : Vec3f::Zero();
}

// The shares of a critically damped spring's step over dt.
struct Spring {
    float pull;     // of the way to the goal
    float inertia;  // of the move before
    float carry;    // of the goal's own move
};

Spring spring(float time_constant, float dt) {
    const float rest = std::exp(-dt / time_constant);
    return {(1.0F - rest) * (1.0F - rest), rest * rest, 2.0F * rest * (1.0F - rest)};
}

float spot_weight(const MapProfile& profile) {
    return 0.5F * (profile.weight_distance + profile.weight_angle);
}

float inertia_weight(const MapProfile& profile) {
    return 0.5F * (profile.weight_inertia_distance + profile.weight_inertia_angle);
}

}  // namespace

Vec3f move_to_safety(const freespace::Space& space, const Vec3f& position, std::uint32_t slab) {
    if (slab == freespace::none) return Vec3f::Zero();
    const freespace::Triangle& triangle = space.map().triangles()[slab];
    Vec3f safest = Vec3f::Zero();
    float least = std::numeric_limits<float>::infinity();
    for (const std::uint32_t corner : {triangle.a, triangle.b, triangle.c}) {
        const freespace::Vertex& vertex = space.map().vertices()[corner];
        if (!freespace::on_roadmap(vertex)) continue;
        const Vec3f move = vertex.position() - position;
        const float danger = move.norm() / vertex.free_distance;
        if (danger >= least) continue;
        least = danger;
        safest = move;
    }
    return safest;
}

Vec3f average_when_seen(const MapProfile& profile, const Moves& moves, float speed, float dt) {
    const Spring share = spring(profile.motion_smoothing, dt);
    return weighted_average({
        {share.pull * spot_weight(profile), moves.spot},
        {share.inertia * inertia_weight(profile), moves.inertia},
        {share.carry * profile.weight_visibility, moves.visibility},
        {share.pull * profile.weight_safety * speed / profile.safe_speed, moves.safety},
    });
}

Vec3f average_when_lost(const MapProfile& profile, const Moves& moves, float urgency, float dt) {
    const Spring share = spring(profile.motion_smoothing, dt);
    const float roadmap = profile.weight_visibility * urgency;
    const float leading = spot_weight(profile) + roadmap;
    if (leading <= 0.0F) return Vec3f::Zero();
    return weighted_average({
        {share.pull * spot_weight(profile) / leading, moves.spot},
        {share.pull * roadmap / leading, moves.visibility},
        {share.inertia * inertia_weight(profile), moves.inertia},
        {share.carry, Vec3f::Zero()},
    });
}

}  // namespace camdir::camera
