// A picture by itself as a PNG file; page.hpp has pages with lettering.
#pragma once

#include "base/error.hpp"
#include "base/file.hpp"
#include "render/picture.hpp"

namespace camdir::render {

// Fails when memory is short. Precondition: at least one pixel.
[[nodiscard]] Result<Bytes> to_png(const Picture& picture);

}  // namespace camdir::render
