#include "support/openarena.hpp"

#include <filesystem>

namespace camdir::test {

std::optional<std::string> openarena_map(const std::string& name) {
    const std::filesystem::path folder = "/usr/share/games/openarena/baseoa";
    const auto archive = folder / (name == "aggressor" ? "pak6-patch088.pk3" : "pak1-maps.pk3");
    if (!std::filesystem::exists(archive)) return std::nullopt;
    return archive.string() + ":maps/" + name + ".bsp";
}

std::string needs_openarena_map(const std::string& name) {
    return name == "aggressor" ? "needs the package openarena-088-data"
                               : "needs the package openarena-081-maps";
}

const std::vector<std::string>& traced_maps() {
    static const std::vector<std::string> maps = {"oa_dm1", "oa_dm3", "oa_rpg3dm2", "aggressor"};
    return maps;
}

}  // namespace camdir::test
