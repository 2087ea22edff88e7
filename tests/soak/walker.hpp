// A synthetic player that walks along a map's roadmap.
#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "freespace/freespace.hpp"
#include "load.hpp"

namespace camdir::soak {

// Where players can walk: the edges of the medial mesh V(S) whose vertices have a free distance of at least
// `clearance`, in the largest connected component. Immutable.
class Roads {
  public:
    Roads(const freespace::Freespace& freespace, float clearance);

    [[nodiscard]] bool empty() const { return crossings_.empty(); }
    // The vertices on roads.
    [[nodiscard]] const std::vector<std::uint32_t>& crossings() const { return crossings_; }
    [[nodiscard]] const std::vector<std::uint32_t>& neighbours(std::uint32_t vertex) const {
        return neighbours_[vertex];
    }
    [[nodiscard]] Vec3f position(std::uint32_t vertex) const { return positions_[vertex]; }

  private:
    std::vector<Vec3f> positions_;
    std::vector<std::vector<std::uint32_t>> neighbours_;
    std::vector<std::uint32_t> crossings_;
};

struct WalkStyle {
    float speed = 320.0F;           // map units per second when moving straight
    double stops_per_s = 0.05;      // each for one to three seconds
    double teleports_per_s = 0.01;  // to any other crossing, declared as a discontinuity
};

// The eye stays exactly on the roads; the view turns towards the direction of motion at up to 360 degrees per
// second. The same seed gives the same poses. `roads` must not be empty and must outlive the walker.
class Walker {
  public:
    Walker(const Roads& roads, const WalkStyle& style, std::uint32_t seed);

    // Advances by `dt` seconds and adds the pose at their end.
    void step(std::uint32_t player_id, double dt, PoseArrays& poses);

  private:
    [[nodiscard]] bool happens(double probability);
    void appear();
    void choose_next();
    void move(double dt);
    void walk(float length);
    [[nodiscard]] Vec3f edge() const;
    [[nodiscard]] Vec3f position() const;
    [[nodiscard]] float heading() const;  // of the edge; of the view where the edge is vertical
    [[nodiscard]] float slope() const;

    const Roads& roads_;
    WalkStyle style_;
    std::mt19937 random_;
    std::uint32_t from_ = 0, to_ = 0;  // the current edge
    float along_ = 0.0F;               // distance from its start
    double standing_s_ = 0.0;
    float yaw_ = 0.0F, pitch_ = 0.0F;  // radians, positive pitch looks down
    bool appeared_ = true;
};

}  // namespace camdir::soak
