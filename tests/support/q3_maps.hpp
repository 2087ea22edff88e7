// Small Quake 3 maps made up for tests: no data of real maps is kept in the repository.
#pragma once

#include <random>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/geometry.hpp"
#include "scene/quake3/bsp.hpp"
#include "scene/scene.hpp"

namespace camdir::test {

namespace q3 = scene::q3;

// Numbers of the shaders in every map made here.
enum Shader : std::int32_t { stone = 0, sky, clip, water, ghost };

// The bytes of a BSP file with these lumps.
[[nodiscard]] Bytes encode(const q3::Bsp& bsp);

// The bytes of a zip archive that holds one stored or deflated member.
[[nodiscard]] Bytes zip_of(const std::string& member, const Bytes& content);

// A world without brushes: all space in one playable leaf.
[[nodiscard]] q3::Bsp empty_map();

// Appends to the model that was added last.
void add_brush(q3::Bsp& bsp, const std::vector<scene::Plane>& planes, Shader shader);
void add_box(q3::Bsp& bsp, const Box3d& box, Shader shader);
void add_patch(q3::Bsp& bsp, int width, int height, const std::vector<Vec3d>& points, Shader shader);
void add_soup(q3::Bsp& bsp, const std::vector<Vec3d>& corners, Shader shader);
// Starts a further model and appends an entity with it.
void add_entity_model(q3::Bsp& bsp, const std::string& class_name, const Vec3d& origin);
void add_spawn_point(q3::Bsp& bsp, const Vec3d& origin,
                     const std::string& class_name = "info_player_deathmatch");

// Six walls, 16 thick, around the box `inside`; what lies beyond is the void: a leaf of cluster -1.
[[nodiscard]] q3::Bsp room_map(const Box3d& inside);

// A room with boxes, wedges, a patch and a soup at random, and one spawn point that is free.
[[nodiscard]] q3::Bsp random_map(std::mt19937& random, int obstacles);

// read_q3_scene of the encoded map; a failure throws.
[[nodiscard]] scene::Scene scene_of(const q3::Bsp& bsp);

[[nodiscard]] Vec3d random_point_in(std::mt19937& random, const Box3d& box);

}  // namespace camdir::test
