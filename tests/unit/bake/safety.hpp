// What every baked mesh must keep to, whole or reduced.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "bake/geometry/certificate.hpp"
#include "freespace/freespace.hpp"
#include "support/solid_scenes.hpp"

namespace camdir::bake {

inline std::vector<Slab> slabs_of(const freespace::Contents& contents) {
    const auto at = [&](std::uint32_t v) -> Vec3d { return contents.vertices[v].position().cast<double>(); };
    const auto r = [&](std::uint32_t v) -> double { return contents.vertices[v].free_distance; };
    std::vector<Slab> slabs;
    for (const auto& [a, b, c] : contents.triangles)
        slabs.push_back({{at(a), at(b), at(c)}, {r(a), r(b), r(c)}});
    return slabs;
}

// Draws balls from every slab and compares them with the scene's closed form.
inline void expect_safe(const test::SolidScene& scene, const freespace::Contents& contents) {
    std::mt19937 random(17);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (const freespace::Triangle& t : contents.triangles) {
        const freespace::Vertex& a = contents.vertices[t.a];
        const freespace::Vertex& b = contents.vertices[t.b];
        const freespace::Vertex& c = contents.vertices[t.c];
        ASSERT_GT(std::max({a.free_distance, b.free_distance, c.free_distance}), 0.0F);
        for (int i = 0; i < 20; ++i) {
            const double u = unit(random);
            const double v = unit(random) * (1.0 - u);
            const Vec3d m = (1.0 - u - v) * a.position().cast<double>() + u * b.position().cast<double>() +
                            v * c.position().cast<double>();
            const double r = (1.0 - u - v) * a.free_distance + u * b.free_distance + v * c.free_distance;
            ASSERT_LE(r, scene.clearance(m) + 1e-9);
            ASSERT_TRUE(r <= 0.0 || scene.scene().bounds.contains(m));
        }
    }
}

}  // namespace camdir::bake
