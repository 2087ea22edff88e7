#include "walker.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace camdir::soak {
namespace {

constexpr float largest_turn = 2.0F * std::numbers::pi_v<float>;  // radians per second

void add_edge(std::vector<std::vector<std::uint32_t>>& neighbours, std::uint32_t a, std::uint32_t b) {
    const auto add = [&](std::uint32_t from, std::uint32_t to) {
        auto& list = neighbours[from];
        if (std::find(list.begin(), list.end(), to) == list.end()) list.push_back(to);
    };
    add(a, b);
    add(b, a);
}

std::vector<std::uint32_t> largest_component(const std::vector<std::vector<std::uint32_t>>& neighbours) {
    std::vector<std::uint32_t> largest;
    std::vector<bool> seen(neighbours.size(), false);
    for (std::uint32_t start = 0; start < neighbours.size(); ++start) {
        if (seen[start] || neighbours[start].empty()) continue;
        std::vector<std::uint32_t> part = {start};
        seen[start] = true;
        for (std::size_t i = 0; i < part.size(); ++i) {
            for (const std::uint32_t next : neighbours[part[i]]) {
                if (!seen[next]) part.push_back(next);
                seen[next] = true;
            }
        }
        if (part.size() > largest.size()) largest = std::move(part);
    }
    std::sort(largest.begin(), largest.end());
    return largest;
}

float wrapped(float angle) {
    return std::remainder(angle, 2.0F * std::numbers::pi_v<float>);
}

}  // namespace

Roads::Roads(const freespace::Freespace& freespace, float clearance)
    : neighbours_(freespace.vertices().size()) {
    for (const freespace::Vertex& vertex : freespace.vertices())
        positions_.push_back(vertex.position());
    const auto wide = [&](std::uint32_t v) { return freespace.vertices()[v].free_distance >= clearance; };
    for (const freespace::Triangle& triangle : freespace.triangles()) {
        for (const auto& [a, b] : {std::pair{triangle.a, triangle.b}, std::pair{triangle.b, triangle.c},
                                   std::pair{triangle.c, triangle.a}}) {
            if (a != b && wide(a) && wide(b)) add_edge(neighbours_, a, b);
        }
    }
    crossings_ = largest_component(neighbours_);
}

Walker::Walker(const Roads& roads, const WalkStyle& style, std::uint32_t seed)
    : roads_(roads), style_(style), random_(seed) {
    appear();
}

void Walker::step(std::uint32_t player_id, double dt, PoseArrays& poses) {
    bool jumped = std::exchange(appeared_, false);
    if (!jumped && happens(style_.teleports_per_s * dt)) {
        appear();
        jumped = true;
    }
    const Vec3f before = position();
    if (!jumped) move(dt);
    const Vec3f velocity = (position() - before) / static_cast<float>(dt);
    const Quatf view(Eigen::AngleAxisf(yaw_, Vec3f::UnitZ()) * Eigen::AngleAxisf(pitch_, Vec3f::UnitY()));
    poses.add(player_id, position(), view, velocity, jumped ? 1U | 2U : 1U);
}

bool Walker::happens(double probability) {
    return std::uniform_real_distribution()(random_) < probability;
}

void Walker::appear() {
    const auto& crossings = roads_.crossings();
    from_ = crossings[std::uniform_int_distribution<std::size_t>(0, crossings.size() - 1)(random_)];
    to_ = from_;
    choose_next();
    yaw_ = heading();
    pitch_ = 0.0F;
    standing_s_ = 0.0;
}

// Prefers the neighbour ahead: roads form a dense mesh, where purely random turns would stay in one place.
void Walker::choose_next() {
    const Vec3f here = roads_.position(to_);
    const Vec3f came = (here - roads_.position(from_)).normalized();
    std::uint32_t best = from_;
    float best_score = -std::numeric_limits<float>::infinity();
    for (const std::uint32_t next : roads_.neighbours(to_)) {
        const Vec3f way = roads_.position(next) - here;
        if (way.squaredNorm() == 0.0F) continue;
        const float jitter = std::uniform_real_distribution(-0.3F, 0.3F)(random_);
        const float score = way.normalized().dot(came) - std::abs(way.normalized().z()) + jitter;
        if (score > best_score) {
            best_score = score;
            best = next;
        }
    }
    from_ = std::exchange(to_, best);
    along_ = 0.0F;
}

void Walker::move(double dt) {
    if (standing_s_ > 0.0) {
        standing_s_ -= dt;
    } else if (happens(style_.stops_per_s * dt)) {
        standing_s_ = std::uniform_real_distribution(1.0, 3.0)(random_);
    } else {
        // Slower while the direction of motion differs from that of the view.
        const float pace = std::max(0.2F, std::cos(wrapped(heading() - yaw_)));
        walk(style_.speed * pace * static_cast<float>(dt));
    }
    const float most = largest_turn * static_cast<float>(dt);
    yaw_ = wrapped(yaw_ + std::clamp(wrapped(heading() - yaw_), -most, most));
    pitch_ += std::clamp(slope() - pitch_, -most, most);
}

void Walker::walk(float length) {
    // Bounded, because edges may have length 0.
    for (int edges = 0; edges < 1000; ++edges) {
        const float left = edge().norm() - along_;
        if (length < left) {
            along_ += length;
            return;
        }
        length -= left;
        choose_next();
    }
}

Vec3f Walker::edge() const {
    return roads_.position(to_) - roads_.position(from_);
}

Vec3f Walker::position() const {
    const float length = edge().norm();
    return length > 0.0F ? Vec3f(roads_.position(from_) + edge() * (along_ / length))
                         : roads_.position(from_);
}

float Walker::heading() const {
    const Vec3f way = edge();
    return way.head<2>().squaredNorm() > 0.0F ? std::atan2(way.y(), way.x()) : yaw_;
}

float Walker::slope() const {
    const Vec3f way = edge();
    return std::atan2(-way.z(), way.head<2>().norm());
}

}  // namespace camdir::soak
