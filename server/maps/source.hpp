// Reads a map's source with the options of a configuration or of a baked file.
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

// `x,y,z`, finite numbers.
[[nodiscard]] std::optional<Vec3d> parse_point(std::string_view text);

// The options of a configured map. Errors name the key.
[[nodiscard]] Result<scene::ReadOptions> read_options_of(const config::Map& map);

// Those that a file was baked with; what its baker did not write is as by default.
[[nodiscard]] scene::ReadOptions read_options_of(const freespace::Metadata& metadata);

// Reads the source of a configured map.
[[nodiscard]] Result<scene::Scene> load_source(const config::Map& map);

// Reads the source with the options of the bake; fails when its unit differs. A source without spawn points
// gets those of the baked file.
[[nodiscard]] Result<scene::Scene> load_source(const freespace::Freespace& baked, const std::string& map);

}  // namespace camdir::maps
