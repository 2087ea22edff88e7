#include "render/draw.hpp"

#include <gtest/gtest.h>
#include <tbb/task_arena.h>

#include "support/freespace_meshes.hpp"

namespace camdir::render {
namespace {

constexpr int width = 120;
constexpr int height = 80;
constexpr double aspect = static_cast<double>(width) / height;
constexpr Colour red{0.9F, 0.1F, 0.2F};
const Box3d box(Vec3d(0.0, 0.0, -10.0), Vec3d(100.0, 100.0, 40.0));

View plan() {
    return plan_view(box, aspect);
}

const Colour& pixel_at(const Picture& picture, const View& view, const Vec3d& point) {
    const auto place = project(view, point, aspect).value();
    return picture.at(static_cast<int>((place.x() + 1.0) * 0.5 * width),
                      static_cast<int>((1.0 - place.y()) * 0.5 * height));
}

void expect_colour(const Colour& seen, const Colour& expected) {
    EXPECT_NEAR(seen.red, expected.red, 0.005F);
    EXPECT_NEAR(seen.green, expected.green, 0.005F);
    EXPECT_NEAR(seen.blue, expected.blue, 0.005F);
}

void expect_grey(const Colour& seen) {
    EXPECT_NEAR(seen.red, seen.blue, 0.05F);
    EXPECT_LT(seen.red, 0.95F) << "not the background";
    EXPECT_GT(seen.red, 0.2F);
}

// Over the whole square at height z, seen from above or from below.
scene::Scene sheet(double z, bool faces_up) {
    scene::Scene scene;
    scene.vertices = {{0.0, 0.0, z}, {100.0, 0.0, z}, {100.0, 100.0, z}, {0.0, 100.0, z}};
    scene.triangles = {{0, 1, 2}, {0, 2, 3}};
    if (!faces_up) scene.triangles = {{0, 2, 1}, {0, 3, 2}};
    scene.bounds = box;
    return scene;
}

Layers ball_in_the_middle(float radius = 20.0F) {
    Layers layers;
    layers.balls.push_back({{Vec3f(50.0F, 50.0F, 0.0F)}, red, radius});
    return layers;
}

TEST(Draw, DrawsABallAtItsPlaceOnly) {
    const View view = plan();
    const Picture picture = draw(ball_in_the_middle(), view, width, height).value();
    expect_colour(pixel_at(picture, view, {50.0, 50.0, 0.0}), red);
    expect_colour(pixel_at(picture, view, {50.0, 85.0, 0.0}), {1.0F, 1.0F, 1.0F});
    expect_colour(picture.at(0, 0), {1.0F, 1.0F, 1.0F});
}

TEST(Draw, HidesBackFacesAndEverythingAboveTheTop) {
    View view = plan();
    const scene::Scene ceiling = sheet(30.0, false);
    const scene::Scene upper_floor = sheet(30.0, true);
    Layers layers = ball_in_the_middle();
    const Vec3d middle(50.0, 50.0, 0.0);

    layers.map = &ceiling;
    expect_colour(pixel_at(draw(layers, view, width, height).value(), view, middle), red);
    layers.map = &upper_floor;
    expect_grey(pixel_at(draw(layers, view, width, height).value(), view, middle));
    view.top = 25.0;
    expect_colour(pixel_at(draw(layers, view, width, height).value(), view, middle), red);
    view.top = -25.0;
    expect_colour(pixel_at(draw(layers, view, width, height).value(), view, middle), {1.0F, 1.0F, 1.0F});
}

TEST(Draw, ColoursTheMeshByFreeDistance) {
    const auto mesh = test::make_freespace(test::square_contents());
    const View view = plan();
    for (const float maximum : {40.0F, 80.0F, 400.0F}) {
        Layers layers;
        layers.mesh = &mesh;
        layers.mesh_opacity = 1.0F;
        layers.free_distance_maximum = maximum;
        const Picture picture = draw(layers, view, width, height).value();
        expect_colour(pixel_at(picture, view, {70.0, 25.0, 0.0}), colour_scale(40.0F / maximum));
    }
}

TEST(Draw, BlendsATransparentMeshOverTheBackground) {
    const auto mesh = test::make_freespace(test::square_contents());
    const View view = plan();
    Layers layers;
    layers.mesh = &mesh;
    layers.mesh_opacity = 0.25F;
    layers.free_distance_maximum = 40.0F;
    const Picture picture = draw(layers, view, width, height).value();
    expect_colour(pixel_at(picture, view, {70.0, 25.0, 0.0}),
                  colour_scale(1.0F) * 0.25F + Colour{1.0F, 1.0F, 1.0F} * 0.75F);
}

TEST(Draw, DrawsTheRoadmapAlongEdgesOnly) {
    const auto mesh = test::make_freespace(test::square_contents());
    const View view = plan();
    Layers layers;
    layers.mesh = &mesh;
    layers.mesh_opacity = 0.0F;
    layers.roadmap_width = 6.0F;
    layers.free_distance_maximum = 40.0F;
    const Picture picture = draw(layers, view, width, height).value();
    expect_colour(pixel_at(picture, view, {50.0, 0.0, 0.0}), colour_scale(1.0F) * 0.9F);
    expect_colour(pixel_at(picture, view, {50.0, 20.0, 0.0}), {1.0F, 1.0F, 1.0F});
}

TEST(Draw, BreaksAPathWhereItsPointsAreNotFinite) {
    const View view = plan();
    Layers layers;
    const float nan = std::numeric_limits<float>::quiet_NaN();
    layers.paths.push_back({{{10.0F, 50.0F, 0.0F},
                             {30.0F, 50.0F, 0.0F},
                             {nan, nan, nan},
                             {60.0F, 50.0F, 0.0F},
                             {90.0F, 50.0F, 0.0F}},
                            red,
                            8.0F});
    const Picture picture = draw(layers, view, width, height).value();
    EXPECT_GT(pixel_at(picture, view, {20.0, 50.0, 0.0}).red, 0.8F);
    EXPECT_LT(pixel_at(picture, view, {20.0, 50.0, 0.0}).green, 0.2F);
    expect_colour(pixel_at(picture, view, {45.0, 50.0, 0.0}), {1.0F, 1.0F, 1.0F});
    EXPECT_LT(pixel_at(picture, view, {75.0, 50.0, 0.0}).green, 0.2F);
}

TEST(Draw, DrawsThePointsOfACloud) {
    scene::Scene cloud;
    cloud.points = {{30.0, 30.0, 0.0}, {70.0, 70.0, 0.0}};
    cloud.bounds = box;
    Layers layers;
    layers.map = &cloud;
    layers.map_point_radius = 10.0F;
    const View view = plan();
    const Picture picture = draw(layers, view, width, height).value();
    expect_grey(pixel_at(picture, view, cloud.points[0]));
    expect_grey(pixel_at(picture, view, cloud.points[1]));
    expect_colour(pixel_at(picture, view, {50.0, 50.0, 0.0}), {1.0F, 1.0F, 1.0F});
}

TEST(Draw, DoesNotDependOnTheNumberOfThreads) {
    std::mt19937 random(3);
    const auto mesh = test::make_freespace(test::random_contents(random, 12, 9, 40));
    const scene::Scene floor = sheet(-5.0, true);
    Layers layers = ball_in_the_middle();
    layers.map = &floor;
    layers.mesh = &mesh;
    layers.roadmap_width = 2.0F;
    const View view = overview(mesh.bounds().cast<double>(), aspect);
    Picture pictures[2];
    for (const int threads : {1, 2}) {
        tbb::task_arena arena(threads);
        arena.execute([&] { pictures[threads - 1] = draw(layers, view, width, height).value(); });
    }
    for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i) {
        ASSERT_EQ(pictures[0].pixels[i].red, pictures[1].pixels[i].red) << i;
        ASSERT_EQ(pictures[0].pixels[i].green, pictures[1].pixels[i].green) << i;
        ASSERT_EQ(pictures[0].pixels[i].blue, pictures[1].pixels[i].blue) << i;
    }
}

TEST(Draw, StopsOnRequest) {
    std::stop_source stop;
    stop.request_stop();
    const auto picture = draw(ball_in_the_middle(), plan(), width, height, {}, stop.get_token());
    ASSERT_FALSE(picture);
    EXPECT_EQ(picture.error().code, ErrorCode::interrupted);
}

}  // namespace
}  // namespace camdir::render
