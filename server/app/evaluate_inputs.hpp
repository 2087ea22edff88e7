// What `evaluate` and `direct` read: its options, the match and the map.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/progress.hpp"
#include "base/error.hpp"
#include "evaluation/events.hpp"
#include "evaluation/kills.hpp"
#include "evaluation/mover_tracks.hpp"
#include "evaluation/trace.hpp"
#include "freespace/freespace.hpp"
#include "scene/scene.hpp"

namespace camdir::app {

inline constexpr const char* tracker = "tracker";
inline constexpr const char* planner = "planner";
inline constexpr const char* paper = "paper";

struct EvaluateOptions {
    std::string freespace;
    std::string map;
    std::string trace;
    std::string events;
    std::string movers;
    std::string camera = tracker;
    std::string judge;
    std::string profile = "default";
    std::string config;
    std::string cameras;
    std::string terms;
    std::string json;
    std::string report;
    double output_hz = 0.0;  // 0 = the trace's own frames
    double look_ahead = 0.0;
    std::string solver;                // empty: the profile's
    std::vector<std::uint32_t> group;  // empty: a camera for each player

    [[nodiscard]] bool tracks() const { return judge.empty() && camera == tracker; }
};

struct Match {
    evaluation::Trace poses;                             // as recorded
    evaluation::Trace frames;                            // the instants of the cameras
    std::optional<std::vector<evaluation::Kill>> kills;  // of options.events, or what the trace's file has
    std::optional<std::vector<evaluation::MoverRow>> movers;  // of options.movers
};
[[nodiscard]] Result<Match> read_match(const EvaluateOptions& options, ProgressLine& line);

struct SourceMap {
    scene::Scene scene;
    std::optional<freespace::Freespace> freespace;  // where the options name one
    double point_radius = 0.0;                      // of the obstacles in a cloud
};
// `freespace` may be empty; a point cloud needs one.
[[nodiscard]] Result<SourceMap> open_map(const std::string& freespace, const std::string& map);

// Warns on standard error of recorded movers, the rows of `file`, that the map or, where it has a name, the
// baked file does not have.
void warn_of_unknown_movers(const std::string& file, std::span<const evaluation::MoverRow> rows,
                            const std::string& map, const std::string& freespace, const SourceMap& opened);

// Warns on standard error where these two files of opened maps do not belong together.
void warn_of_another_source(const std::string& freespace, const std::string& map, const SourceMap& opened);

// Warns on standard error where most of the poses of the match `trace` that it looks at are outside of the
// free space of the baked file, if there is one.
void warn_of_another_map(const std::string& trace, const evaluation::Trace& poses,
                         const std::string& freespace, const SourceMap& opened);

// Warns on standard error where the events of `file` have nothing to direct by, or most of those who are
// killed in the time of the match `trace` live on in it, although somebody dies there.
void warn_of_another_match(const std::string& file, std::span<const evaluation::TraceEvent> events,
                           const std::string& trace, const evaluation::Trace& poses);

}  // namespace camdir::app
