#include "map_sources.hpp"

#include <zip.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <memory>
#include <stdexcept>
#include <string_view>

namespace camdir::bench {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 10> map_extensions = {".bsp", ".obj", ".ply", ".stl", ".gltf",
                                                             ".glb", ".pcd", ".xyz", ".pts", ".las"};

std::string extension_of(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return extension;
}

std::vector<MapSource> members_of(const fs::path& archive) {
    const std::unique_ptr<zip_t, decltype(&zip_discard)> zip(::zip_open(archive.c_str(), ZIP_RDONLY, nullptr),
                                                             &::zip_discard);
    if (!zip) throw std::runtime_error(archive.string() + ": cannot be read as a zip archive");
    std::vector<MapSource> maps;
    const zip_int64_t count = ::zip_get_num_entries(zip.get(), 0);
    for (zip_int64_t i = 0; i < count; ++i) {
        const char* name = ::zip_get_name(zip.get(), static_cast<zip_uint64_t>(i), 0);
        if (name == nullptr) throw std::runtime_error(archive.string() + ": is damaged");
        const fs::path member(name);
        if (extension_of(member) != ".bsp") continue;
        maps.push_back({member.stem().string(), archive.string() + ":" + member.string()});
    }
    return maps;
}

std::vector<MapSource> maps_of_file(const fs::path& file) {
    if (extension_of(file) == ".pk3") return members_of(file);
    return {{file.stem().string(), file.string()}};
}

bool may_hold_maps(const fs::path& file) {
    const std::string extension = extension_of(file);
    return extension == ".pk3" ||
           std::find(map_extensions.begin(), map_extensions.end(), extension) != map_extensions.end();
}

}  // namespace

std::vector<MapSource> maps_of(const fs::path& path) {
    std::vector<MapSource> maps;
    if (fs::is_directory(path)) {
        for (const auto& entry : fs::directory_iterator(path)) {
            if (!entry.is_regular_file() || !may_hold_maps(entry.path())) continue;
            const std::vector<MapSource> more = maps_of_file(entry.path());
            maps.insert(maps.end(), more.begin(), more.end());
        }
    } else if (fs::exists(path)) {
        maps = maps_of_file(path);
    } else {
        throw std::runtime_error(path.string() + ": no such file or folder");
    }
    std::sort(maps.begin(), maps.end(),
              [](const MapSource& a, const MapSource& b) { return a.source < b.source; });
    return maps;
}

}  // namespace camdir::bench
