// Small Quake and GoldSrc maps made up for tests: no data of real maps is kept in the repository.
#pragma once

#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/geometry.hpp"
#include "scene/quake/bsp.hpp"
#include "scene/scene.hpp"

namespace camdir::test {

struct QuakeBox {
    Box3d box;
    std::string texture = "stone";
    std::int32_t contents = scene::quake::solid;
};

struct QuakeEntity {
    std::string class_name;
    Vec3d origin = Vec3d::Zero();
    std::vector<QuakeBox> boxes;  // with boxes it has a brush model
};

// A room in solid rock, with boxes that must not overlap and keep off its walls.
struct QuakeMap {
    std::int32_t version = scene::quake::version_goldsrc;
    Box3d room;
    std::vector<QuakeBox> boxes;
    std::vector<QuakeEntity> entities;
    std::string wall_texture = "stone";
};

// Lumps as a compiler would write them: a tree that parts the space, faces that share no edge, half of their
// edges given against their direction.
[[nodiscard]] scene::quake::Bsp bsp_of(const QuakeMap& map);

[[nodiscard]] Bytes encode(const scene::quake::Bsp& bsp);

// read_quake_scene of the encoded map; a failure throws.
[[nodiscard]] scene::Scene scene_of(const QuakeMap& map);

}  // namespace camdir::test
