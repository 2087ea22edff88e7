// What a mesh reduction may take away.
#pragma once

#include <cstdint>

namespace camdir::bake {

struct Reduction {
    double max_loss = 0.0;        // how much free distance the centre of a ball may lose, map units
    double offset_radius = 0.0;   // free distances up to this count as none, map units
    std::uint64_t triangles = 0;  // > 0: stop soon after at most this many are left
};

}  // namespace camdir::bake
