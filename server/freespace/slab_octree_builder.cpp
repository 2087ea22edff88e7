#include "freespace/slab_octree.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>

namespace camdir::freespace {
namespace {

// Halvings of the whole space: cells are counted in exact floats.
constexpr int max_levels = 16;
// Lists of so many slabs are short enough.
constexpr std::size_t short_list = 40;
// A slab is compared with so many of those that are better at the cell's centre.
constexpr std::size_t max_rivals = 8;
// Cells are taken as larger by this share, so that it does not matter to which of two cells a point on their
// common face is rounded.
constexpr float overlap = 1e-3F;

// Slab evaluations that a build may take, each of which is kept for a while in the worst case: fewer for each
// slab of a huge mesh, and never so many that the lists' offsets overflow.
std::size_t work_limit(std::size_t triangle_count) {
    constexpr std::size_t reduced_mesh = 1U << 14U;
    constexpr std::size_t large = 1U << 25U;
    constexpr std::size_t largest = 1U << 28U;
    const std::size_t wanted =
        (1U << 16U) + 512 * std::min(triangle_count, reduced_mesh) + 64 * triangle_count;
    return std::min(wanted, std::max(large, std::min(12 * triangle_count, largest)));
}

// The eight corners of a cell, relative to its centre.
struct CellCorners {
    Float4 x[2], y[2], z[2];

    explicit CellCorners(float half) {
        for (int high = 0; high < 2; ++high) {
            x[high] = half * Float4{-1, 1, -1, 1};
            y[high] = half * Float4{-1, -1, 1, 1};
            z[high] = broadcast(high == 0 ? -half : half);
        }
    }
};

// From the centre of a cube of this half width.
float to_corner(float half) {
    return 1.7321F * half;
}

struct CornerValues {
    Float4 value[2];

    // At every corner.
    [[nodiscard]] bool at_most(const CornerValues& other) const {
        return bits((value[0] <= other.value[0]) & (value[1] <= other.value[1])) == 15;
    }
    [[nodiscard]] bool somewhere_positive() const { return bits((value[0] > 0.0F) | (value[1] > 0.0F)) != 0; }
};

}  // namespace

// Breadth first, from the whole space down.
class SlabOctreeBuilder {
  public:
    explicit SlabOctreeBuilder(SlabOctree& octree) : octree_(octree), frames_(octree.frames_.frames) {}

    void build(float smallest_cell) {
        place(smallest_cell);
        octree_.nodes_.push_back(SlabOctree::empty_leaf);
        Level level = whole();
        std::size_t work = level.bounds.size();
        for (int halvings = levels_; !level.cells.empty(); --halvings) {
            const float size = smallest_ * static_cast<float>(1U << halvings);
            shorten(level, size);
            for (const Cell& cell : level.cells)
                if (cell.count > short_list) work += 8 * std::size_t{cell.count};
            const bool may_split = halvings > 0 && work <= work_limit(frames_.size());
            level = may_split ? split(level, size) : make_leaves(level, size);
        }
        make_grid();
        octree_.nodes_.shrink_to_fit();
        octree_.lists_.shrink_to_fit();
    }

  private:
    struct Tangent {
        float value;  // at the centre of a cell
        Vec3f slope;
    };
    // A slab and a tangent of its values, which are concave: nowhere above it.
    struct Bound {
        std::uint32_t slab;
        Tangent tangent;
    };
    struct Cell {
        std::uint32_t node;
        std::array<std::uint32_t, 3> place;  // in cells of its size
        std::uint32_t first, count;          // of Level::bounds
    };
    struct Level {
        std::vector<Cell> cells;
        std::vector<Bound> bounds;  // at first at the centre of the cell above, shortened at the cell's own
    };

    Level whole() const {
        Level level;
        level.cells.push_back({0, {0, 0, 0}, 0, static_cast<std::uint32_t>(frames_.size())});
        const Tangent unknown{std::numeric_limits<float>::infinity(), Vec3f::Zero()};
        for (std::uint32_t i = 0; i < frames_.size(); ++i)
            level.bounds.push_back({i, unknown});
        return level;
    }

