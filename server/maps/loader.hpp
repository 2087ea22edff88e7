// Opens the configured maps, and bakes those whose file is missing or stale.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <stop_token>
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

// Receives the state of each map; all are set. Called from the loader's threads, by one at a time, which
// waits for it: it must not call load() or stop().
struct LoaderSink {
    std::function<void(const config::Map& map)> added;  // new or changed: will be loaded
    std::function<void(const std::string& map)> removed;
    std::function<void(const std::string& map, const std::string& activity)> loading;
    // `bake_seconds` is 0 when the file was up to date.
    std::function<void(const std::string& map, freespace::Freespace, double bake_seconds)> ready;
    std::function<void(const std::string& map, const std::string& reason)> failed;
};

// Opens maps on a thread of its own, one after the other, and bakes on another what must be baked. load and
// stop: one thread at a time.
class Loader {
  public:
    explicit Loader(LoaderSink sink) : sink_(std::move(sink)) {}
    ~Loader() { stop(); }

    // Replaces the list of maps, and returns at once. Those that are no longer listed are removed, and those
    // are skipped that are loaded and whose entry, file and source did not change. A bake goes on whose map's
    // entry and source did not change, unless somebody has put its result in place; what else an earlier call
    // has begun is stopped.
    void load(std::vector<config::Map> maps);

    // From load() on until it is known which maps must be baked, also of those that are loaded. Thread-safe.
    [[nodiscard]] bool is_examining() const { return examining_; }

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

    struct Bake {
        config::Map map;
        // Of what is baked; nothing: not read yet; 0: it could not be read.
        std::optional<std::uint64_t> source_hash;
        std::stop_source stop;
        bool is_in_place = false;  // what was baked: it is being opened
    };

    // What is to be done for a list of maps.
    struct Work {
        std::vector<config::Map> changed;    // to be loaded
        std::vector<config::Map> unchanged;  // loaded, with the same entry and file
        std::optional<Bake> kept;            // goes on
    };

    void open_lists(const std::stop_token& stop);
    void open_list(const std::vector<config::Map>& maps, const std::stop_token& stop);
    // None: stopped.
    [[nodiscard]] std::optional<Work> begin(const std::vector<config::Map>& maps,
                                            const std::stop_token& stop);
    [[nodiscard]] bool goes_on(const Bake& kept);
    void want_bakes(const std::vector<config::Map>& maps, const std::stop_token& stop);
    void wait_for_stopped_bake(const std::string& file, const std::stop_token& stop);
    bool open_if_current(const config::Map& map);
    bool begins_anew(const config::Map& map);
    void bake_all(const std::stop_token& stop);
    void note_source_hash(const config::Map& map);
    void bake_and_open(const config::Map& map, const std::stop_token& stop);
    void open(const config::Map& map, double bake_seconds, const std::stop_token& stop);
    void set_failed(const config::Map& map, const Error& error, const std::stop_token& stop);
    template <class Tell>
    void unless_stopped(const std::stop_token& stop, const Tell& tell);
    // With the mutex held.
    [[nodiscard]] std::optional<Bake> keep_bake(const std::vector<config::Map>& maps);
    void remove_unlisted(const std::vector<config::Map>& maps);
    [[nodiscard]] bool is_unchanged(const config::Map& map, const std::optional<FileState>& file) const;
    // None: it cannot be told.
    [[nodiscard]] static std::optional<FileState> state_of(const std::string& file);

    const LoaderSink sink_;
    std::jthread opener_;
    std::jthread baker_;

    // Of what follows, and of calls of the sink. No file is looked at with it held.
    std::mutex mutex_;
    std::set<std::string> listed_;
    std::map<std::string, LoadedFile> loaded_;
    std::optional<std::vector<config::Map>> to_open_;  // the newest list, until it is begun
    std::stop_source opening_;                         // of the list that was begun last
    std::deque<config::Map> to_bake_;
    std::optional<Bake> baking_;
    std::condition_variable_any wanted_;  // to_open_ or to_bake_ has changed, or whether a bake runs
    std::atomic<bool> examining_{false};  // set with the mutex held
};

}  // namespace camdir::maps
