// What a mesh reduction may take away.
#pragma once

#include <cstdint>

namespace camdir::bake {

struct Reduction {
    double loss = 0.0;            // how much free distance the centre of a ball may lose, map units
    double margin = 0.0;          // free distances up to this count as none, map units
    std::uint64_t triangles = 0;  // > 0: stop soon after no more than these are left
};

}  // namespace camdir::bake
