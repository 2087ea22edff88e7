#include "bake/thin.hpp"

#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

#include "base/parallel.hpp"

namespace camdir::bake {
namespace {

using GridCell = std::array<std::int64_t, 3>;

struct GridCellHash {
    std::size_t operator()(const GridCell& cell) const {
        std::uint64_t hash = 0;
        for (const std::int64_t i : cell)
            hash = (hash ^ static_cast<std::uint64_t>(i)) * 0x9e3779b97f4a7c15ULL + (hash >> 29);
        return hash;
    }
};

// The kept points, found by the cell of a grid of pitch 2 `distance` that they lie in: what is near
// a point lies in at most 8 cells. Points in one cell form a list through `next`.
class Grid {
  public:
    explicit Grid(double distance) : distance_(distance) {}

    [[nodiscard]] bool has_near(const Vec3d& point, const std::vector<Vec3d>& kept) const {
        const GridCell low = cell_of(point - Vec3d::Constant(distance_));
        const GridCell high = cell_of(point + Vec3d::Constant(distance_));
        for (std::int64_t x = low[0]; x <= high[0]; ++x)
            for (std::int64_t y = low[1]; y <= high[1]; ++y)
                for (std::int64_t z = low[2]; z <= high[2]; ++z) {
                    const auto found = first_.find({x, y, z});
                    if (found == first_.end()) continue;
                    for (std::uint32_t i = found->second; i != end; i = next_[i])
                        if ((kept[i] - point).squaredNorm() <= distance_ * distance_) return true;
                }
        return false;
    }

    // Points are added in the order of their indices.
    void add(const Vec3d& point) {
        const auto index = static_cast<std::uint32_t>(next_.size());
        const auto [entry, is_new] = first_.try_emplace(cell_of(point), index);
        next_.push_back(is_new ? end : entry->second);
        entry->second = index;
    }

  private:
    static constexpr std::uint32_t end = 0xffffffffU;

    [[nodiscard]] GridCell cell_of(const Vec3d& point) const {
        const Vec3d cell = point / (2.0 * distance_);
        return {static_cast<std::int64_t>(std::floor(cell.x())),
                static_cast<std::int64_t>(std::floor(cell.y())),
                static_cast<std::int64_t>(std::floor(cell.z()))};
    }

    double distance_;
    std::unordered_map<GridCell, std::uint32_t, GridCellHash> first_;
    std::vector<std::uint32_t> next_;
};

}  // namespace

Result<std::vector<Vec3d>> weld(std::vector<Vec3d> samples, double distance, Stage& stage) {
    for (Vec3d& sample : samples)
        sample += Vec3d::Zero();  // -0 becomes 0: of equal ones it must not matter which is kept
    parallel_sort(samples.begin(), samples.end(), [](const Vec3d& a, const Vec3d& b) {
        return std::tuple(a.x(), a.y(), a.z()) < std::tuple(b.x(), b.y(), b.z());
    });
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());

    Grid grid(distance);
    std::vector<Vec3d> kept;
    for (std::size_t i = 0; i < samples.size(); ++i) {
        if (i % 16384 == 0 && !stage.advance(i, samples.size())) return stage.interrupted();
        if (grid.has_near(samples[i], kept)) continue;
        grid.add(samples[i]);
        kept.push_back(samples[i]);
    }
    stage.count("samples", static_cast<double>(kept.size()));
    return kept;
}

}  // namespace camdir::bake
