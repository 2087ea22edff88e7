// The maps as a browser draws them, compressed.
#pragma once

#include <chrono>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "director/map_library.hpp"

namespace camdir::live {

enum class ModelKind {
    obstacles,  // the source's surfaces
    mesh,       // the medial mesh, coloured by free distance
    contents,   // fixed cameras and movers: JSON; the others are binary glTF
};

struct Model {
    std::string gzip;
    std::string tag;  // of these bytes
};

// Models are made when they are first asked for, glTF one at a time, and the latest asked for are kept. What
// cannot be made is tried again after a minute: somebody may have mended it.
// Thread-safe.
class Models {
  public:
    static constexpr std::size_t max_bytes = 64U << 20U;     // of all that are kept
    static constexpr std::size_t max_triangles = 2'000'000;  // of one
    using Clock = std::chrono::steady_clock;

    explicit Models(const director::MapLibrary& maps) : maps_(maps) {}

    // The file that the map was baked from; empty: none is known.
    void set_source(const std::string& map, const std::string& source);
    void remove_source(const std::string& map);

    enum class Failure {
        no_map,     // none of this name is loaded
        no_source,  // the obstacles cannot be shown: `reason` says why
        busy,       // another is being made
    };
    struct Answer {
        std::shared_ptr<const Model> model;  // null: there is none
        Failure failure = Failure::no_map;
        std::string reason;
    };
    [[nodiscard]] Answer find(const std::string& map, ModelKind kind, Clock::time_point now = Clock::now());

  private:
    struct Key {
        std::string map;
        std::uint64_t generation;  // of the map: a new one makes new models
        ModelKind kind;
        bool operator==(const Key&) const = default;
    };
    struct Kept {
        Key key;
        Answer answer;
        Clock::time_point made_at;
    };

    [[nodiscard]] std::optional<Answer> look_up(const Key& key, Clock::time_point now);
    void keep(const Key& key, const Answer& answer, Clock::time_point now);
    [[nodiscard]] Answer make(const director::MapEntry& map, const std::string& name, ModelKind kind);
    [[nodiscard]] Answer make_obstacles(const director::MapEntry& map, const std::string& name);

    const director::MapLibrary& maps_;
    std::mutex making_;
    std::mutex mutex_;
    std::map<std::string, std::string> sources_;  // by map
    std::list<Kept> kept_;                        // the latest first
};

}  // namespace camdir::live