    // A cube around all balls.
    void place(float smallest_cell) {
        Box3f reach;
        for (const Vertex& vertex : octree_.vertices_) {
            const Vec3f radius = Vec3f::Constant(std::max(vertex.free_distance, 0.0F));
            reach.extend(vertex.position() - radius);
            reach.extend(vertex.position() + radius);
        }
        // Coarser than the rounding of coordinates.
        const float magnitude =
            std::max(reach.min().cwiseAbs().maxCoeff(), reach.max().cwiseAbs().maxCoeff());
        const float size = reach.sizes().maxCoeff();
        smallest_ = std::max({std::min(smallest_cell, size / 256.0F),
                              size / static_cast<float>(1U << (max_levels - 1)), magnitude * 1e-5F, 1e-30F});
        while (smallest_ * static_cast<float>(1U << levels_) <= size)
            ++levels_;
        octree_.origin_ = reach.min();
        octree_.cells_per_unit_ = 1.0F / smallest_;
        for (int axis = 0; axis < 3; ++axis)
            cells_[static_cast<std::size_t>(axis)] =
                std::min(static_cast<std::uint32_t>(reach.sizes()[axis] / smallest_) + 1, 1U << levels_);
    }

    Vec3f centre_of(const std::array<std::uint32_t, 3>& cell, float size) const {
        const Vec3f place(static_cast<float>(cell[0]), static_cast<float>(cell[1]),
                          static_cast<float>(cell[2]));
        return octree_.origin_ + size * (place + Vec3f::Constant(0.5F));
    }

    // Leaves in each cell's list the slabs that may be the best one somewhere in it.
    void shorten(Level& level, float size) {
        std::vector<Bound> kept;
        for (Cell& cell : level.cells) {
            const auto [x, y, z] = cell.place;
            const Vec3f above = centre_of({x / 2, y / 2, z / 2}, 2.0F * size);
            const Vec3f centre = centre_of(cell.place, size);
            const float half = 0.5F * size * (1.0F + overlap);
            const auto first = static_cast<std::uint32_t>(kept.size());
            preselect(std::span(level.bounds).subspan(cell.first, cell.count), above, centre, half);
            evaluate(centre, half);
            keep_unbeaten(centre, half, kept);
            cell.first = first;
            cell.count = static_cast<std::uint32_t>(kept.size()) - first;
        }
        level.bounds = std::move(kept);
    }

    // Puts into candidates_ what may be useful by the tangents at the centre of the cell above.
    void preselect(std::span<const Bound> bounds, const Vec3f& above, const Vec3f& centre, float half) {
        candidates_.clear();
        if (bounds.empty()) return;
        const Vec3f way = centre - above;
        const auto value_here = [&](const Bound& bound) {
            return bound.tangent.value + bound.tangent.slope.dot(way);
        };
        const CellCorners corners(half);
        const Bound& top = *std::ranges::max_element(bounds, {}, value_here);
        const CornerValues to_beat = values_at(top.slab, centre, corners);
        for (const Bound& bound : bounds) {
            const CornerValues values = corner_values({value_here(bound), bound.tangent.slope}, corners);
            if (!values.somewhere_positive()) continue;
            if (values.at_most(to_beat) && &bound != &top) continue;
            candidates_.push_back(bound);
        }
    }

