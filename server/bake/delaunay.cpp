#include "bake/delaunay.hpp"

#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Delaunay_triangulation_cell_base_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_cell_base_with_info_3.h>
#include <CGAL/Triangulation_vertex_base_with_info_3.h>
#include <CGAL/property_map.h>
#include <CGAL/spatial_sort.h>

#include <algorithm>
#include <cassert>
#include <utility>

#include "base/parallel.hpp"

namespace camdir::bake {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_3<std::uint32_t, Kernel>;  // sample
using CellBase = CGAL::Triangulation_cell_base_with_info_3<
    std::uint32_t, Kernel, CGAL::Delaunay_triangulation_cell_base_3<Kernel>>;  // index in Delaunay::cells
using Triangulation =
    CGAL::Delaunay_triangulation_3<Kernel, CGAL::Triangulation_data_structure_3<VertexBase, CellBase>>;
using Point = Kernel::Point_3;

// Inserts in an order that keeps neighbours together; checks `stage` every few thousand points.
bool insert(const std::vector<Vec3d>& samples, Triangulation& triangulation, Stage& stage) {
    std::vector<std::pair<Point, std::uint32_t>> points;
    points.reserve(samples.size());
    for (const Vec3d& p : samples)
        points.emplace_back(Point(p.x(), p.y(), p.z()), static_cast<std::uint32_t>(points.size()));
    using First = CGAL::First_of_pair_property_map<std::pair<Point, std::uint32_t>>;
    CGAL::spatial_sort(points.begin(), points.end(), CGAL::Spatial_sort_traits_adapter_3<Kernel, First>());

    Triangulation::Cell_handle hint;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (i % 4096 == 0 && !stage.advance(i, points.size())) return false;
        const auto vertex = triangulation.insert(points[i].first, hint);
        vertex->info() = points[i].second;
        hint = vertex->cell();
    }
    return true;
}

struct Cells {
    std::vector<Cell> samples;
    std::vector<Triangulation::Cell_handle> handles;
};

// Numbers the finite cells by their samples: the order of CGAL's containers depends on memory addresses.
Result<Cells> number_cells(const Triangulation& triangulation, Stage& stage) {
    using Entry = std::pair<Cell, Triangulation::Cell_handle>;
    std::vector<Entry> entries;
    entries.reserve(triangulation.number_of_finite_cells());
    for (const auto handle : triangulation.finite_cell_handles()) {
        if (entries.size() % 65536 == 0 && !stage.advance(0, 0)) return stage.interrupted();
        Cell cell;
        for (int i = 0; i < 4; ++i)
            cell[i] = handle->vertex(i)->info();
        std::sort(cell.begin(), cell.end());
        entries.emplace_back(cell, handle);
    }
    parallel_sort(entries.begin(), entries.end(),
                  [](const Entry& a, const Entry& b) { return a.first < b.first; });
    Cells cells;
    cells.samples.reserve(entries.size());
    cells.handles.reserve(entries.size());
    for (const auto& [samples, handle] : entries) {
        handle->info() = static_cast<std::uint32_t>(cells.handles.size());
        cells.samples.push_back(samples);
        cells.handles.push_back(handle);
    }
    return cells;
}

// Finds the Voronoi faces that begin with given cells.
class FaceFinder {
  public:
    FaceFinder(const Triangulation& triangulation, const std::vector<double>& min_lengths)
        : triangulation_(triangulation), min_lengths_(min_lengths) {}

    void append_faces_of(Triangulation::Cell_handle cell, Delaunay& result) const {
        for (int i = 0; i < 4; ++i)
            for (int j = 0; j < 4; ++j)
                if (cell->vertex(i)->info() < cell->vertex(j)->info() && is_long(cell, i, j))
                    append_face({cell, i, j}, result);
    }

  private:
    [[nodiscard]] bool is_long(Triangulation::Cell_handle cell, int i, int j) const {
        const auto a = cell->vertex(i);
        const auto b = cell->vertex(j);
        const double min_length = std::min(min_lengths_[a->info()], min_lengths_[b->info()]);
        return CGAL::squared_distance(a->point(), b->point()) >= min_length * min_length;
    }

    // Nothing when another cell around the edge comes first or the face is unbounded.
    void append_face(const Triangulation::Edge& edge, Delaunay& result) const {
        const auto& [first, i, j] = edge;
        const std::size_t begin = result.face_cells.size();
        auto cell = triangulation_.incident_cells(edge, first);
        do {
            if (triangulation_.is_infinite(cell) || cell->info() < first->info()) {
                result.face_cells.resize(begin);
                return;
            }
            result.face_cells.push_back(cell->info());
        } while (Triangulation::Cell_handle(++cell) != first);
        result.face_begin.push_back(result.face_cells.size());
        result.generators.push_back({first->vertex(i)->info(), first->vertex(j)->info()});
    }

    const Triangulation& triangulation_;
    const std::vector<double>& min_lengths_;
};

void append(const Delaunay& part, Delaunay& whole) {
    const std::uint64_t offset = whole.face_cells.size();
    whole.face_cells.insert(whole.face_cells.end(), part.face_cells.begin(), part.face_cells.end());
    whole.generators.insert(whole.generators.end(), part.generators.begin(), part.generators.end());
    for (std::size_t i = 1; i < part.face_begin.size(); ++i)
        whole.face_begin.push_back(offset + part.face_begin[i]);
}

}  // namespace

Result<Delaunay> delaunay(const std::vector<Vec3d>& samples, const std::vector<double>& min_lengths,
                          Stage& stage) {
    assert(min_lengths.size() == samples.size());
    Triangulation triangulation;
    if (!insert(samples, triangulation, stage)) return stage.interrupted();
    if (triangulation.dimension() < 3) return fail("all samples of the obstacles lie in one plane");

    auto cells = number_cells(triangulation, stage);
    if (!cells) return tl::unexpected(std::move(cells.error()));
    constexpr std::size_t part_size = 4096;  // cells
    const FaceFinder finder(triangulation, min_lengths);
    std::vector<Delaunay> parts((cells->handles.size() + part_size - 1) / part_size);
    const bool done = stage.for_each(parts.size(), [&](std::uint64_t part) {
        const std::size_t end = std::min(cells->handles.size(), (part + 1) * part_size);
        for (std::size_t cell = part * part_size; cell < end; ++cell)
            finder.append_faces_of(cells->handles[cell], parts[part]);
    });
    if (!done) return stage.interrupted();

    Delaunay result;
    result.cells = std::move(cells->samples);
    for (const Delaunay& part : parts)
        append(part, result);
    stage.count("cells", static_cast<double>(result.cells.size()));
    stage.count("bounded faces", static_cast<double>(result.face_count()));
    return result;
}

}  // namespace camdir::bake
