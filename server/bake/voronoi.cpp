#include "bake/voronoi.hpp"

#include <algorithm>

#include "bake/geometry/circumcentre.hpp"
#include "base/disjoint_sets.hpp"

namespace camdir::bake {
namespace {

// Unites neighbouring Voronoi vertices; each stays nearer than `distance` to its set's representative, so
// that chains of close vertices do not collapse.
DisjointSets merge_neighbours(const std::vector<Vec3d>& centres, const Delaunay& delaunay, double distance) {
    DisjointSets sets(centres.size());
    std::vector<double> radius(centres.size());  // of a representative: bound of the distance to its members
    for (std::size_t i = 0; i < delaunay.face_count(); ++i) {
        const auto face = delaunay.face(i);
        for (std::size_t k = 0; k < face.size(); ++k) {
            const std::uint32_t a = sets.find(face[k]);
            const std::uint32_t b = sets.find(face[(k + 1) % face.size()]);
            if (a == b) continue;
            const auto [kept, lost] = std::minmax(a, b);
            const double needed = (centres[kept] - centres[lost]).norm() + radius[lost];
            if (!(needed < distance)) continue;
            sets.unite(kept, lost);
            radius[kept] = std::max(radius[kept], needed);
        }
    }
    return sets;
}

// Over cell indices: merged corners once.
void simplify(std::vector<std::uint32_t>& polygon) {
    polygon.erase(std::unique(polygon.begin(), polygon.end()), polygon.end());
    while (polygon.size() > 1 && polygon.front() == polygon.back())
        polygon.pop_back();
}

}  // namespace

Result<VoronoiFaces> voronoi_faces(const std::vector<Vec3d>& samples, const Delaunay& delaunay,
                                   const Box3d& bounds, double merge_distance, Stage& stage) {
    const auto& cells = delaunay.cells;
    std::vector<Vec3d> centres(cells.size());
    const bool done = stage.for_each(cells.size(), [&](std::uint64_t i) {
        const auto& [a, b, c, d] = cells[i];
        centres[i] = circumcentre({samples[a], samples[b], samples[c], samples[d]});
    });
    if (!done) return stage.interrupted();

    DisjointSets sets = merge_neighbours(centres, delaunay, merge_distance);
    constexpr std::uint32_t unused = 0xffffffffU;
    std::vector<std::uint32_t> vertex_of(cells.size(), unused);
    VoronoiFaces faces;
    std::vector<std::uint32_t> polygon;
    for (std::size_t i = 0; i < delaunay.face_count(); ++i) {
        if (i % 16384 == 0 && !stage.advance(i, delaunay.face_count())) return stage.interrupted();
        polygon.clear();
        for (const std::uint32_t cell : delaunay.face(i))
            polygon.push_back(sets.find(cell));
        simplify(polygon);
        const bool inside = std::all_of(polygon.begin(), polygon.end(),
                                        [&](std::uint32_t cell) { return bounds.contains(centres[cell]); });
        if (polygon.size() < 3 || !inside) continue;
        for (const std::uint32_t cell : polygon) {
            if (vertex_of[cell] == unused) {
                vertex_of[cell] = static_cast<std::uint32_t>(faces.vertices.size());
                faces.vertices.push_back(centres[cell]);
            }
            faces.corners.push_back(vertex_of[cell]);
        }
        faces.begin.push_back(faces.corners.size());
        faces.generators.push_back(delaunay.generators[i]);
    }
    stage.count("vertices", static_cast<double>(faces.vertices.size()));
    stage.count("faces", static_cast<double>(faces.size()));
    return faces;
}

}  // namespace camdir::bake