    // Moves the tangents of the candidates to the centre; those with the largest values there come first.
    void evaluate(const Vec3f& centre, float half) {
        for (std::size_t i = 0; i < candidates_.size(); i += lane_count) {
            const std::size_t count = std::min<std::size_t>(lane_count, candidates_.size() - i);
            FourSlabs four;
            for (std::size_t k = 0; k < lane_count; ++k)
                four[k] = candidates_[i + std::min(k, count - 1)].slab;
            const SlabPoints points = slab_points(frames_, four, centre);
            for (std::size_t k = 0; k < count; ++k)
                candidates_[i + k].tangent =
                    tangent(points.value[k], Vec3f(points.way_x[k], points.way_y[k], points.way_z[k]), half);
        }
        const auto rivals = static_cast<std::ptrdiff_t>(std::min(max_rivals, candidates_.size()));
        std::ranges::partial_sort(
            candidates_, candidates_.begin() + rivals, [](const Bound& a, const Bound& b) {
                return a.tangent.value != b.tangent.value ? a.tangent.value > b.tangent.value
                                                          : a.slab < b.slab;
            });
    }

    // A tangent that is not above the values of another slab at the cell's corners is nowhere in the cell
    // above them.
    void keep_unbeaten(const Vec3f& centre, float half, std::vector<Bound>& kept) {
        const CellCorners corners(half);
        rivals_.clear();
        for (const Bound& candidate : candidates_) {
            const CornerValues values = corner_values(candidate.tangent, corners);
            if (!values.somewhere_positive()) continue;
            if (std::ranges::any_of(rivals_, [&](const auto& rival) { return values.at_most(rival); }))
                continue;
            kept.push_back(candidate);
            if (rivals_.size() < max_rivals) rivals_.push_back(values_at(candidate.slab, centre, corners));
        }
    }

    // The tangent of a slab's values at the centre, where its best point lies at `way`.
    static Tangent tangent(float value, const Vec3f& way, float half) {
        const float length = way.norm();
        if (length > 0.02F * half) return {value, way / length};
        // The direction is too uncertain: no value changes by more than the way.
        return {value + to_corner(half), Vec3f::Zero()};
    }

    static CornerValues corner_values(const Tangent& tangent, const CellCorners& corners) {
        CornerValues bounds;
        for (int high = 0; high < 2; ++high)
            bounds.value[high] = tangent.value + tangent.slope.x() * corners.x[high] +
                                 tangent.slope.y() * corners.y[high] + tangent.slope.z() * corners.z[high];
        return bounds;
    }

    CornerValues values_at(std::uint32_t slab, const Vec3f& centre, const CellCorners& corners) const {
        CornerValues values;
        for (int high = 0; high < 2; ++high)
            values.value[high] = slab_values(frames_[slab], centre.x() + corners.x[high],
                                             centre.y() + corners.y[high], centre.z() + corners.z[high]);
        return values;
    }

    // Of each cell with a long list the eight parts, which share it.
    Level split(const Level& level, float size) {
        Level next;
        for (const Cell& cell : level.cells) {
            if (cell.count <= short_list) {
                make_leaf(level, cell, size);
                continue;
            }
            const auto first = static_cast<std::uint32_t>(next.bounds.size());
            const auto bounds = std::span(level.bounds).subspan(cell.first, cell.count);
            next.bounds.insert(next.bounds.end(), bounds.begin(), bounds.end());
            octree_.nodes_[cell.node] = static_cast<std::uint32_t>(octree_.nodes_.size());
            for (std::uint32_t octant = 0; octant < 8; ++octant) {
                const auto [x, y, z] = cell.place;
                next.cells.push_back(
                    {static_cast<std::uint32_t>(octree_.nodes_.size()),
                     {2 * x + (octant & 1U), 2 * y + (octant >> 1U & 1U), 2 * z + (octant >> 2U)},
                     first,
                     cell.count});
                octree_.nodes_.push_back(SlabOctree::empty_leaf);
            }
        }
        return next;
    }

    Level make_leaves(const Level& level, float size) {
        for (const Cell& cell : level.cells)
            make_leaf(level, cell, size);
        return {};
    }

