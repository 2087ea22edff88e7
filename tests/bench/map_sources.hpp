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

// The maps in a folder or an archive, or the one map file, in the order of their names. Throws
// std::runtime_error when the path cannot be read.
[[nodiscard]] std::vector<MapSource> maps_of(const std::filesystem::path& path);

}  // namespace camdir::bench
