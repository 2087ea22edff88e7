#include "render/page.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdio>
#include <memory>

#include "base/utf8.hpp"
#include "render/surface.hpp"

namespace camdir::render {
namespace {

constexpr Colour ink{0.10F, 0.11F, 0.13F};
constexpr Colour paper{1.0F, 1.0F, 1.0F};

// All lengths scale with the size of the page.
struct Layout {
    explicit Layout(const PageSize& page)
        : width(page.width),
          font(std::clamp(std::min(page.width / 62.0, page.height / 34.0), 7.0, 60.0)),
          border(font * 0.8),
          header(std::ceil(font * 3.6)),
          footer(std::ceil(font * 2.6)),
          height(page.height) {}

    double width, font, border, header, footer, height;

    [[nodiscard]] double footer_middle() const { return height - footer * 0.5; }
};

class Pen {
  public:
    explicit Pen(cairo_surface_t* surface) : cairo_(cairo_create(surface), cairo_destroy) {}

    void colour(const Colour& c) {
        cairo_set_source_rgb(cairo_.get(), static_cast<double>(c.red), static_cast<double>(c.green),
                             static_cast<double>(c.blue));
    }

    void font(double size, bool bold) {
        cairo_select_font_face(cairo_.get(), "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                               bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
        cairo_set_font_size(cairo_.get(), size);
    }

    // Invalid UTF-8 would put the cairo context into an error state.
    double text_width(const std::string& text) {
        cairo_text_extents_t extents;
        cairo_text_extents(cairo_.get(), to_utf8(text).c_str(), &extents);
        return extents.x_advance;
    }

    // `anchor`: 0 = the text starts at x, 0.5 = its middle is there, 1 = it ends there.
    void text(double x, double y, const std::string& text, double anchor = 0.0) {
        cairo_move_to(cairo_.get(), x - anchor * text_width(text), y);
        cairo_show_text(cairo_.get(), to_utf8(text).c_str());
    }

    // In a smaller font when the text would be wider than `width`.
    void fitted_text(double x, double y, const std::string& text, double size, bool bold, double width) {
        font(size, bold);
        const double wide = text_width(text);
        if (wide > width) font(size * width / wide, bold);
        this->text(x, y, text);
    }

    void box(double x, double y, double width, double height) {
        cairo_rectangle(cairo_.get(), x, y, width, height);
        cairo_fill(cairo_.get());
    }

    void line(double x0, double y0, double x1, double y1, double width) {
        cairo_set_line_width(cairo_.get(), width);
        cairo_move_to(cairo_.get(), x0, y0);
        cairo_line_to(cairo_.get(), x1, y1);
        cairo_stroke(cairo_.get());
    }

    void disc(double x, double y, double radius) {
        cairo_new_path(cairo_.get());
        cairo_arc(cairo_.get(), x, y, radius, 0.0, 6.283185307179586);
        cairo_fill(cairo_.get());
    }

  private:
    std::unique_ptr<cairo_t, decltype(&cairo_destroy)> cairo_;
};

std::string number(double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g", value);
    return text.data();
}

void draw_colour_scale(Pen& pen, const Layout& layout, const Legend& legend, double left, double width) {
    const double top = layout.border * 0.5 + layout.font * 1.15;
    const double height = layout.font * 0.8;
    // Whole pixels, so that steps do not blend.
    const int steps = static_cast<int>(width);
    for (int x = 0; x < steps; ++x) {
        pen.colour(colour_scale((static_cast<float>(x) + 0.5F) / static_cast<float>(steps)));
        pen.box(std::floor(left) + x, std::floor(top), 1.0, std::ceil(height));
    }
    pen.colour(ink);
    pen.font(layout.font * 0.9, false);
    pen.text(left, top - layout.font * 0.35, "free distance");
    for (const double share : {0.0, 0.5, 1.0}) {
        const double units = share * static_cast<double>(legend.scale_maximum);
        std::string label = number(units) + " = " + number(units * legend.metres_per_unit) + " m";
        if (share == 0.0) label = "0";
        if (share == 1.0) label = "\u2265 " + label;
        pen.text(left + share * width, top + height + layout.font, label, share);
    }
}

void draw_header(Pen& pen, const Layout& layout, const Legend& legend) {
    const bool scale = legend.scale_maximum > 0.0F;
    const double scale_width = scale ? layout.width * 0.36 : 0.0;
    const double text_width = layout.width - scale_width - (scale ? 4.0 : 2.0) * layout.border;
    pen.colour(ink);
    pen.fitted_text(layout.border, layout.font * 1.6, legend.title, layout.font * 1.3, true, text_width);
    pen.fitted_text(layout.border, layout.font * 2.95, legend.subtitle, layout.font, false, text_width);
    if (scale) {
        draw_colour_scale(pen, layout, legend, layout.width - layout.border - scale_width, scale_width);
    }
}

// The longest of 1, 2, 5 times a power of ten that is at most `limit`.
double round_number_below(double limit) {
    const double power = std::pow(10.0, std::floor(std::log10(limit)));
    for (const double factor : {5.0, 2.0}) {
        if (factor * power <= limit) return factor * power;
    }
    return power;
}

// At the right end of the footer; returns its left end.
double draw_scale_bar(Pen& pen, const Layout& layout, const Legend& legend) {
    const double right = layout.width - layout.border;
    if (!(legend.units_per_pixel > 0.0)) return right;
    const double length = round_number_below(legend.units_per_pixel * layout.width * 0.2);
    const double left = right - length / legend.units_per_pixel;
    const double y = layout.footer_middle() + layout.font * 0.55;
    const double tick = layout.font * 0.3;
    pen.colour(ink);
    pen.line(left, y, right, y, layout.font * 0.14);
    pen.line(left, y - tick, left, y + tick, layout.font * 0.14);
    pen.line(right, y - tick, right, y + tick, layout.font * 0.14);
    pen.font(layout.font * 0.9, false);
    const std::string label = number(length) + " units = " + number(length * legend.metres_per_unit) + " m";
    const double middle = std::min((left + right) * 0.5, right - pen.text_width(label) * 0.5);
    pen.text(middle, y - layout.font * 0.5, label, 0.5);
    return std::min(left, right - pen.text_width(label));
}

void draw_mark(Pen& pen, const KeyEntry& entry, double x, double y, double size) {
    const double step = size / static_cast<double>(entry.colours.size());
    for (std::size_t i = 0; i < entry.colours.size(); ++i) {
        const double from = x + step * static_cast<double>(i);
        pen.colour(entry.colours[i]);
        switch (entry.mark) {
            case KeyEntry::Mark::disc:
                pen.disc(x + size * 0.5, y, size * 0.22);
                break;
            case KeyEntry::Mark::line:
                pen.line(from, y, from + step, y, size * 0.22);
                break;
            case KeyEntry::Mark::thin_line:
                pen.line(from, y, from + step, y, size * 0.09);
                break;
        }
    }
}

void draw_footer(Pen& pen, const Layout& layout, const Legend& legend) {
    const double available = draw_scale_bar(pen, layout, legend) - 3.0 * layout.border;
    const double entries = static_cast<double>(legend.key.size());
    pen.font(layout.font, false);
    double texts = 0.0;
    for (const KeyEntry& entry : legend.key)
        texts += pen.text_width(entry.meaning);
    // Of an entry: the mark, a gap, the text, a wider gap.
    const double needed = texts + entries * layout.font * 3.6;
    const double scale = std::min(1.0, available / std::max(needed, 1.0));
    const double font = layout.font * scale;
    pen.font(font, false);
    double x = layout.border;
    for (const KeyEntry& entry : legend.key) {
        draw_mark(pen, entry, x, layout.footer_middle(), font * 1.8);
        pen.colour(ink);
        pen.text(x + font * 2.2, layout.footer_middle() + font * 0.35, entry.meaning);
        x += font * 3.6 + pen.text_width(entry.meaning);
    }
}

}  // namespace

int picture_height(const PageSize& page) {
    const Layout layout(page);
    return page.height - static_cast<int>(layout.header) - static_cast<int>(layout.footer);
}

double round_up(double value) {
    const double power = std::pow(10.0, std::floor(std::log10(value)));
    for (const double factor : {1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0}) {
        if (factor * power >= value) return factor * power;
    }
    return 10.0 * power;
}

Result<Bytes> to_png(const Picture& picture, const Legend& legend, const PageSize& page) {
    assert(picture.width == page.width && picture.height == picture_height(page));
    const Layout layout(page);
    const auto surface = make_surface(page.width, page.height);
    if (!surface) return tl::unexpected(surface.error());
    {
        Pen pen(surface->get());
        pen.colour(paper);
        pen.box(0.0, 0.0, layout.width, layout.height);
        draw_header(pen, layout, legend);
        draw_footer(pen, layout, legend);
    }
    copy_pixels(picture, surface->get(), static_cast<int>(layout.header));
    return to_png(surface->get());
}

}  // namespace camdir::render
