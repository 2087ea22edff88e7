// Measures live matches on a real OpenArena server, with bots and one spectator: how old and how exact the
// pictures are that the spectator's client draws, and what the module costs the server. One row for each map
// and rate.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <iostream>
#include <limits>
#include <stdexcept>
#include <thread>

#include "support/game/director.hpp"
#include "support/game/game_server.hpp"
#include "support/game/packages.hpp"
#include "support/game/spectator.hpp"
#include "support/openarena.hpp"
#include "support/test_domain.hpp"

namespace camdir::bench {
namespace {

using namespace camdir::test;

constexpr int bots = 8;
constexpr double ms = 1e6;  // ns
constexpr double us = 1e3;

struct Sample {
    std::vector<double> values;

    void add(double value) { values.push_back(value); }
    [[nodiscard]] double at(double quantile) {
        if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
        std::sort(values.begin(), values.end());
        return values[static_cast<std::size_t>(quantile * static_cast<double>(values.size() - 1))];
    }
    [[nodiscard]] double mean() const {
        double sum = 0.0;
        for (const double value : values)
            sum += value;
        return sum / static_cast<double>(values.size());
    }
};

struct ServerFigures {
    std::size_t frames = 0;
    std::size_t late = 0;            // run together with the next one, because the server was late
    std::size_t late_by_module = 0;  // of them, those that the module delayed by a millisecond or more
    Sample module_us;                // what the module adds to a frame
    Sample game_us;                  // the game's own frame
};

struct ViewerFigures {
    std::size_t pictures = 0, from_director = 0, standing = 0;
    Sample pose_to_picture_ms;    // from the players' poses, as drawn, to the complete picture
    Sample camera_to_picture_ms;  // from the poses that the director computed the drawn camera for
    Sample age;                   // snapshots
    Sample offset, turn;          // units, degrees
};

struct Run {
    std::string map;
    int rate;
    double seconds;
};

std::vector<witness_record> frames_since(const std::vector<witness_record>& records, std::int64_t begin) {
    std::vector<witness_record> frames;
    std::copy_if(records.begin(), records.end(), std::back_inserter(frames),
                 [begin](const witness_record& record) {
                     return record.kind == witness_ran_frame && record.time >= begin;
                 });
    return frames;
}

ServerFigures figures_of(const std::vector<witness_record>& outer, const std::vector<witness_record>& inner) {
    ServerFigures figures;
    figures.frames = outer.size();
    for (std::size_t i = 0; i < outer.size(); ++i) {
        const bool late = !outer[i].sent;
        figures.late += late;
        if (i >= inner.size()) continue;
        const auto added = static_cast<double>(outer[i].frame_ns - inner[i].whole_frame_ns +
                                               outer[i].between_ns - inner[i].whole_between_ns);
        figures.late_by_module += late && added >= ms;
        figures.module_us.add(added / us);
        figures.game_us.add(static_cast<double>(inner[i].frame_ns) / us);
    }
    return figures;
}

// Level time of the newest poses for which a camera had arrived by then.
std::optional<int> newest_camera(const std::vector<CameraTape::Entry>& tape, std::int64_t clock) {
    const auto after =
        std::upper_bound(tape.begin(), tape.end(), clock,
                         [](std::int64_t time, const auto& entry) { return time < entry.received; });
    return after == tape.begin() ? std::nullopt : std::optional(std::prev(after)->level_time);
}

ViewerFigures figures_of(const CommandedPath& path, int slot, const std::vector<drawn_record>& pictures,
                         const std::vector<CameraTape::Entry>& tape, std::int64_t begin) {
    ViewerFigures figures;
    std::optional<DrawnView> before;
    for (const drawn_record& picture : pictures) {
        const auto drawn = picture.time < begin ? std::nullopt : locate(path, picture);
        if (!drawn) continue;
        ++figures.pictures;
        // Where nothing moves, all times look alike: the latest.
        const std::size_t from = path.snapshot_at(drawn->latest_time, drawn->newest);
        const std::size_t to = std::min(from + 1, drawn->newest);
        const witness_record &first = path.snapshots()[from].frame, &second = path.snapshots()[to].frame;
        if (!is_overlaid(first, slot) || !is_overlaid(second, slot)) continue;
        ++figures.from_director;
        if (before && path.snapshots()[drawn->newest].frame.level_time > before->time &&
            drawn->latest_time <= before->time)
            ++figures.standing;
        before = drawn;
        figures.age.add(drawn->age);
        figures.offset.add(drawn->offset);
        figures.turn.add(drawn->turn);
        const double since = drawn->latest_time - first.level_time;
        const double drawn_age = static_cast<double>(picture.time - first.time) / ms - since;
        figures.pose_to_picture_ms.add(drawn_age);
        if (const auto camera = newest_camera(tape, first.time))
            figures.camera_to_picture_ms.add(drawn_age + first.level_time - *camera);
    }
    return figures;
}

std::int64_t now() {
    return std::chrono::steady_clock::now().time_since_epoch().count();
}

// Small pictures: drawing them without a graphics card must not make the others late.
GameClientOptions client_options(const Run& run) {
    return {.snaps = run.rate, .width = 320, .height = 180};
}

// The server's figures without the module, for comparison: how often this machine makes it late.
ServerFigures measure_plain(const Run& run) {
    constexpr double long_enough = 60.0;
    GameServer server(
        {.map = run.map, .rate = run.rate, .bots = bots, .settings = {}, .module = plain_module()});
    if (!server.ready(bots))
        throw std::runtime_error("the server does not start: " + server.console().output());
    GameClient client(server.port(), client_options(run));
    if (!client.draws(1)) throw std::runtime_error("the client does not start: " + client.console().output());
    const std::int64_t begin = now();
    std::this_thread::sleep_for(std::chrono::duration<double>(std::min(run.seconds, long_enough)));
    return figures_of(frames_since(server.witnessed(), begin), {});
}

void measure(const Run& run) {
    ServerFigures plain = measure_plain(run);
    const TestDomain domain;
    GameDirector director(domain.id(), {run.map});
    if (!director.ready()) throw std::runtime_error("the director does not start: " + director.log());
    GameServer server({.map = run.map,
                       .rate = run.rate,
                       .bots = bots,
                       .settings = {{"director_domain", std::to_string(domain.id())}},
                       .witness_inside = true});
    const CameraTape tape(domain.id(), "openarena-" + std::to_string(server.port()));
    if (!server.ready(bots))
        throw std::runtime_error("the server does not start: " + server.console().output());
    Spectator spectator(server, tape, client_options(run));
    if (!spectator.joins()) {
        throw std::runtime_error("no spectator sees the director's camera: " +
                                 spectator.client().console().output());
    }
    const std::int64_t begin = now();
    std::this_thread::sleep_for(std::chrono::duration<double>(run.seconds));

    ServerFigures with =
        figures_of(frames_since(server.witnessed(), begin), frames_since(server.witnessed_inside(), begin));
    const CommandedPath path(server.witnessed(), spectator.slot());
    ViewerFigures viewer =
        figures_of(path, spectator.slot(), spectator.client().drawn(), tape.entries(), begin);
    std::printf(
        "| %s | %d | %zu | %.1f %% | %.0f / %.0f | %.0f / %.0f | %.2f | %.4f | %.4f | %zu "
        "| %zu of %zu | %zu | %zu of %zu | %.1f / %.1f | %.0f |\n",
        run.map.c_str(), run.rate, viewer.pictures,
        100.0 * static_cast<double>(viewer.from_director) / static_cast<double>(viewer.pictures),
        viewer.pose_to_picture_ms.at(0.5), viewer.pose_to_picture_ms.at(0.99),
        viewer.camera_to_picture_ms.at(0.5), viewer.camera_to_picture_ms.at(0.99), viewer.age.at(0.99),
        viewer.offset.at(0.99), viewer.turn.at(0.99), viewer.standing, with.late, with.frames,
        with.late_by_module, plain.late, plain.frames, with.module_us.mean(), with.module_us.at(0.99),
        with.game_us.mean());
    std::fflush(stdout);
}

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    CLI::App app("Measures what a spectator of live OpenArena matches sees. Prints a table.");
    std::vector<std::string> maps = {"oa_dm1"};
    std::vector<int> rates = {20, 60};
    double seconds = 60.0;
    app.add_option("maps", maps, "maps of Debian's OpenArena packages")->capture_default_str();
    app.add_option("--rates", rates, "server frames per second")->delimiter(',')->capture_default_str();
    app.add_option("--seconds", seconds, "of each measurement; without the module at most 60")
        ->capture_default_str();
    CLI11_PARSE(app, argc, argv);
    if (const auto needs = camdir::test::needs_game_package()) {
        std::cerr << "bench-openarena: " << *needs << "\n";
        return 1;
    }
    std::puts(
        "| map | sv_fps | pictures | of the director | pose to picture p50 / p99, ms "
        "| camera's poses to picture p50 / p99, ms | age p99, snapshots | off the path p99, units "
        "| p99, degrees | standing | late frames | by the module | without it "
        "| module mean / p99, us | game, us |");
    std::puts("|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|");
    try {
        for (const std::string& map : maps)
            for (const int rate : rates)
                camdir::bench::measure({map, rate, seconds});
    } catch (const std::exception& error) {
        std::cerr << "bench-openarena: " << error.what() << "\n";
        return 1;
    }
    return 0;
}
