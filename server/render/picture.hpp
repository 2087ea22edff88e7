// Pixels.
#pragma once

#include <vector>

#include "render/colour.hpp"

namespace camdir::render {

struct Picture {
    int width = 0, height = 0;
    std::vector<Colour> pixels;  // width * height, rows from the top

    [[nodiscard]] const Colour& at(int x, int y) const {
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
};

}  // namespace camdir::render
