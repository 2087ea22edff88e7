// Files that are not part of the project, in the folder that CAMERA_DIRECTOR_SHARED names.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::test {

// None when the variable is not set or the file is missing: skip with needs_shared_file() then.
[[nodiscard]] std::optional<std::filesystem::path> shared_file(const std::string& name);

// The message of a skipped test; deploy/test.sh collects the lines that begin with "needs ".
[[nodiscard]] std::string needs_shared_file(const std::string& name);

// Where the bots of a map walk: the origins in a .way file.
[[nodiscard]] std::vector<Vec3d> way_points(const std::filesystem::path& file);

}  // namespace camdir::test
