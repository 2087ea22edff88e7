// Cairo's surfaces of pixels, owned.
#pragma once

#include <cairo.h>

#include <memory>

#include "base/error.hpp"
#include "base/file.hpp"
#include "render/picture.hpp"

namespace camdir::render {

using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;

// Opaque. Fails when memory is short.
[[nodiscard]] Result<Surface> make_surface(int width, int height);

// Puts the picture's rows at `first_row` and below. Precondition: they fit.
void copy_pixels(const Picture& picture, cairo_surface_t* surface, int first_row);

[[nodiscard]] Result<Bytes> to_png(cairo_surface_t* surface);

}  // namespace camdir::render
