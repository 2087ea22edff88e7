// Opens the configured maps, and bakes those whose file is missing or stale.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "config/config.hpp"
#include "director/map_library.hpp"

namespace camdir::maps {

// What can be said about a map without baking it: its file opens, or its source can be read.
[[nodiscard]] Result<void> check_map(const config::Map& map);

// Works on a thread of its own, one map after the other, those first that need no baking. load and stop: one
// thread at a time.
class MapLoader {
  public:
    // `changed` is called after every change of the library, from the loader's thread or from load.
    MapLoader(director::MapLibrary& library, std::function<void()> changed)
        : library_(library), changed_(std::move(changed)) {}
    ~MapLoader() { stop(); }

    // Makes the library hold these maps: gives up what an earlier call still bakes, removes what is not
    // listed, leaves alone what is there already and whose file did not change.
    void load(const std::vector<config::Map>& maps);

    // Gives up what is being baked.
    void stop();

  private:
    // What a map was loaded from.
    struct Origin {
        config::Map map;
        std::filesystem::file_time_type written;
        std::uintmax_t size = 0;
    };

    void work(const std::stop_token& stop, const std::vector<config::Map>& maps);
    bool open_if_current(const config::Map& map);
    void bake_and_open(const config::Map& map, const std::stop_token& stop);
    void open(const config::Map& map, double bake_seconds);
    void set_failed(const config::Map& map, const Error& error);
    [[nodiscard]] bool unchanged(const config::Map& map) const;
    void remember(const config::Map& map);

    director::MapLibrary& library_;
    std::function<void()> changed_;
    std::map<std::string, Origin> loaded_;  // of the thread while it runs
    std::jthread thread_;
};

}  // namespace camdir::maps
