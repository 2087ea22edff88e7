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

// Inserts in an order that keeps neighbours together, a few thousand points between two looks at `stage`.
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

// Numbers the finite cells by their samples: the order of CGAL's containers depends on memory addresses.
Result<std::vector<Cell>> number_cells(const Triangulation& triangulation, Stage& stage) {
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
    std::vector<Cell> cells;
    cells.reserve(entries.size());
    for (const auto& [cell, handle] : entries) {
        handle->info() = static_cast<std::uint32_t>(cells.size());
        cells.push_back(cell);
    }
    return cells;
}

struct LongEdge {
    Edge samples;
    Triangulation::Edge edge;  // leads from the first to the second
};

Result<std::vector<LongEdge>> long_edges(const Triangulation& triangulation,
                                         const std::vector<double>& min_lengths, Stage& stage) {
    std::vector<LongEdge> edges;
    std::size_t seen = 0;
    for (const auto& [cell, i, j] : triangulation.finite_edges()) {
        if (++seen % 65536 == 0 && !stage.advance(0, 0)) return stage.interrupted();
        const auto a = cell->vertex(i);
        const auto b = cell->vertex(j);
        const double min_length = std::min(min_lengths[a->info()], min_lengths[b->info()]);
        if (CGAL::squared_distance(a->point(), b->point()) < min_length * min_length) continue;
        if (a->info() < b->info())
            edges.push_back({{a->info(), b->info()}, {cell, i, j}});
        else
            edges.push_back({{b->info(), a->info()}, {cell, j, i}});
    }
    parallel_sort(edges.begin(), edges.end(),
                  [](const LongEdge& a, const LongEdge& b) { return a.samples < b.samples; });
    return edges;
}

// Appends the cells around the edge; nothing when the face reaches to infinity.
void append_ring(const Triangulation& triangulation, const LongEdge& edge, Delaunay& result) {
    const std::size_t begin = result.ring_cells.size();
    const auto first = triangulation.incident_cells(edge.edge);
    auto cell = first;
    do {
        if (triangulation.is_infinite(cell)) {
            result.ring_cells.resize(begin);
            return;
        }
        result.ring_cells.push_back(cell->info());
    } while (++cell != first);
    const auto ring = result.ring_cells.begin() + static_cast<std::ptrdiff_t>(begin);
    std::rotate(ring, std::min_element(ring, result.ring_cells.end()), result.ring_cells.end());
    result.ring_begin.push_back(result.ring_cells.size());
    result.ring_edges.push_back(edge.samples);
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
    Delaunay result;
    result.cells = std::move(*cells);
    const auto edges = long_edges(triangulation, min_lengths, stage);
    if (!edges) return tl::unexpected(edges.error());
    for (std::size_t i = 0; i < edges->size(); ++i) {
        if (i % 4096 == 0 && !stage.advance(i, edges->size())) return stage.interrupted();
        append_ring(triangulation, (*edges)[i], result);
    }
    stage.count("cells", static_cast<double>(result.cells.size()));
    stage.count("long edges", static_cast<double>(edges->size()));
    stage.count("bounded faces", static_cast<double>(result.ring_count()));
    return result;
}

}  // namespace camdir::bake
