#include "bake/shell.hpp"

#include <algorithm>
#include <cmath>

namespace camdir::bake {
namespace {

constexpr double most_along_one_side = 64.0;

}  // namespace

double shell_spacing(const Box3d& bounds, double d0) {
    return std::max(4.0 * d0, bounds.sizes().maxCoeff() / most_along_one_side);
}

std::vector<Vec3d> shell_samples(const Box3d& bounds, double spacing) {
    const Vec3d margin = Vec3d::Constant(spacing);
    const Box3d shell(bounds.min() - margin, bounds.max() + margin);
    const Eigen::Vector3i last = (shell.sizes() / spacing).array().ceil().matrix().cast<int>();
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
