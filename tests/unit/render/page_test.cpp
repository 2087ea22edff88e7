#include "render/page.hpp"

#include <gtest/gtest.h>

#include <cstring>
#include <string>

namespace camdir::render {
namespace {

Result<Bytes> page_of(const PageSize& size, const Legend& legend) {
    Picture picture{size.width, picture_height(size), {}};
    picture.pixels.assign(static_cast<std::size_t>(picture.width * picture.height), {0.2F, 0.4F, 0.6F});
    return to_png(picture, legend, size);
}

Legend full_legend() {
    Legend legend{"a map of a rather long name", "many triangles, more vertices", 0.0254, 150.0F, {}, 1.7};
    legend.key.push_back({KeyEntry::Mark::disc, {{1.0F, 0.0F, 0.0F}}, "8 spawn points"});
    legend.key.push_back({KeyEntry::Mark::line, {player_colour(0), player_colour(1)}, "2 players"});
    return legend;
}

std::uint32_t big_endian(const Bytes& bytes, std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < 4; ++i)
        value = value << 8 | std::to_integer<std::uint32_t>(bytes[at + i]);
    return value;
}

TEST(Page, IsAPngOfItsSize) {
    for (const PageSize size : {PageSize{640, 480}, PageSize{min_page, min_page}, PageSize{900, min_page},
                                PageSize{min_page, 900}}) {
        ASSERT_GT(picture_height(size), size.height / 2);
        const Bytes png = page_of(size, full_legend()).value();
        ASSERT_GT(png.size(), 33U);
        EXPECT_EQ(std::memcmp(png.data(), "\x89PNG\r\n\x1a\n", 8), 0);
        EXPECT_EQ(std::memcmp(png.data() + 12, "IHDR", 4), 0);
        EXPECT_EQ(big_endian(png, 16), static_cast<std::uint32_t>(size.width));
        EXPECT_EQ(big_endian(png, 20), static_cast<std::uint32_t>(size.height));
    }
}

TEST(Page, IsReproducibleAndShowsItsLegend) {
    const Legend legend = full_legend();
    const Bytes png = page_of({640, 480}, legend).value();
    EXPECT_EQ(page_of({640, 480}, legend).value(), png);
    Legend other = legend;
    other.title = "another";
    EXPECT_NE(page_of({640, 480}, other).value(), png);
    other = legend;
    other.units_per_pixel = 0.0;
    EXPECT_NE(page_of({640, 480}, other).value(), png);
    other = legend;
    other.key.pop_back();
    EXPECT_NE(page_of({640, 480}, other).value(), png);
}

TEST(Page, RoundsScalesUp) {
    EXPECT_DOUBLE_EQ(round_up(1.0), 1.0);
    EXPECT_DOUBLE_EQ(round_up(113.0), 150.0);
    EXPECT_DOUBLE_EQ(round_up(0.81), 1.0);
    EXPECT_DOUBLE_EQ(round_up(0.0041), 0.005);
}

TEST(Colour, ScaleRunsFromVioletToYellowAndClamps) {
    EXPECT_EQ(colour_scale(-3.0F).red, colour_scale(0.0F).red);
    EXPECT_EQ(colour_scale(7.0F).red, colour_scale(1.0F).red);
    const auto luminance = [](const Colour& c) {
        return 0.2126F * c.red + 0.7152F * c.green + 0.0722F * c.blue;
    };
    for (int i = 0; i < 50; ++i) {
        const auto at = static_cast<float>(i) / 50.0F;
        EXPECT_LT(luminance(colour_scale(at)), luminance(colour_scale(at + 0.02F))) << at;
    }
}

}  // namespace
}  // namespace camdir::render
