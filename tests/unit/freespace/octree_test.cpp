// The queries' index against every slab.
#include "freespace/slab_octree.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "support/freespace_meshes.hpp"
#include "support/freespace_twins.hpp"

namespace camdir::freespace {
namespace {

using test::make_freespace;
using test::random_contents;
using test::random_point;

// The value of a slab's point, recomputed in double precision.
double value_at(const SlabOctree& octree, const SlabPoint& found, const Vec3f& point) {
    const Ball ball = octree.ball(found);
    return ball.radius - (point.cast<double>() - ball.centre).norm();
}

TEST(SlabOctree, FindsTheBestOfAllSlabs) {
    for (unsigned seed = 1; seed <= 5; ++seed) {
        for (const float cell : {4.0F, 32.0F, 1'000.0F}) {
            SCOPED_TRACE(testing::Message() << "seed " << seed << ", cells of " << cell);
            std::mt19937 random(seed);
            const Freespace freespace = make_freespace(random_contents(random, 14, 12, 80));
            const SlabOctree octree(freespace.vertices(), freespace.triangles(), cell);
            const double tolerance = 1e-6 * freespace.bounds().diagonal().norm();
            for (int i = 0; i < 20; ++i) {
                const Vec3f point = random_point(random, freespace);
                const double exact = test::exact_distance(freespace, point.cast<double>());
                const SlabPoint found = octree.best(point);
                if (found.triangle == none) {
                    ASSERT_LE(exact, tolerance) << point.transpose();
                    continue;
                }
                ASSERT_NEAR(value_at(octree, found, point), exact, tolerance) << point.transpose();
                ASSERT_NEAR(found.value, exact, 10.0 * tolerance) << point.transpose();
            }
        }
    }
}

TEST(SlabOctree, FindsNothingThatIsNotAboveTheLeast) {
    std::mt19937 random(6);
    const Freespace freespace = make_freespace(random_contents(random, 14, 12, 80));
    for (int i = 0; i < 2'000; ++i) {
        const Vec3f point = random_point(random, freespace);
        const SlabPoint best = freespace.octree().best(point);
        const float least = 60.0F * static_cast<float>(random()) / 4294967296.0F;
        const SlabPoint found = freespace.octree().best(point, least);
        ASSERT_EQ(found.triangle != none, best.value > least);
        ASSERT_TRUE(found.triangle == none || found.value == best.value);
    }
}

// Triangles of every shape and size, down to points, with free distances that may rise faster than the way.
TEST(SlabOctree, IsExactForEveryShapeOfTriangle) {
    std::mt19937 random(7);
    const auto uniform = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    constexpr std::array<float, 6> sizes{0.0F, 1e-20F, 1e-3F, 1.0F, 30.0F, 500.0F};
    for (int i = 0; i < 1'500; ++i) {
        Contents contents = test::empty_contents();
        const Vec3f corner(uniform(-200, 200), uniform(-200, 200), uniform(-200, 200));
        Vec3f along = Vec3f::Zero();
        for (int k = 0; k < 3; ++k) {
            const float size = k == 0 ? 0.0F : sizes[random() % sizes.size()];
            Vec3f offset(uniform(-size, size), uniform(-size, size), uniform(-size, size));
            if (i % 5 == 0 && k == 2) offset = uniform(-1.0F, 2.0F) * along;  // on one line
            along = offset;
            const Vec3f p =
                i % 7 == 0 ? offset : Vec3f(corner + offset);  // sizes below the coordinates' rounding
            contents.vertices.push_back({p.x(), p.y(), p.z(), uniform(-20.0F, 60.0F)});
        }
        contents.triangles = {{0, 1, 2}};
        const Freespace freespace = make_freespace(contents);
        for (int k = 0; k < 8; ++k) {
            Vec3f point = freespace.vertices()[k % 3].position();
            if (k >= 3) point += Vec3f(uniform(-40, 40), uniform(-40, 40), uniform(-40, 40));
            const double exact = test::exact_distance(freespace, point.cast<double>());
            const SlabPoint found = freespace.octree().best(point);
            const double tolerance = 2e-6 * (200.0 + freespace.bounds().diagonal().norm());
            const double value = found.triangle == none ? 0.0 : value_at(freespace.octree(), found, point);
            ASSERT_NEAR(value, std::max(exact, 0.0), tolerance) << "triangle " << i << ", point " << k;
        }
    }
}

// Long triangles, down to heights that coordinates hardly resolve, with free distances that rise nearly as
// fast as the way.
TEST(SlabOctree, IsExactForNeedles) {
    std::mt19937 random(9);
    std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
    const auto direction = [&] { return Vec3f(unit(random), unit(random), unit(random)).normalized(); };
    for (int i = 0; i < 300; ++i) {
        Contents contents = test::empty_contents();
        for (std::uint32_t k = 0; k < 6; ++k) {
            const Vec3f corner = 100.0F * direction();
            const Vec3f along = 500.0F * direction();
            const Vec3f side =
                along.cross(direction()).normalized() * 500.0F * std::pow(10.0F, 4.0F * unit(random) - 4.0F);
            const float slope = 0.2F * unit(random) + (i % 3 == 0 ? 0.8F : 0.0F);
            for (const Vec3f& p :
                 {corner, Vec3f(corner + along), Vec3f(corner + 0.5F * (1.0F + unit(random)) * along + side)})
                contents.vertices.push_back(
                    {p.x(), p.y(), p.z(),
                     20.0F + slope * (p - corner).dot(along) / 500.0F + 0.9F * side.norm() * unit(random)});
            contents.triangles.push_back({3 * k, 3 * k + 1, 3 * k + 2});
        }
        const Freespace freespace = make_freespace(contents);
        for (int k = 0; k < 10; ++k) {
            const Vec3f point = 0.5F * (freespace.vertices()[random() % 18].position() +
                                        freespace.vertices()[random() % 18].position()) +
                                10.0F * direction();
            const double exact = test::exact_distance(freespace, point.cast<double>());
            const SlabPoint found = freespace.octree().best(point);
            const double value = found.triangle == none ? 0.0 : value_at(freespace.octree(), found, point);
            ASSERT_NEAR(value, std::max(exact, 0.0), 2e-3) << "mesh " << i << ", point " << k;
        }
    }
}

TEST(SlabOctree, IsExactForCoincidentSlabs) {
    std::mt19937 random(10);
    Contents contents = random_contents(random, 6, 6, 20);
    const Freespace single = make_freespace(contents);
    const std::size_t vertex_count = contents.vertices.size();
    const std::size_t triangle_count = contents.triangles.size();
    for (std::uint32_t copy = 1; copy < 60; ++copy) {
        const auto shift = static_cast<std::uint32_t>(copy * vertex_count);
        for (std::size_t i = 0; i < vertex_count; ++i)
            contents.vertices.push_back(contents.vertices[i]);
        for (std::size_t i = 0; i < triangle_count; ++i) {
            const auto [a, b, c] = contents.triangles[i];
            contents.triangles.push_back({a + shift, b + shift, c + shift});
        }
    }
    const Freespace freespace = make_freespace(contents);
    EXPECT_LT(freespace.octree().memory(), freespace.triangles().size() << 9U);
    for (int i = 0; i < 40; ++i) {
        const Vec3f point = random_point(random, freespace);
        const double exact = test::exact_distance(single, point.cast<double>());
        const SlabPoint found = freespace.octree().best(point);
        const double value = found.triangle == none ? 0.0 : value_at(freespace.octree(), found, point);
        ASSERT_NEAR(value, std::max(exact, 0.0), 1e-3) << point.transpose();
    }
}

// As exact as floats are there.
TEST(SlabOctree, IsExactFarFromTheOrigin) {
    for (const float far : {1e4F, 1e6F, 5e7F}) {
        SCOPED_TRACE(testing::Message() << "at " << far);
        std::mt19937 random(11);
        const Freespace freespace =
            make_freespace(random_contents(random, 10, 10, 30, {far, -far, 0.5F * far}));
        for (int i = 0; i < 60; ++i) {
            const Vec3f point = random_point(random, freespace);
            const double exact = test::exact_distance(freespace, point.cast<double>());
            const SlabPoint found = freespace.octree().best(point);
            const double value = found.triangle == none ? 0.0 : value_at(freespace.octree(), found, point);
            ASSERT_NEAR(value, std::max(exact, 0.0), 1e-3 + 1e-6 * far) << point.transpose();
        }
    }
}

TEST(SlabOctree, StandsWhateverAFileMayHold) {
    std::mt19937 random(8);
    constexpr std::array<float, 8> numbers{0.0F,  1e-45F, -1e-30F,          1.0F,
                                           -3.0F, 1e4F,   coordinate_limit, -coordinate_limit};
    const auto number = [&] { return numbers[random() % numbers.size()]; };
    for (int i = 0; i < 300; ++i) {
        const float cell = i % 3 == 0 ? 1e-30F : i % 3 == 1 ? 64.0F : 4.0F * coordinate_limit;
        std::vector<Vertex> vertices;
        for (int k = 0; k < 30; ++k)
            vertices.push_back({number(), number(), number(), number()});
        std::vector<Triangle> triangles;
        for (std::uint32_t k = 0; k < 60; ++k) {
            const auto a = static_cast<std::uint32_t>(random() % 30);
            triangles.push_back({a, (a + 1 + k % 5) % 30, (a + 6 + k % 6) % 30});
        }
        const SlabOctree octree(vertices, triangles, cell);
        EXPECT_LT(octree.memory(), 4U << 20U);
        for (int k = 0; k < 40; ++k) {
            const Vec3f point(number(), number(), number());
            const SlabPoint found = octree.best(point);
            ASSERT_FALSE(std::isnan(found.value));
            ASSERT_TRUE(found.triangle == none || !std::isnan(value_at(octree, found, point)));
        }
    }
}

TEST(SlabOctree, WithoutTrianglesHoldsNothing) {
    EXPECT_EQ(SlabOctree().best({1, 2, 3}).triangle, none);
    EXPECT_EQ(SlabOctree({}, {}, 16.0F).best({1, 2, 3}).triangle, none);
}

}  // namespace
}  // namespace camdir::freespace
