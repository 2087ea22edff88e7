#include "camera/candidates.hpp"

#include <cmath>

namespace camdir::camera {

const std::array<Vec3f, DirectionGrid::size>& DirectionGrid::directions() {
    static const std::array<Vec3f, size> all = [] {
        std::array<Vec3f, size> list;
        for (std::size_t bin = 0; bin < size; ++bin)
            list[bin] = direction_of(look(bin));
        return list;
    }();
    return all;
}

}  // namespace camdir::camera
