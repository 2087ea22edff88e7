#include "bake/reduction/regions.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace camdir::bake {
namespace {

class Bisector {
  public:
    Bisector(std::span<const Vec3f> positions, std::size_t max_size, double fraction)
        : positions_(positions), max_size_(max_size), fraction_(fraction) {}

    void bisect(std::vector<std::uint32_t> vertices) {
        if (vertices.size() <= max_size_) {
            std::sort(vertices.begin(), vertices.end());
            regions_.push_back(std::move(vertices));
            return;
        }
        const int axis = longest_side(vertices);
        const auto at =
            vertices.begin() + static_cast<std::ptrdiff_t>(fraction_ * static_cast<double>(vertices.size()));
        std::nth_element(vertices.begin(), at, vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(positions_[a][axis], a) < std::pair(positions_[b][axis], b);
        });
        bisect({vertices.begin(), at});
        bisect({at, vertices.end()});
    }

    [[nodiscard]] std::vector<std::vector<std::uint32_t>> take() { return std::move(regions_); }

  private:
    [[nodiscard]] int longest_side(const std::vector<std::uint32_t>& vertices) const {
        Box3f box;
        for (const std::uint32_t vertex : vertices)
            box.extend(positions_[vertex]);
        int axis = 0;
        box.sizes().maxCoeff(&axis);
        return axis;
    }

    std::span<const Vec3f> positions_;
    std::size_t max_size_;
    double fraction_;
    std::vector<std::vector<std::uint32_t>> regions_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> make_regions(std::span<const Vec3f> positions,
                                                     std::span<const std::uint32_t> chosen,
                                                     std::size_t max_size, double fraction) {
    assert(fraction * static_cast<double>(max_size) > 1.0 && fraction < 1.0);
    Bisector bisector(positions, max_size, fraction);
    bisector.bisect({chosen.begin(), chosen.end()});
    return bisector.take();
}

}  // namespace camdir::bake
