#include "bake/reduction/regions.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace camdir::bake {
namespace {

class Cutter {
  public:
    Cutter(std::span<const Vec3f> positions, std::size_t most, double cut)
        : positions_(positions), most_(most), cut_(cut) {}

    void cut(std::vector<std::uint32_t> vertices) {
        if (vertices.size() <= most_) {
            std::sort(vertices.begin(), vertices.end());
            regions_.push_back(std::move(vertices));
            return;
        }
        const int axis = longest_side(vertices);
        const auto at =
            vertices.begin() + static_cast<std::ptrdiff_t>(cut_ * static_cast<double>(vertices.size()));
        std::nth_element(vertices.begin(), at, vertices.end(), [&](std::uint32_t a, std::uint32_t b) {
            return std::pair(positions_[a][axis], a) < std::pair(positions_[b][axis], b);
        });
        cut({vertices.begin(), at});
        cut({at, vertices.end()});
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
    std::size_t most_;
    double cut_;
    std::vector<std::vector<std::uint32_t>> regions_;
};

}  // namespace

std::vector<std::vector<std::uint32_t>> make_regions(std::span<const Vec3f> positions,
                                                     std::span<const std::uint32_t> chosen, std::size_t most,
                                                     double cut) {
    assert(cut * static_cast<double>(most) > 1.0 && cut < 1.0);
    Cutter cutter(positions, most, cut);
    cutter.cut({chosen.begin(), chosen.end()});
    return cutter.take();
}

}  // namespace camdir::bake
