// The maps that the director knows, and whether they can be used.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "freespace/freespace.hpp"

namespace camdir::director {

enum class LoadState { loading, ready, failed };

struct MapEntry {
    LoadState state = LoadState::loading;
    std::string reason;            // why it failed, or what it waits for
    bool strict = false;           // refuse game servers whose map file differs from the baked one
    double bake_seconds = 0.0;     // of the bake by this process; 0 = none
    std::uint64_t generation = 0;  // differs whenever the freespace differs
    std::optional<freespace::Freespace> freespace;  // set when ready; stays set while a newer one is baked
};

// Thread-safe. Call Director::maps_changed() after a change.
class MapLibrary {
  public:
    void add(const std::string& name, bool strict);  // in state loading, again if it is known
    void set_loading(const std::string& name, const std::string& reason);
    void set_ready(const std::string& name, freespace::Freespace freespace, double bake_seconds = 0.0);
    void set_failed(const std::string& name, const std::string& reason);
    void remove(const std::string& name);

    // nullopt: no map of this name is configured.
    [[nodiscard]] std::optional<MapEntry> find(const std::string& name) const;
    [[nodiscard]] std::vector<std::string> names() const;  // ascending
    [[nodiscard]] std::map<std::string, MapEntry> entries() const;

  private:
    mutable std::mutex mutex_;
    std::map<std::string, MapEntry> entries_;
    std::uint64_t generation_ = 0;
};

}  // namespace camdir::director
