#include "support/shared_files.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace camdir::test {

std::optional<std::filesystem::path> shared_file(const std::string& name) {
    const char* folder = std::getenv("CAMERA_DIRECTOR_SHARED");
    if (folder == nullptr) return std::nullopt;
    const std::filesystem::path file = std::filesystem::path(folder) / name;
    return std::filesystem::exists(file) ? std::optional(file) : std::nullopt;
}

std::string needs_shared_file(const std::string& name) {
    return "needs $CAMERA_DIRECTOR_SHARED/" + name;
}

std::vector<Vec3d> way_points(const std::filesystem::path& file) {
    std::ifstream lines(file);
    std::vector<Vec3d> points;
    for (std::string line; std::getline(lines, line);) {
        if (!line.starts_with("origin = '")) continue;
        std::istringstream numbers(line.substr(10));
        Vec3d point;
        if (numbers >> point.x() >> point.y() >> point.z()) points.push_back(point);
    }
    return points;
}

}  // namespace camdir::test