    void make_leaf(const Level& level, const Cell& cell, float size) {
        if (cell.count == 0) return;
        const auto bounds = std::span(level.bounds).subspan(cell.first, cell.count);
        const Vec3f centre = centre_of(cell.place, size);
        const float half = 0.5F * size;
        octree_.nodes_[cell.node] =
            SlabOctree::leaf_bit | static_cast<std::uint32_t>(octree_.lists_.size() / SlabOctree::list_unit);
        float top = bounds[0].tangent.value;
        for (const Bound& bound : bounds)
            top = std::max(top, bound.tangent.value);
        // What rounding the slopes may lose at a corner of the cell, doubled.
        append(
            SlabOctree::ListHead{{centre.x(), centre.y(), centre.z()},
                                 half,
                                 top + 3.0F * half * (1.0F + overlap) / SlabOctree::slope_unit,
                                 static_cast<std::uint32_t>((bounds.size() + lane_count - 1) / lane_count)});
        for (std::size_t i = 0; i < bounds.size(); i += lane_count) {
            SlabOctree::Quad quad;
            for (std::size_t k = 0; k < lane_count; ++k) {
                const auto& [slab, tangent] = bounds[std::min(i + k, bounds.size() - 1)];
                const float drop = (top - tangent.value) / (SlabOctree::drop_unit * half);
                quad.bounds[0][k] =
                    static_cast<std::int8_t>(std::floor(std::clamp(drop, 0.0F, 255.0F)) - 128.0F);
                for (int axis = 0; axis < 3; ++axis)
                    quad.bounds[axis + 1][k] =
                        static_cast<std::int8_t>(std::lround(SlabOctree::slope_unit * tangent.slope[axis]));
                quad.slabs[k] = slab;
            }
            append(quad);
        }
    }

    template <class Part>
    void append(const Part& part) {
        static_assert(sizeof(Part) % SlabOctree::list_unit == 0);
        const auto bytes = std::as_bytes(std::span(&part, 1));
        octree_.lists_.insert(octree_.lists_.end(), bytes.begin(), bytes.end());
    }

    // The finest level at which a grid over the space has about one cell a triangle.
    void make_grid() {
        int shift = levels_;
        const auto grid_cells = [&](int of_shift) {
            std::size_t count = 1;
            for (const std::uint32_t cells : cells_)
                count *= ((cells - 1) >> of_shift) + 1;
            return count;
        };
        while (shift > 0 && grid_cells(shift - 1) <= 512 + frames_.size())
            --shift;
        octree_.grid_shift_ = shift;
        std::array<std::uint32_t, 3> counts{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            counts[axis] = ((cells_[axis] - 1) >> shift) + 1;
            octree_.extent_[axis] = counts[axis] << shift;
        }
        for (std::uint32_t z = 0; z < counts[2]; ++z)
            for (std::uint32_t y = 0; y < counts[1]; ++y)
                for (std::uint32_t x = 0; x < counts[0]; ++x)
                    octree_.grid_.push_back(node_at({x, y, z}, levels_ - shift));
    }

    // The node of a cell after so many halvings of the whole, or the leaf that holds it.
    SlabOctree::Node node_at(const std::array<std::uint32_t, 3>& place, int halvings) const {
        SlabOctree::Node node = octree_.nodes_[0];
        while (halvings-- > 0 && (node & SlabOctree::leaf_bit) == 0) {
            const std::uint32_t octant = (place[0] >> halvings & 1U) | (place[1] >> halvings & 1U) << 1U |
                                         (place[2] >> halvings & 1U) << 2U;
            node = octree_.nodes_[node + octant];
        }
        return node;
    }

    SlabOctree& octree_;
    std::span<const SlabFrame> frames_;
    float smallest_ = 1.0F;  // width of the smallest cells
    int levels_ = 0;
    std::array<std::uint32_t, 3> cells_{};  // smallest cells of the space along each axis
    std::vector<Bound> candidates_;
    std::vector<CornerValues> rivals_;
};

SlabOctree::SlabOctree(std::span<const Vertex> vertices, std::span<const Triangle> triangles,
                       float smallest_cell)
    : vertices_(vertices), frames_(build_frames(vertices, triangles)) {
    if (!triangles.empty()) SlabOctreeBuilder(*this).build(smallest_cell);
}

}  // namespace camdir::freespace
