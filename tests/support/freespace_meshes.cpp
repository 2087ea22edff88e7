#include "support/freespace_meshes.hpp"

#include <cmath>
#include <stdexcept>

#include "freespace/distance.hpp"

namespace camdir::test {
namespace {

using freespace::Contents;
using freespace::Vertex;

float uniform(std::mt19937& random, float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
}

Vec3f uniform_point(std::mt19937& random, const Vec3f& low, const Vec3f& high) {
    const float x = uniform(random, low.x(), high.x());
    const float y = uniform(random, low.y(), high.y());
    const float z = uniform(random, low.z(), high.z());
    return {x, y, z};
}

void add_sheet(Contents& contents, std::mt19937& random, int columns, int rows, const Vec3f& centre) {
    const auto first = static_cast<std::uint32_t>(contents.vertices.size());
    const auto width = static_cast<std::uint32_t>(columns);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float x = 20.0F * static_cast<float>(column - columns / 2) + uniform(random, -8.0F, 8.0F);
            const float y = 20.0F * static_cast<float>(row - rows / 2) + uniform(random, -8.0F, 8.0F);
            const float z = 15.0F * std::sin(x / 60.0F) + uniform(random, -3.0F, 3.0F);
            const float radius = 22.0F + 26.0F * std::sin(x / 35.0F) * std::cos(y / 50.0F);
            contents.vertices.push_back({centre.x() + x, centre.y() + y, centre.z() + z, radius});
        }
    }
    for (std::uint32_t row = 0; row + 1 < static_cast<std::uint32_t>(rows); ++row) {
        for (std::uint32_t column = 0; column + 1 < width; ++column) {
            const std::uint32_t corner = first + row * width + column;
            contents.triangles.push_back({corner, corner + 1, corner + width});
            contents.triangles.push_back({corner + 1, corner + width + 1, corner + width});
        }
    }
}

void add_loose(Contents& contents, std::mt19937& random, int count, const Vec3f& centre, float reach) {
    for (int i = 0; i < count; ++i) {
        const auto first = static_cast<std::uint32_t>(contents.vertices.size());
        const Vec3f corner =
            uniform_point(random, centre - Vec3f::Constant(reach), centre + Vec3f::Constant(reach));
        // From coincident corners over needles to large triangles.
        constexpr float sizes[] = {0.0F, 1e-3F, 1.0F, 30.0F, 150.0F};
        for (int k = 0; k < 3; ++k) {
            const float size = k == 0 ? 0.0F : sizes[random() % std::size(sizes)];
            const Vec3f p = corner + uniform_point(random, Vec3f::Constant(-size), Vec3f::Constant(size));
            contents.vertices.push_back({p.x(), p.y(), p.z(), uniform(random, -20.0F, 50.0F)});
        }
        contents.triangles.push_back({first, first + 1, first + 2});
    }
}

}  // namespace

freespace::ConvexHull box_hull(const Box3f& box) {
    freespace::ConvexHull hull{{}, box};
    for (int axis = 0; axis < 3; ++axis) {
        hull.half_spaces.push_back({Vec3f::Unit(axis), box.max()[axis]});
        hull.half_spaces.push_back({-Vec3f::Unit(axis), -box.min()[axis]});
    }
    return hull;
}

Contents empty_contents() {
    Contents contents;
    contents.metadata.map_name = "made_up";
    contents.metadata.source_name = "maps/made_up.bsp";
    contents.metadata.source_hash = 0x0123456789abcdefU;
    contents.metadata.metres_per_unit = 0.0254F;
    contents.metadata.d0 = 16.0F;
    contents.metadata.parameters = R"({"d0":16})";
    contents.metadata.counts = {{"sample", "points", 1234.0}, {"voronoi", "vertices", 5678.0}};
    contents.spawn_points = {{Vec3f(1.0F, 2.0F, 3.0F), 0.5F}, {Vec3f(-4.0F, 5.0F, -6.0F), -1.5F}};
    contents.movers = {{"*1",
                        "func_door",
                        {box_hull({Vec3f(-8.0F, -32.0F, 0.0F), Vec3f(8.0F, 32.0F, 64.0F)}),
                         box_hull({Vec3f(-4.0F, -4.0F, 64.0F), Vec3f(4.0F, 4.0F, 70.0F)})},
                        {},
                        Vec3f(200.0F, 0.0F, -16.0F)},
                       {"boulder", "", {}, {{Vec3f(0.0F, 0.0F, 24.0F), 24.0F}}}};
    contents.fixed_shots = {{Vec3f(30.0F, 20.0F, 10.0F), 0.5F, -0.2F}};
    return contents;
}

Contents square_contents() {
    Contents contents = empty_contents();
    contents.vertices = {{0, 0, 0, 40}, {100, 0, 0, 40}, {0, 100, 0, 40}, {100, 100, 0, 40}};
    contents.triangles = {{0, 1, 2}, {1, 3, 2}};
    return contents;
}

Contents random_contents(std::mt19937& random, int columns, int rows, int loose, const Vec3f& centre) {
    Contents contents = empty_contents();
    add_sheet(contents, random, columns, rows, centre);
    add_loose(contents, random, loose, centre, 10.0F * static_cast<float>(std::max(columns, rows)));
    return contents;
}

Vec3f random_point(std::mt19937& random, const freespace::Freespace& freespace) {
    const Vec3f margin = Vec3f::Constant(20.0F);
    return uniform_point(random, freespace.bounds().min() - margin, freespace.bounds().max() + margin);
}

Vec3f covered_point(std::mt19937& random, const freespace::Freespace& freespace) {
    while (true) {
        const Vec3f point = random_point(random, freespace);
        if (freespace::distance(freespace, point).covered()) return point;
    }
}

freespace::Freespace make_freespace(const Contents& contents) {
    auto freespace = freespace::Freespace::parse(freespace::encode(contents), "made-up freespace");
    if (!freespace) throw std::runtime_error(freespace.error().message);
    return *freespace;
}

}  // namespace camdir::test
