// What a page draws of a map beside its models.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "freespace/freespace.hpp"

namespace camdir::live {

// `name`, `kind`, `hulls` as lists of half spaces [x, y, z, distance], `balls` as [x, y, z, radius]: as
// idl/live.md has a mover.
[[nodiscard]] nlohmann::ordered_json mover_json(const freespace::MoverShape& mover);

// The map's fixed cameras and its movers, of idl/live.md, as JSON.
[[nodiscard]] std::string map_contents(const freespace::Freespace& map);

}  // namespace camdir::live
