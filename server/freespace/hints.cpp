#include "freespace/hints.hpp"

#include <algorithm>
#include <cmath>

#include "freespace/search.hpp"

namespace camdir::freespace {
namespace {

constexpr float min_cells = 1'024.0F;
// A hint need not be the best slab: one that is a tenth worse serves as well.
constexpr float hint_slack = 0.1F;

float choose_cell_size(const MeshView& mesh, const Box3f& bounds) {
    const Vec3f size = bounds.sizes().cwiseMax(1.0F);
    const float cells = std::max(min_cells, static_cast<float>(mesh.triangles.size()));
    // At most 4,096 cells along the longest axis, however flat the map is.
    return std::max(std::cbrt(size.prod() / cells), size.maxCoeff() / 4096.0F);
}

}  // namespace

Hints build_hints(const MeshView& mesh, std::span<const IndexNode> index, const Box3f& bounds) {
    Hints hints;
    if (mesh.triangles.empty()) return hints;
    hints.cell_size = choose_cell_size(mesh, bounds);
    for (int axis = 0; axis < 3; ++axis)
        hints.extent[static_cast<std::size_t>(axis)] =
            static_cast<std::uint32_t>(bounds.sizes()[axis] / hints.cell_size) + 1;
    const auto [columns, rows, layers] = hints.extent;
    std::uint32_t previous = 0;
    for (std::uint32_t z = 0; z < layers; ++z) {
        for (std::uint32_t y = 0; y < rows; ++y) {
            for (std::uint32_t x = 0; x < columns; ++x) {
                const Vec3f cell(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
                const Vec3f centre = bounds.min() + hints.cell_size * (cell + Vec3f::Constant(0.5F));
                SlabPoint best = uncovered;
                improve_range(mesh, centre, previous, 1, best);
                improve_everywhere(mesh, index, centre, hint_slack, best);
                hints.triangles.push_back(best.triangle);
                if (best.triangle != none) previous = best.triangle;
            }
        }
    }
    return hints;
}

}  // namespace camdir::freespace
