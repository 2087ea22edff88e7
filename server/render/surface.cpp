#include "render/surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "render/png.hpp"

namespace camdir::render {
namespace {

std::uint32_t eight_bit(float value) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

cairo_status_t append(void* closure, const unsigned char* bytes, unsigned int count) {
    const auto added = std::as_bytes(std::span(bytes, count));
    auto& file = *static_cast<Bytes*>(closure);
    file.insert(file.end(), added.begin(), added.end());
    return CAIRO_STATUS_SUCCESS;
}

}  // namespace

Result<Surface> make_surface(int width, int height) {
    Surface surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height), cairo_surface_destroy);
    if (const cairo_status_t status = cairo_surface_status(surface.get()); status != CAIRO_STATUS_SUCCESS)
        return fail(std::string("picture: ") + cairo_status_to_string(status));
    return surface;
}

void copy_pixels(const Picture& picture, cairo_surface_t* surface, int first_row) {
    cairo_surface_flush(surface);
    unsigned char* bytes = cairo_image_surface_get_data(surface);
    const std::ptrdiff_t stride = cairo_image_surface_get_stride(surface);
    for (int y = 0; y < picture.height; ++y) {
        auto* row = reinterpret_cast<std::uint32_t*>(bytes + (first_row + y) * stride);
        for (int x = 0; x < picture.width; ++x) {
            const Colour& colour = picture.at(x, y);
            row[x] = eight_bit(colour.red) << 16 | eight_bit(colour.green) << 8 | eight_bit(colour.blue);
        }
    }
    cairo_surface_mark_dirty(surface);
}

Result<Bytes> to_png(cairo_surface_t* surface) {
    Bytes file;
    const cairo_status_t status = cairo_surface_write_to_png_stream(surface, append, &file);
    if (status != CAIRO_STATUS_SUCCESS)
        return fail(std::string("picture: cannot write PNG: ") + cairo_status_to_string(status));
    return file;
}

Result<Bytes> to_png(const Picture& picture) {
    const auto surface = make_surface(picture.width, picture.height);
    if (!surface) return tl::unexpected(surface.error());
    copy_pixels(picture, surface->get(), 0);
    return to_png(surface->get());
}

}  // namespace camdir::render
