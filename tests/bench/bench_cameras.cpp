// bench-cameras: this project's cameras beside those that a user would pick instead, on the same recorded
// matches, in one run and one table.
//
// Exit codes: 0 done, 1 something failed, 2 bad usage.
#include <algorithm>
#include <functional>
#include <iostream>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "bench/cameras/chase.hpp"
#include "bench/cameras/spots.hpp"
#include "bench/cameras/spring_arm.hpp"
#include "bench/cameras/table.hpp"
#include "bench/program.hpp"
#include "evaluation/kills.hpp"
#include "evaluation/peers.hpp"
#include "evaluation/resample.hpp"
#include "evaluation/statistics.hpp"
#include "freespace/freespace.hpp"
#include "maps/source.hpp"
#include "oracle/oracle.hpp"

namespace camdir::bench {
namespace {

struct Options {
    std::vector<std::string> matches;
    std::vector<std::string> cameras;  // none: all
    double output_hz = 0.0;            // 0: the trace's own frames
    std::string csv;
};

// VFS,MAP,TRACE[,EVENTS]
std::vector<std::string> files_of(const std::string& match) {
    auto files = CLI::detail::split(match, ',');
    if (files.size() == 3) files.emplace_back();
    if (files.size() != 4)
        throw std::runtime_error("match \"" + match + "\", expected VFS,MAP,TRACE or VFS,MAP,TRACE,EVENTS");
    return files;
}

// One match and what all cameras need to know of its map.
struct Match {
    freespace::Freespace freespace;
    scene::Scene scene;
    evaluation::RecordedMatch recorded;
    evaluation::Trace frames;  // the instants of the cameras
    std::optional<std::vector<evaluation::Kill>> kills;

    Match(const std::vector<std::string>& files, double output_hz)
        : freespace(value_of(freespace::Freespace::open(files[0]))),
          scene(value_of(maps::load_source(freespace, files[1]))),
          recorded(value_of(evaluation::read_match(files[2]))),
          frames(output_hz == 0.0 ? recorded.trace
                                  : value_of(evaluation::resample(recorded.trace, output_hz))),
          kills(value_of(evaluation::kills_of(recorded, files[3]))) {
        if (scene.triangles.empty()) throw std::runtime_error(files[1] + ": has no triangles");
    }
};

struct Contender {
    std::string name;
    std::function<evaluation::Recording()> run;
};

class MatchBench {
  public:
    explicit MatchBench(const Match& match)
        : match_(match), oracle_(match.scene), embree_(match.scene), bullet_(match.scene) {
        const double unit = metres_of_nominal_unit / match.scene.metres_per_unit;
        add(rigid());
        add(swept_arm(bullet_, 0.0, unit));
        add(swept_arm(bullet_, 10.0, unit));
        add(ray_arm(embree_, unit));
        add(hltv_chase(bullet_, unit));
        add(best_of_spots(embree_, unit));
        camera::Profile paper;
        paper.solver = camera::Solver::paper;
        add_own("paper", paper, 0.0);
        add_own("planner", {}, 0.0);
        add_own("planner 1 s ahead", {}, 1.0);
        for (const auto& [name, use, profile] : camera::shipped_profiles().subspan(1)) {
            add_own(name, profile, 0.0);
            add_own(std::string(name) + " 2 s ahead", profile, 2.0);
        }
    }
    MatchBench(const MatchBench&) = delete;
    MatchBench& operator=(const MatchBench&) = delete;

    // Only the cameras of these names; none: all.
    void run(const std::vector<std::string>& names, std::vector<Row>& rows) const {
        for (const std::string& name : names)
            if (std::ranges::find(contenders_, name, &Contender::name) == contenders_.end())
                throw std::runtime_error("no camera \"" + name + "\"; there are" + all_names());
        for (const Contender& contender : contenders_) {
            if (!names.empty() && std::ranges::find(names, contender.name) == names.end()) continue;
            std::cerr << match_.freespace.metadata().map_name << ": " << contender.name << '\n';
            rows.push_back(judged(contender));
        }
    }

  private:
    [[nodiscard]] std::string all_names() const {
        std::string names;
        for (const Contender& contender : contenders_)
            names += " \"" + contender.name + '"';
        return names;
    }

    [[nodiscard]] Camera rigid() const {
        return {"rigid", [metres = match_.scene.metres_per_unit] {
                    return [metres](const evaluation::TracePose& pose, double) {
                        return evaluation::place(evaluation::Peer::rigid, pose, metres);
                    };
                }};
    }

    void add(const Camera& camera) {
        contenders_.push_back({camera.name, [this, camera] { return follow_all(match_.frames, camera); }});
    }

    void add_own(const std::string& name, const camera::Profile& profile, double look_ahead) {
        contenders_.push_back({name, [this, profile, look_ahead] {
                                   return value_of(evaluation::record(
                                       match_.freespace, profile, match_.recorded.trace, {}, match_.frames,
                                       look_ahead, [](std::uint64_t, std::uint64_t) {}, {}));
                               }});
    }

    [[nodiscard]] Row judged(const Contender& contender) const {
        const evaluation::Recording recording = contender.run();
        Row row;
        row.match = match_.freespace.metadata().map_name;
        row.camera = contender.name;
        row.metrics =
            value_of(evaluation::measure(match_.scene, oracle_, match_.frames, recording.cameras, {}, {}));
        if (match_.kills)
            row.metrics.kill_in_view = evaluation::kill_in_view(
                oracle_, match_.scene.metres_per_unit, match_.frames, recording.cameras, *match_.kills);
        row.ns_p50 = evaluation::percentile(recording.step_nanoseconds, 0.5);
        row.ns_p99 = evaluation::percentile(recording.step_nanoseconds, 0.99);
        return row;
    }

    const Match& match_;
    oracle::Oracle oracle_;
    EmbreeQueries embree_;
    BulletQueries bullet_;
    std::vector<Contender> contenders_;
};

int run(const Options& options) {
    std::vector<Row> rows;
    for (const std::string& files : options.matches) {
        const Match match(files_of(files), options.output_hz);
        MatchBench(match).run(options.cameras, rows);
    }
    std::cout << to_markdown(rows);
    if (!options.csv.empty()) {
        if (const auto written = write_file(options.csv, to_csv(rows)); !written)
            throw std::runtime_error(written.error().message);
    }
    return 0;
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app("Judges cameras on recorded matches: this project's and those of others.", "bench-cameras");
    app.add_option("MATCH", options.matches, "VFS,MAP,TRACE or VFS,MAP,TRACE,EVENTS: files of one match")
        ->required();
    app.add_option("--camera", options.cameras, "Only the camera of this name; may be repeated")
        ->allow_extra_args(false);
    app.add_option("--output-hz", options.output_hz,
                   "Cameras per second, judged against interpolated poses; default: the trace's frames")
        ->check(CLI::Range(1.0, 1000.0));
    app.add_option("--csv", options.csv, "Write the table as CSV too");
    return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    return camdir::bench::run(argc, argv);
}
