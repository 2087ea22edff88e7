#include "freespace/lookouts.hpp"

#include <algorithm>
#include <functional>

#include "base/point_grid.hpp"
#include "freespace/roadmap.hpp"
#include "freespace/visibility.hpp"

namespace camdir::freespace {
namespace {

constexpr float least_spacing = 40.0F;   // units of 0.0254 m
constexpr float least_clearance = 8.0F;  // likewise
constexpr float reach_in_spacings = 3.0F;
constexpr float growth = 1.15F;  // of the spacing, while there are too many

// Vertices with room, the roomiest first.
std::vector<std::uint32_t> roomy_vertices(const Freespace& freespace, float clearance) {
    const auto vertices = freespace.vertices();
    std::vector<std::uint32_t> roomy;
    for (std::uint32_t v = 0; v < vertices.size(); ++v)
        if (vertices[v].free_distance >= clearance) roomy.push_back(v);
    std::ranges::stable_sort(roomy, std::greater(),
                             [&](std::uint32_t v) { return vertices[v].free_distance; });
    return roomy;
}

// At most `limit` or, where there would be more, none.
std::vector<Vec3d> spread(const Freespace& freespace, std::span<const std::uint32_t> vertices, float spacing,
                          std::size_t limit) {
    PointGrid grid(2.0 * spacing);
    for (const std::uint32_t v : vertices) {
        const Vec3d position = freespace.vertices()[v].position().cast<double>();
        if (grid.first_within(position, spacing) != grid.points().size()) continue;
        if (grid.points().size() == limit) return {};
        grid.add(position);
    }
    return std::move(grid).take_points();
}

}  // namespace

Lookouts::Lookouts(const Freespace& freespace) {
    const float unit = static_cast<float>(metres_of_nominal_unit) / freespace.metadata().metres_per_unit;
    const auto vertices = roomy_vertices(freespace, least_clearance * unit);
    float spacing = least_spacing * unit;
    std::vector<Vec3d> places = spread(freespace, vertices, spacing, limit);
    while (places.empty() && !vertices.empty())
        places = spread(freespace, vertices, spacing *= growth, limit);
    for (const Vec3d& place : places)
        positions_.push_back(place.cast<float>());
    reach_ = reach_in_spacings * spacing;
    seen_ = std::make_unique<Lazy<Set>[]>(positions_.size());
}

Lookouts::Nearest Lookouts::nearest(const Freespace& freespace, const Vec3f& point) const {
    constexpr std::size_t looked_at = 24;
    struct Near {
        float distance2;
        std::uint32_t lookout;
    };
    std::array<Near, looked_at> near;
    std::size_t count = 0;
    for (std::uint32_t i = 0; i < positions_.size(); ++i) {
        const float distance2 = (positions_[i] - point).squaredNorm();
        if (distance2 > reach_ * reach_ || (count == looked_at && distance2 >= near[looked_at - 1].distance2))
            continue;
        std::size_t place = std::min(count, looked_at - 1);
        for (; place > 0 && near[place - 1].distance2 > distance2; --place)
            near[place] = near[place - 1];
        near[place] = {distance2, i};
        count = std::min(count + 1, looked_at);
    }
    Nearest nearest;
    const SightOrigin eye(freespace, point, 0.0F);
    for (std::size_t i = 0; i < count && nearest.count < nearest.lookouts.size(); ++i)
        if (eye.to(positions_[near[i].lookout]).clear) nearest.lookouts[nearest.count++] = near[i].lookout;
    return nearest;
}

const Lookouts::Set& Lookouts::seen_from(const Freespace& freespace, std::uint32_t lookout) const {
    return seen_[lookout].get([&] {
        Set seen;
        const SightOrigin origin(freespace, positions_[lookout], 0.0F);
        for (std::size_t i = 0; i < positions_.size(); ++i)
            if (i == lookout || origin.to(positions_[i]).clear) seen.set(i);
        return seen;
    });
}

Lookouts::Set Lookouts::around(const Freespace& freespace, const Vec3f& point, float radius) const {
    const Nearest near = nearest(freespace, point);
    if (near.count == 0) return {};
    Set around = seen_from(freespace, near.lookouts[0]);
    for (std::size_t i = 0; i < positions_.size(); ++i)
        if ((positions_[i] - point).squaredNorm() > radius * radius) around.reset(i);
    return around;
}

Lookouts::Set Lookouts::seeing(const Freespace& freespace, const Vec3f& point) const {
    Set seeing;
    const Nearest near = nearest(freespace, point);
    for (const std::uint32_t lookout : near.span())
        seeing |= seen_from(freespace, lookout);
    return seeing;
}

}  // namespace camdir::freespace
