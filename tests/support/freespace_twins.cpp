#include "support/freespace_twins.hpp"

#include <algorithm>
#include <limits>

namespace camdir::test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// The largest value of a concave function on [0, 1].
template <class Function>
double concave_maximum(const Function& function) {
    double low = 0.0;
    double high = 1.0;
    for (int i = 0; i < 40; ++i) {
        const double third = (high - low) / 3.0;
        if (function(low + third) < function(high - third))
            low += third;
        else
            high -= third;
    }
    return std::max({function(0.0), function(1.0), function(0.5 * (low + high))});
}

double slab_distance_at(const freespace::Freespace& freespace, std::uint32_t triangle, const Vec3d& point) {
    const auto [ia, ib, ic] = freespace.triangles()[triangle];
    const auto position = [&](std::uint32_t v) {
        return Vec3d(freespace.vertices()[v].position().cast<double>() - point);
    };
    const auto radius = [&](std::uint32_t v) {
        return static_cast<double>(freespace.vertices()[v].free_distance);
    };
    const Vec3d a = position(ia), b = position(ib), c = position(ic);
    const double radius_a = radius(ia), radius_b = radius(ib), radius_c = radius(ic);
    return concave_maximum([&](double along) {
        const Vec3d left = a + along * (b - a);
        const Vec3d right = a + along * (c - a);
        const double radius_left = radius_a + along * (radius_b - radius_a);
        const double radius_right = radius_a + along * (radius_c - radius_a);
        return concave_maximum([&](double across) {
            return radius_left + across * (radius_right - radius_left) -
                   (left + across * (right - left)).norm();
        });
    });
}

// No slab reaches further from a triangle's corner than this.
double quick_bound(const freespace::Freespace& freespace, std::uint32_t triangle, const Vec3d& point) {
    const auto [ia, ib, ic] = freespace.triangles()[triangle];
    const auto& v = freespace.vertices();
    const Vec3d a = v[ia].position().cast<double>();
    const double size =
        std::max((v[ib].position().cast<double>() - a).norm(), (v[ic].position().cast<double>() - a).norm());
    const double radius = std::max({v[ia].free_distance, v[ib].free_distance, v[ic].free_distance});
    return radius - ((point - a).norm() - size);
}

}  // namespace

double slab_distance(const freespace::Freespace& freespace, std::uint32_t triangle, const Vec3f& point) {
    return slab_distance_at(freespace, triangle, point.cast<double>());
}

double exact_distance(const freespace::Freespace& freespace, const Vec3d& point) {
    double best = -infinity;
    for (std::uint32_t t = 0; t < freespace.triangles().size(); ++t)
        if (quick_bound(freespace, t, point) > best)
            best = std::max(best, slab_distance_at(freespace, t, point));
    return best;
}

double sampled_clearance(const freespace::Freespace& freespace, const Vec3d& from, const Vec3d& to,
                         double step) {
    const int count = static_cast<int>((to - from).norm() / step) + 1;
    double smallest = infinity;
    for (int i = 0; i <= count; ++i)
        smallest = std::min(smallest, exact_distance(freespace, from + (to - from) * i / count));
    return smallest;
}

double exact_free_length(const freespace::Freespace& freespace, const Vec3d& from, const Vec3d& to,
                         double radius, double room) {
    const double length = (to - from).norm();
    for (double t = 0.0; t < length;) {
        const double spare = exact_distance(freespace, from + (to - from) * (t / length)) - radius - room;
        if (spare <= 0.0) return t;
        t += std::max(spare, 0.01 * room);
    }
    return length;
}

std::vector<double> roadmap_distances(const freespace::Freespace& freespace,
                                      const std::vector<std::uint32_t>& starts,
                                      const std::vector<double>& costs) {
    const auto& vertices = freespace.vertices();
    std::vector<double> distance(vertices.size(), infinity);
    std::vector<bool> closed(vertices.size(), false);
    for (std::size_t i = 0; i < starts.size(); ++i)
        distance[starts[i]] = std::min(distance[starts[i]], costs[i]);
    while (true) {
        std::size_t nearest = vertices.size();
        for (std::size_t v = 0; v < vertices.size(); ++v)
            if (!closed[v] && distance[v] < infinity &&
                (nearest == vertices.size() || distance[v] < distance[nearest]))
                nearest = v;
        if (nearest == vertices.size()) return distance;
        closed[nearest] = true;
        for (const freespace::Triangle& t : freespace.triangles()) {
            if (t.a != nearest && t.b != nearest && t.c != nearest) continue;
            for (const std::uint32_t v : {t.a, t.b, t.c})
                if (vertices[v].free_distance > 0.0F)
                    distance[v] = std::min(
                        distance[v],
                        distance[nearest] +
                            (vertices[v].position() - vertices[nearest].position()).cast<double>().norm());
        }
    }
}

}  // namespace camdir::test
