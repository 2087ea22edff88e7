#include "scene/cloud/neighbours.hpp"

#include <array>
#include <cassert>
#include <cmath>
#include <nanoflann.hpp>

#include "base/parallel.hpp"

namespace camdir::scene {
namespace {

constexpr std::size_t max_count = 32;

struct Points {
    const std::vector<Vec3d>& points;

    [[nodiscard]] std::size_t kdtree_get_point_count() const { return points.size(); }
    [[nodiscard]] double kdtree_get_pt(std::size_t index, std::size_t axis) const {
        return points[index][static_cast<Eigen::Index>(axis)];
    }
    template <class Box>
    bool kdtree_get_bbox(Box&) const {
        return false;
    }
};

using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points>, Points, 3,
                                                 std::uint32_t>;

double mean_distance(const Tree& tree, const Vec3d& point, std::size_t count) {
    std::array<std::uint32_t, max_count + 1> indices{};
    std::array<double, max_count + 1> squares{};
    // The nearest one is the point itself.
    const std::size_t found = tree.knnSearch(point.data(), count + 1, indices.data(), squares.data());
    double sum = 0.0;
    for (std::size_t i = 1; i < found; ++i)
        sum += std::sqrt(squares[i]);
    return sum / static_cast<double>(count);
}

}  // namespace

std::vector<double> neighbour_distances(const std::vector<Vec3d>& points, std::size_t count) {
    assert(count > 0 && count <= max_count && points.size() > count);
    const Points adapted{points};
    const Tree tree(3, adapted, nanoflann::KDTreeSingleIndexAdaptorParams(16));
    std::vector<double> distances(points.size());
    parallel_for_ranges(std::size_t{0}, points.size(), std::size_t{1024},
                        [&](std::size_t begin, std::size_t end) {
                            for (std::size_t i = begin; i != end; ++i)
                                distances[i] = mean_distance(tree, points[i], count);
                        });
    return distances;
}

}  // namespace camdir::scene
