#include "freespace/incidence.hpp"

namespace camdir::freespace {

Incidence build_incidence(std::size_t vertex_count, std::span<const Triangle> triangles) {
    Incidence incidence;
    incidence.offsets.assign(vertex_count + 1, 0);
    for (const auto& [a, b, c] : triangles)
        for (const std::uint32_t corner : {a, b, c})
            ++incidence.offsets[corner + 1];
    for (std::size_t v = 0; v < vertex_count; ++v)
        incidence.offsets[v + 1] += incidence.offsets[v];
    std::vector<std::uint32_t> next(incidence.offsets.begin(), incidence.offsets.end() - 1);
    incidence.triangles.resize(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t)
        for (const std::uint32_t corner : {triangles[t].a, triangles[t].b, triangles[t].c})
            incidence.triangles[next[corner]++] = t;
    return incidence;
}

}  // namespace camdir::freespace
