// Which maps there are to measure.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace camdir::bench {

struct MapSource {
    std::string name;
    std::string source;  // as `bake` takes it
};

// A folder's maps, an archive's, or the one map that the path is; by name. Throws std::runtime_error when the
// path cannot be read.
[[nodiscard]] std::vector<MapSource> maps_of(const std::filesystem::path& path);

}  // namespace camdir::bench
