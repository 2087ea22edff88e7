// A page with a picture: title and colour scale above it, legend and scale bar below it.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "base/file.hpp"
#include "render/picture.hpp"

namespace camdir::render {

// One entry of the legend: the meaning of marks with these colours.
struct KeyEntry {
    enum class Mark { disc, line, thin_line };
    Mark mark;
    std::vector<Colour> colours;
    std::string meaning;
};

struct Legend {
    std::string title;
    std::string subtitle;
    double metres_per_unit = 1.0;
    float scale_maximum = 0.0F;  // > 0: the colour scale of free distances from 0 to it, map units
    std::vector<KeyEntry> key;
    double units_per_pixel = 0.0;  // > 0: a bar that shows a length
};

struct PageSize {
    int width, height;  // pixels, both within min_page .. max_page
};
inline constexpr int min_page = 200;
inline constexpr int max_page = 8192;

// Rows of the picture on a page; it is as wide as the page.
[[nodiscard]] int picture_height(const PageSize& page);

// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10 times a power of ten that is not less than value > 0.
[[nodiscard]] double round_up(double value);

// The page as a PNG file's bytes. Precondition: the picture has picture_height(page) rows of page.width.
[[nodiscard]] Result<Bytes> to_png(const Picture& picture, const Legend& legend, const PageSize& page);

}  // namespace camdir::render
