// Arbitrary bytes as a point cloud of every format: a scene that keeps its promises, or an error of one line.
#include <cstdint>
#include <cstdlib>
#include <span>

#include "scene/cloud/read_scene.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using camdir::scene::CloudFormat;
    const auto bytes = std::as_bytes(std::span(data, size));
    for (const auto format : {CloudFormat::pcd, CloudFormat::ply, CloudFormat::xyz, CloudFormat::las}) {
        const auto scene = camdir::scene::read_cloud_scene(bytes, format, {});
        if (!scene) {
            if (scene.error().message.empty()) std::abort();
            continue;
        }
        for (const camdir::Vec3d& point : scene->points)
            if (!scene->bounds.contains(point)) std::abort();
        if (!(scene->point_spacing > 0.0) || scene->points.empty()) std::abort();
    }
    return 0;
}
