// Opens the configured maps, and bakes those whose file is missing or stale.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "base/error.hpp"
#include "config/config.hpp"
#include "freespace/freespace.hpp"

namespace camdir::maps {

// What can be checked without baking: the map's file opens, or there is a source to bake it from and options
// for it that are right.
[[nodiscard]] Result<void> check_map(const config::Map& map);

// Receives the state of each map; all are set. Called from load() and from the loader's thread, never from
// both at once.
struct LoaderSink {
    std::function<void(const config::Map& map)> added;  // new or changed: will be loaded
    std::function<void(const std::string& map)> removed;
    std::function<void(const std::string& map, const std::string& activity)> loading;
    // `bake_seconds` is 0 when the file was up to date.
    std::function<void(const std::string& map, freespace::Freespace, double bake_seconds)> ready;
    std::function<void(const std::string& map, const std::string& reason)> failed;
};

// Works on its own thread, one map after the other, those that need no bake first. load and stop: one thread
// at a time.
class Loader {
  public:
    explicit Loader(LoaderSink sink) : sink_(std::move(sink)) {}
    ~Loader() { stop(); }

    // Replaces the list of maps: stops the bake of an earlier call, removes maps that are no longer listed,
    // and skips those that are loaded and whose entry and file did not change.
    void load(const std::vector<config::Map>& maps);

    // Stops the running bake; maps that are not loaded yet stay so.
    void stop();

  private:
    struct FileState {
        std::filesystem::file_time_type written;
        std::uintmax_t size = 0;

        bool operator==(const FileState&) const = default;
    };
    // What a loaded map was read from.
    struct LoadedFile {
        config::Map map;
        std::optional<FileState> file;
    };

    void run(const std::stop_token& stop, const std::vector<config::Map>& maps);
    bool open_if_current(const config::Map& map);
    void bake_and_open(const config::Map& map, const std::stop_token& stop);
    void open(const config::Map& map, double bake_seconds);
    void set_failed(const config::Map& map, const Error& error);
    [[nodiscard]] bool is_unchanged(const config::Map& map) const;
    // None: it cannot be told.
    [[nodiscard]] static std::optional<FileState> state_of(const std::string& file);

    const LoaderSink sink_;
    std::set<std::string> listed_;
    std::map<std::string, LoadedFile> loaded_;  // of the thread while it runs
    std::jthread thread_;
};

}  // namespace camdir::maps
