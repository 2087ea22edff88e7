#include "render/view.hpp"

#include <gtest/gtest.h>

#include <random>

namespace camdir::render {
namespace {

const Box3d bounds(Vec3d(-100.0, 50.0, -20.0), Vec3d(300.0, 250.0, 80.0));

TEST(ParseView, ReadsAViewpoint) {
    const View view = parse_view("10,-20.5,30,90,0", bounds, 1.5).value();
    EXPECT_TRUE(view.position.isApprox(Vec3d(10.0, -20.5, 30.0)));
    EXPECT_TRUE(view.forward.isApprox(Vec3d::UnitY()));
    EXPECT_TRUE(view.up.isApprox(Vec3d::UnitZ()));
    EXPECT_FALSE(view.parallel);
    EXPECT_TRUE(parse_view("0,0,0,0,90", bounds, 1.0)->forward.isApprox(Vec3d::UnitZ()));
}

TEST(ParseView, RejectsInvalidText) {
    for (const char* text : {"", "top", "1,2,3", "1,2,3,4", "1,2,3,4,5,6", "nan,0,0,0,0", "0,0,0,inf,0",
                             "1;2;3;4;5", "1e9,0,0,0,0", "0,0,0,361,0", "0,0,0,0,91", "1,2,3,4,5x"}) {
        const auto view = parse_view(text, bounds, 1.0);
        ASSERT_FALSE(view) << text;
        EXPECT_NE(view.error().message.find(std::string("'") + text + "'"), std::string::npos);
    }
}

TEST(View, PlanAndOverviewHoldTheWholeBox) {
    for (const double aspect : {0.5, 1.0, 2.5}) {
        for (const View& view : {plan_view(bounds, aspect), overview(bounds, aspect)}) {
            double farthest = 0.0;
            for (int i = 0; i < 8; ++i) {
                const auto place = project(view, bounds.corner(static_cast<Box3d::CornerType>(i)), aspect);
                ASSERT_TRUE(place);
                farthest = std::max(farthest, place->cwiseAbs().maxCoeff());
            }
            EXPECT_LT(farthest, 1.0);
            EXPECT_GT(farthest, 0.9) << "and little more";
        }
    }
}

TEST(View, PlanShowsNorthUpInOneScale) {
    const double aspect = 1.5;
    const View view = plan_view(bounds, aspect);
    const Vec3d point(20.0, 100.0, 10.0);
    const auto place = project(view, point, aspect).value();
    const double units = units_per_pixel(view, point, 400);
    const auto east = project(view, point + Vec3d(units, 0.0, 0.0), aspect).value();
    const auto north = project(view, point + Vec3d(0.0, units, 0.0), aspect).value();
    EXPECT_NEAR((east - place).x() * 300.0, 1.0, 1e-9) << "a picture of 600 x 400 pixels";
    EXPECT_NEAR((north - place).y() * 200.0, 1.0, 1e-9);
    EXPECT_NEAR((east - place).y(), 0.0, 1e-12);
}

TEST(View, ProjectInvertsRays) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> within(-1.0, 1.0);
    const double aspect = 1.3;
    for (const char* text : {"plan", "auto", "5,6,7,33,-21"}) {
        const View view = parse_view(text, bounds, aspect).value();
        for (int i = 0; i < 100; ++i) {
            const double x = within(random);
            const double y = within(random);
            const Ray ray = ray_through(view, x, y, aspect);
            const auto place = project(view, ray.origin + 40.0 * ray.direction, aspect);
            ASSERT_TRUE(place);
            EXPECT_NEAR(place->x(), x, 1e-9);
            EXPECT_NEAR(place->y(), y, 1e-9);
        }
    }
    EXPECT_FALSE(project(parse_view("0,0,0,0,0", bounds, 1.0).value(), Vec3d(-1.0, 0.0, 0.0), 1.0));
}

}  // namespace
}  // namespace camdir::render
