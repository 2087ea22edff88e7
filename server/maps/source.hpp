// How the commands say, and remember, the way in which a map's source is read.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "config/config.hpp"
#include "freespace/freespace.hpp"
#include "scene/read_options.hpp"
#include "scene/scene.hpp"

namespace camdir::maps {

// `x,y,z`; finite.
[[nodiscard]] std::optional<Vec3d> parse_point(std::string_view text);

// `y` or `z`.
[[nodiscard]] std::optional<scene::UpAxis> parse_up(std::string_view name);

// Those of a configured map. Errors name the key.
[[nodiscard]] Result<scene::ReadOptions> read_options_of(const config::Map& map);

// Those that a file was baked with; what its baker did not write is as by default.
[[nodiscard]] scene::ReadOptions read_options_of(const freespace::Metadata& metadata);

// Reads the source of a configured map.
[[nodiscard]] Result<scene::Scene> load_source(const config::Map& map);

// Reads the source as it was read for the bake; fails when its unit is another one. A source without spawn
// points gets those of the file: the place that the bake chose.
[[nodiscard]] Result<scene::Scene> load_source(const freespace::Freespace& baked, const std::string& map);

}  // namespace camdir::maps
