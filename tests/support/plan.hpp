// Small worlds drawn as text: a freespace for tracking, and exact clearance and visibility.
#pragma once

#include <string>
#include <vector>

#include "base/geometry.hpp"
#include "freespace/freespace.hpp"

namespace camdir::test {

// A plan of square cells, '#' solid, everything else free, extruded from z = 0 to `height`. Row 0 is the
// first line and has the largest y. The plan's border must be solid.
class Plan {
  public:
    explicit Plan(std::vector<std::string> rows, float cell = 64.0F, float height = 128.0F);

    // A horizontal grid of medial triangles at half the height, with spawn points at the cells marked 's'. No
    // slab touches the solid.
    [[nodiscard]] freespace::Freespace freespace(float metres_per_unit = 0.0254F) const;
    [[nodiscard]] freespace::Contents contents(float metres_per_unit = 0.0254F) const;

    // The centre of a cell, at eye height.
    [[nodiscard]] Vec3f eye(std::size_t row, std::size_t column) const;
    // The centre of the first cell with this letter, at eye height.
    [[nodiscard]] Vec3f eye(char letter) const;

    // Exact distance to the solid; <= 0 inside it.
    [[nodiscard]] float clearance(const Vec3f& point) const;
    // Exact: the segment touches no solid cell, floor or ceiling.
    [[nodiscard]] bool segment_clear(const Vec3f& from, const Vec3f& to) const;

    [[nodiscard]] Eigen::AlignedBox3f bounds() const;

  private:
    [[nodiscard]] float plan_clearance(float x, float y) const;

    std::vector<std::string> rows_;
    float cell_;
    float height_;
    std::vector<Eigen::AlignedBox2f> solids_;
};

// The worlds that several tests share.
[[nodiscard]] Plan box_room();
[[nodiscard]] Plan l_corridor();
[[nodiscard]] Plan figure_eight();
// Two rooms, s and t, that are not connected.
[[nodiscard]] Plan two_rooms();

}  // namespace camdir::test
