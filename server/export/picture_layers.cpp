#include "export/picture_layers.hpp"

#include <algorithm>
#include <limits>

#include "bake/sample.hpp"
#include "evaluation/camera_path.hpp"
#include "evaluation/trace.hpp"

namespace camdir::exports {
namespace {

using render::Colour;
using render::KeyEntry;

constexpr Colour spawn_colour{0.85F, 0.10F, 0.45F};
constexpr Colour sample_colour{0.15F, 0.30F, 0.60F};
constexpr float camera_shade = 0.45F;
const Vec3f gap = Vec3f::Constant(std::numeric_limits<float>::quiet_NaN());

// The chosen players, as positions in trace.players.
Result<std::vector<std::size_t>> chosen_players(const Tracks& tracks, const evaluation::Trace& trace) {
    std::vector<std::size_t> chosen;
    for (std::size_t i = 0; i < trace.players.size(); ++i) {
        const bool named =
            std::find(tracks.players.begin(), tracks.players.end(), trace.players[i]) != tracks.players.end();
        if (tracks.players.empty() || named) chosen.push_back(i);
    }
    for (const std::uint32_t player : tracks.players) {
        if (!std::binary_search(trace.players.begin(), trace.players.end(), player))
            return fail(tracks.trace + ": has no player " + std::to_string(player));
    }
    return chosen;
}

// Frames first .. last - 1 are drawn.
struct Frames {
    std::size_t first, last;
};

Result<Frames> chosen_frames(const Tracks& tracks, const evaluation::Trace& trace) {
    const auto seconds = [&](const evaluation::TraceFrame& frame) {
        return static_cast<double>(frame.time - trace.frames.front().time) * 1e-9;
    };
    Frames frames{0, trace.frames.size()};
    while (frames.first < frames.last && seconds(trace.frames[frames.first]) < tracks.from)
        ++frames.first;
    while (frames.last > frames.first && seconds(trace.frames[frames.last - 1]) > tracks.until)
        --frames.last;
    if (frames.first == frames.last)
        return fail(tracks.trace + ": has no frame in the requested time; it lasts " +
                    std::to_string(seconds(trace.frames.back())) + " s");
    return frames;
}

// The track of a player or of their camera: `point_of(pose)`, interrupted where `breaks(pose)`.
template <class PointOf, class Breaks>
render::Path track_path(const evaluation::Trace& trace, std::uint32_t player, const Frames& frames,
                        const PointOf& point_of, const Breaks& breaks) {
    render::Path path;
    const std::vector<std::uint32_t> track = evaluation::track_of(trace, player);
    for (std::size_t frame = frames.first; frame < frames.last; ++frame) {
        const std::uint32_t pose = track[frame];
        if (pose == evaluation::absent || breaks(pose)) path.points.push_back(gap);
        if (pose != evaluation::absent) path.points.push_back(point_of(pose).template cast<float>());
    }
    return path;
}

std::vector<Colour> colours_of(const std::vector<std::size_t>& players, float shade) {
    std::vector<Colour> colours;
    colours.reserve(players.size());
    for (const std::size_t player : players)
        colours.push_back(render::player_colour(player) * shade);
    return colours;
}

}  // namespace

Result<void> add_tracks(const Tracks& tracks, float pixel, render::Layers& layers,
                        std::vector<KeyEntry>& key) {
    if (tracks.trace.empty()) return {};
    const auto trace = evaluation::read_trace(tracks.trace);
    if (!trace) return tl::unexpected(trace.error());
    const auto players = chosen_players(tracks, *trace);
    if (!players) return tl::unexpected(players.error());
    const auto frames = chosen_frames(tracks, *trace);
    if (!frames) return tl::unexpected(frames.error());
    for (const std::size_t i : *players) {
        const auto& poses = trace->poses;
        render::Path path = track_path(
            *trace, trace->players[i], *frames, [&](std::uint32_t pose) { return poses[pose].eye; },
            [&](std::uint32_t pose) { return poses[pose].discontinuity || !poses[pose].alive; });
        path.colour = render::player_colour(i);
        path.width = 4.0F * pixel;
        layers.paths.push_back(std::move(path));
    }
    const std::string count = std::to_string(players->size());
    key.push_back({KeyEntry::Mark::line, colours_of(*players, 1.0F),
                   players->size() == 1 ? "player " + std::to_string(trace->players[players->front()])
                                        : count + " players"});

    if (tracks.cameras.empty()) return {};
    const auto cameras = evaluation::read_cameras(tracks.cameras, *trace);
    if (!cameras) return tl::unexpected(cameras.error());
    for (const std::size_t i : *players) {
        render::Path path = track_path(
            *trace, trace->players[i], *frames, [&](std::uint32_t pose) { return (*cameras)[pose].position; },
            [&](std::uint32_t pose) { return (*cameras)[pose].cut; });
        path.colour = render::player_colour(i) * camera_shade;
        path.width = 1.8F * pixel;
        layers.paths.push_back(std::move(path));
    }
    key.push_back({KeyEntry::Mark::thin_line, colours_of(*players, camera_shade),
                   players->size() == 1 ? "its camera" : "their cameras"});
    return {};
}

void add_spawn_points(const freespace::Freespace& freespace, float pixel, render::Layers& layers,
                      std::vector<KeyEntry>& key) {
    if (freespace.spawn_points().empty()) return;
    render::Balls balls{{}, spawn_colour, 6.0F * pixel};
    for (const freespace::SpawnPoint& spawn : freespace.spawn_points())
        balls.centres.push_back(spawn.eye);
    key.push_back({KeyEntry::Mark::disc,
                   {spawn_colour},
                   std::to_string(balls.centres.size()) +
                       (balls.centres.size() == 1 ? " spawn point" : " spawn points")});
    layers.balls.push_back(std::move(balls));
}

Result<void> add_samples(const scene::Scene& map, double d0, float pixel, render::Layers& layers,
                         std::vector<KeyEntry>& key) {
    std::vector<Vec3d> samples = map.points;
    if (samples.empty()) {
        bake::Stage stage("sample", {}, {});
        auto sampled = bake::sample(map, bake::Solids(map), bake::SamplingDistance(d0), 0.0, stage);
        if (!sampled) return tl::unexpected(sampled.error());
        samples = std::move(*sampled);
    }
    render::Balls balls{{}, sample_colour, 1.1F * pixel};
    for (const Vec3d& sample : samples)
        balls.centres.push_back(sample.cast<float>());
    key.push_back({KeyEntry::Mark::disc,
                   {sample_colour},
                   std::to_string(balls.centres.size()) +
                       (map.points.empty() ? " points, one at least every d0" : " points")});
    layers.balls.push_back(std::move(balls));
    return {};
}

}  // namespace camdir::exports
