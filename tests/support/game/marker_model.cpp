#include "support/game/marker_model.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <map>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::test {
namespace {

struct Triangles {
    std::vector<Vec3d> points;
    std::vector<std::array<std::int32_t, 3>> corners;
};

// An octahedron, divided until its faces deviate from the sphere by less than 1 % of the radius.
Triangles ball(double radius) {
    Triangles result;
    for (int axis = 0; axis < 3; ++axis) {
        result.points.emplace_back(Vec3d::Unit(axis));
        result.points.emplace_back(-Vec3d::Unit(axis));
    }
    for (const int x : {0, 1})
        for (const int y : {2, 3})
            for (const int z : {4, 5})
                result.corners.push_back({x, y, z});
    for (int division = 0; division < 3; ++division) {
        std::map<std::pair<int, int>, int> middles;
        const auto middle = [&](int a, int b) {
            const auto [found, added] =
                middles.try_emplace(std::minmax(a, b), static_cast<int>(result.points.size()));
            if (added) result.points.push_back((result.points[a] + result.points[b]).normalized());
            return found->second;
        };
        std::vector<std::array<std::int32_t, 3>> smaller;
        for (const auto& [a, b, c] : result.corners) {
            const int ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            smaller.insert(smaller.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
        }
        result.corners = std::move(smaller);
    }
    for (Vec3d& point : result.points)
        point *= radius;
    return result;
}

class Bytes {
  public:
    void put(std::int32_t value) { append(&value, sizeof value); }
    void put(std::int16_t value) { append(&value, sizeof value); }
    void put(float value) { append(&value, sizeof value); }
    void put(const Vec3d& value) {
        for (const double x : value)
            put(static_cast<float>(x));
    }
    void put(const std::string& text, std::size_t size) {
        std::string padded = text;
        padded.resize(size);
        append(padded.data(), size);
    }
    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    void append(const void* data, std::size_t size) { bytes_.append(static_cast<const char*>(data), size); }

    std::string bytes_;
};

// A model of one frame and one surface in Quake 3's format. The tags' zero axes shrink what is attached to
// them, such as the weapon, to a point.
void write_md3(const std::filesystem::path& file, const std::string& surface, const Triangles& triangles,
               const std::vector<std::string>& tags) {
    const auto points = static_cast<std::int32_t>(triangles.points.size());
    const auto corners = static_cast<std::int32_t>(triangles.corners.size());
    constexpr std::int32_t header_size = 108, frame_size = 56, tag_size = 112, shader_size = 68;
    constexpr std::int32_t surface_header_size = 108;
    const auto tags_at = header_size + frame_size;
    const auto surface_at = tags_at + tag_size * static_cast<std::int32_t>(tags.size());
    const auto shaders_at = surface_header_size + 12 * corners;
    const auto texture_at = shaders_at + shader_size;
    const auto points_at = texture_at + 8 * points;
    const auto surface_size = points_at + 8 * points;
    double radius = 0.0;
    for (const Vec3d& point : triangles.points)
        radius = std::max(radius, point.norm());

    Bytes out;
    out.put("IDP3", 4);
    out.put(15);
    out.put(file.filename().string(), 64);
    out.put(0);
    out.put(1);
    out.put(static_cast<std::int32_t>(tags.size()));
    out.put(1);
    out.put(0);
    out.put(header_size);
    out.put(tags_at);
    out.put(surface_at);
    out.put(surface_at + surface_size);

    out.put(Vec3d::Constant(-radius));
    out.put(Vec3d::Constant(radius));
    out.put(Vec3d::Zero());
    out.put(static_cast<float>(radius));
    out.put("", 16);
    for (const std::string& tag : tags) {
        out.put(tag, 64);
        for (int row = 0; row < 4; ++row)
            out.put(Vec3d::Zero());
    }

    out.put("IDP3", 4);
    out.put(surface, 64);
    for (const std::int32_t value :
         {0, 1, 1, points, corners, surface_header_size, shaders_at, texture_at, points_at, surface_size}) {
        out.put(value);
    }
    for (const auto& triangle : triangles.corners)
        for (const std::int32_t corner : triangle)
            out.put(corner);
    out.put("marker", 64);
    out.put(0);
    for (std::int32_t i = 0; i < 2 * points; ++i)
        out.put(0.0F);
    for (const Vec3d& point : triangles.points) {
        for (const double x : point)
            out.put(static_cast<std::int16_t>(std::lround(64.0 * x)));
        out.put(std::int16_t{0});
    }
    std::ofstream(file, std::ios::binary) << out.bytes();
}

}  // namespace

void write_marker_model(const std::filesystem::path& folder) {
    const auto model = folder / "models/players/penguin";
    std::filesystem::create_directories(model);
    std::filesystem::create_directories(folder / "scripts");
    const Triangles nothing = {{Vec3d::Zero(), Vec3d::Zero(), Vec3d::Zero()}, {{0, 1, 2}}};
    write_md3(model / "lower.md3", "l_ball", ball(marker_radius), {"tag_torso"});
    write_md3(model / "upper.md3", "u_nothing", nothing, {"tag_torso", "tag_head", "tag_weapon"});
    write_md3(model / "head.md3", "h_nothing", nothing, {"tag_head"});
    std::ofstream(model / "lower_default.skin") << "l_ball,marker\n";
    std::ofstream(model / "upper_default.skin") << "u_nothing,marker\n";
    std::ofstream(model / "head_default.skin") << "h_nothing,marker\n";
    std::ofstream animations(model / "animation.cfg");
    animations << "sex m\n";
    for (int animation = 0; animation < 25; ++animation)
        animations << "0 1 0 15\n";
    std::ofstream(folder / "scripts/marker.shader")
        << "marker\n{\n    cull disable\n    {\n        map $whiteimage\n"
           "        rgbGen const ( 1 0 1 )\n    }\n}\n";
}

}  // namespace camdir::test
