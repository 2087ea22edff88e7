#include "bake/shell.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::bake {
namespace {

// Samples: where a box is so thin that its edges have most of them.
constexpr double max_along_side = 1000.0;

Box3d grown(const Box3d& box, double distance) {
    const Vec3d by = Vec3d::Constant(distance);
    return {box.min() - by, box.max() + by};
}

}  // namespace

Shell shell_around(const Box3d& bounds, double d0, double coarsest) {
    const double distance = std::max(4.0 * d0, 0.5 * coarsest);
    const Vec3d size = grown(bounds, distance).sizes();
    const double area = 2.0 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x());
    // 40 % are left for the edges.
    const double spacing =
        std::max(std::sqrt(area / (0.6 * max_shell_samples)), size.maxCoeff() / max_along_side);
    return {distance, std::max(distance, spacing)};
}

std::vector<Vec3d> shell_samples(const Box3d& bounds, const Shell& around) {
    const Box3d shell = grown(bounds, around.distance);
    const Eigen::Vector3i last = (shell.sizes() / around.spacing).array().ceil().matrix().cast<int>();
    const auto on_face = [](int i, int end) { return i == 0 || i == end; };
    std::vector<Vec3d> samples;
    for (int x = 0; x <= last.x(); ++x) {
        for (int y = 0; y <= last.y(); ++y) {
            const bool is_side = on_face(x, last.x()) || on_face(y, last.y());
            for (int z = 0; z <= last.z(); z += is_side ? 1 : last.z()) {
                const Vec3d share = Vec3d(x, y, z).cwiseQuotient(last.cast<double>());
                samples.emplace_back(shell.min() + shell.sizes().cwiseProduct(share));
            }
        }
    }
    return samples;
}

}  // namespace camdir::bake
