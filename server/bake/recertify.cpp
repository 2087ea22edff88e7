#include "bake/recertify.hpp"

#include <array>
#include <atomic>
#include <sstream>

#include "bake/geometry/certificate.hpp"

namespace camdir::bake {
namespace {

Slab slab_of(const freespace::Contents& contents, const freespace::Triangle& triangle, double offset) {
    const std::array<std::uint32_t, 3> ids{triangle.a, triangle.b, triangle.c};
    Triangle3d corners;
    std::array<double, 3> radii{};
    for (std::size_t i = 0; i < 3; ++i) {
        const freespace::Vertex& vertex = contents.vertices[ids[i]];
        corners[i] = vertex.position().cast<double>();
        radii[i] = static_cast<double>(vertex.free_distance) + offset;
    }
    return {corners, radii};
}

tl::unexpected<Error> violation(const Slab& slab, const SignedGap& gap, std::uint64_t triangle,
                                const std::string& source) {
    Vec3d centre = Vec3d::Zero();
    for (std::size_t i = 0; i < 3; ++i)
        centre += gap.weights[i] * slab.corners()[i];
    std::ostringstream text;
    text << source << ": triangle " << triangle << " of the baked mesh reaches " << -gap.value
         << " map units into an obstacle near (" << centre.x() << ", " << centre.y() << ", " << centre.z()
         << "); expected none: this is a defect of the baker, nothing is written; --loss 0 may avoid it";
    return fail(text.str());
}

}  // namespace

Result<void> recertify(const freespace::Contents& contents, const Obstacles& obstacles, double offset,
                       double tolerance, const std::string& source, Stage& stage) {
    const auto gap = [&](std::uint64_t i) {
        return signed_gap(slab_of(contents, contents.triangles[i], offset), obstacles, 0.0);
    };
    std::atomic<std::uint64_t> first{contents.triangles.size()};  // the violated one with the lowest number
    const bool done = stage.for_each(contents.triangles.size(), [&](std::uint64_t i) {
        if (gap(i).value >= -tolerance) return;
        std::uint64_t lowest = first;
        while (i < lowest && !first.compare_exchange_weak(lowest, i)) {
        }
    });
    if (!done) return stage.interrupted();
    if (first == contents.triangles.size()) return {};
    return violation(slab_of(contents, contents.triangles[first], offset), gap(first), first, source);
}

}  // namespace camdir::bake
