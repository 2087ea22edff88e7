// camera-director verify: tests a baked map against its source map.
#include <chrono>
#include <iomanip>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "config/json_text.hpp"
#include "evaluation/verification.hpp"
#include "freespace/freespace.hpp"
#include "maps/source.hpp"
#include "oracle/oracle.hpp"

namespace camdir::app {
namespace {

using evaluation::BallCounts;
using evaluation::Verification;
using evaluation::VerificationParameters;

struct VerifyOptions {
    std::string file;
    std::string map;
    std::string json;
    VerificationParameters parameters;
};

constexpr std::array<const char*, 3> bucket_names = {"clearance > 0", "clearance > d0", "clearance > 2d0"};
constexpr std::array<const char*, 3> bucket_keys = {"above_0", "above_d0", "above_2_d0"};

struct Kind {
    const char* key;
    const char* label;
    BallCounts Verification::*counts;
};
constexpr std::array<Kind, 4> kinds = {{{"by_area", "by area", &Verification::by_area},
                                        {"by_triangle", "by triangle", &Verification::by_triangle},
                                        {"vertices", "vertices", &Verification::at_vertices},
                                        {"edge_midpoints", "edge midpoints", &Verification::at_edges}}};

nlohmann::ordered_json ball_json(const evaluation::UnsafeBall& ball) {
    return {{"centre", {ball.centre.x(), ball.centre.y(), ball.centre.z()}},
            {"radius", ball.radius},
            {"excess", ball.excess}};
}

nlohmann::ordered_json counts_json(const BallCounts& counts) {
    nlohmann::ordered_json json = {{"tested", counts.tested}, {"skipped", counts.skipped}};
    json["unsafe"] = counts.unsafe_count();
    for (std::size_t fault = 0; fault < counts.unsafe.size(); ++fault) {
        json[evaluation::fault_names[fault]] = {{"count", counts.unsafe[fault]}};
        if (counts.deepest[fault])
            json[evaluation::fault_names[fault]]["deepest"] = ball_json(*counts.deepest[fault]);
    }
    return json;
}

// The baked file, its map, and what answers about that.
struct Subject {
    freespace::Freespace freespace;
    scene::Scene scene;
    oracle::Oracle oracle;

    [[nodiscard]] bool has_same_source() const {
        return freespace.metadata().source_hash == scene.source_hash;
    }
};

nlohmann::ordered_json result_json(const VerifyOptions& options, const Subject& subject,
                                   const Verification& result) {
    const freespace::Metadata& metadata = subject.freespace.metadata();
    nlohmann::ordered_json json = {{"file", options.file},
                                   {"map", options.map},
                                   {"source_matches", subject.has_same_source()},
                                   {"seed", options.parameters.seed},
                                   {"d0", metadata.d0},
                                   {"metres_per_unit", metadata.metres_per_unit},
                                   {"violation", result.has_violation()},
                                   {"unsafe_balls", result.unsafe_balls()}};
    for (const Kind& kind : kinds) {
        json["balls"][kind.key] = counts_json(result.*kind.counts);
    }
    for (std::size_t bucket = 0; bucket < bucket_names.size(); ++bucket) {
        const evaluation::Coverage& coverage = result.coverage[bucket];
        json["coverage"][bucket_keys[bucket]] = {
            {"points", coverage.points}, {"covered", coverage.covered}, {"share", coverage.share()}};
    }
    json["tightness"] = result.tightness;
    json["overestimates"] = {{"points", result.overestimates}, {"largest", result.largest_overestimate}};
    json["components"] = result.components;
    json["spawn_points"] = {{"count", result.spawn_points},
                            {"covered", result.covered_spawn_points},
                            {"in_one_component", result.joined_spawn_points}};
    return json;
}

void print_table(const VerifyOptions& options, const Verification& result, double seconds) {
    std::ostringstream out;
    out << std::left << std::setw(16) << "balls" << std::right << std::setw(12) << "tested" << std::setw(12)
        << "skipped" << std::setw(10) << "unsafe" << '\n';
    for (const Kind& kind : kinds) {
        const BallCounts& counts = result.*kind.counts;
        out << std::left << std::setw(16) << kind.label << std::right << std::setw(12) << counts.tested
            << std::setw(12) << counts.skipped << std::setw(10) << counts.unsafe_count() << '\n';
        for (std::size_t fault = 0; fault < counts.unsafe.size(); ++fault) {
            if (!counts.deepest[fault]) continue;
            const evaluation::UnsafeBall& ball = *counts.deepest[fault];
            out << "  " << counts.unsafe[fault] << " with " << evaluation::fault_names[fault]
                << "; deepest by " << ball.excess << ": centre " << ball.centre.transpose() << ", radius "
                << ball.radius << '\n';
        }
    }
    out << std::left << std::setw(16) << "reachable points" << std::right << std::setw(12) << "points"
        << std::setw(12) << "covered" << std::setw(10) << "share" << '\n';
    for (std::size_t bucket = 0; bucket < bucket_names.size(); ++bucket) {
        const evaluation::Coverage& coverage = result.coverage[bucket];
        out << std::left << std::setw(16) << bucket_names[bucket] << std::right << std::setw(12)
            << coverage.points << std::setw(12) << coverage.covered << std::setw(9) << std::fixed
            << std::setprecision(2) << 100.0 * coverage.share() << "%\n"
            << std::defaultfloat << std::setprecision(6);
    }
    out << "tightness " << std::setprecision(4) << result.tightness << "; " << result.overestimates
        << " points with more distance reported than there is";
    if (result.overestimates > 0) out << ", by up to " << result.largest_overestimate;
    out << "\nspawn points " << result.spawn_points << ", covered " << result.covered_spawn_points
        << ", in one component of the roadmap " << result.joined_spawn_points << " (of " << result.components
        << " components)"
        << "\nseed " << options.parameters.seed << ", " << std::setprecision(3) << seconds << " s\n"
        << (result.has_violation()
                ? "VIOLATED: the representation reaches into obstacles\n"
                : "no violation found among these balls and points, against the map as the "
                  "baker reads it too\n");
    std::cerr << out.str();
}

Result<Subject> read_subject(const VerifyOptions& options) {
    auto freespace = freespace::Freespace::open(options.file);
    if (!freespace) return tl::unexpected(freespace.error());
    auto scene = maps::load_source(*freespace, options.map);
    if (!scene) return tl::unexpected(scene.error());
    oracle::Oracle oracle(*scene, freespace->metadata().d0);
    return Subject{std::move(*freespace), std::move(*scene), std::move(oracle)};
}

Result<int> verify(const VerifyOptions& options) {
    const Interruption interruption;
    std::optional<ExitWhenInterrupted> reading(interruption);
    if (auto writable = check_outputs({options.json}, {options.file, options.map}); !writable)
        return tl::unexpected(writable.error());
    ProgressLine line;
    const auto start = std::chrono::steady_clock::now();
    line.show("reading " + options.map, 0, 0);
    const auto subject = read_subject(options);
    if (!subject) return tl::unexpected(subject.error());
    reading.reset();
    if (!subject->has_same_source()) {
        line.clear();
        std::cerr << "camera-director: warning: " << options.file << " was baked from other bytes than "
                  << options.map << '\n';
    }

    const auto show = [&](std::string_view stage, std::uint64_t done, std::uint64_t total) {
        line.show(stage, done, total);
    };
    const auto result = evaluation::verify(subject->freespace, subject->scene, subject->oracle,
                                           options.parameters, show, interruption.token());
    line.clear();
    if (!result) return tl::unexpected(result.error());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
    print_table(options, *result, seconds.count());
    if (!options.json.empty()) {
        const auto json = result_json(options, *subject, *result);
        const auto written = write_file(options.json, config::format_json(json));
        if (!written) return tl::unexpected(written.error());
    }
    return result->has_violation() ? exit_failed : exit_done;
}

}  // namespace

void add_verify(CLI::App& root, Run& run) {
    const auto options = std::make_shared<VerifyOptions>();
    CLI::App* command = root.add_subcommand(
        "verify",
        "Test a baked file against its map: no ball may reach deeper than 0.02 units of 0.0254 m into an "
        "obstacle; how much of the free space it knows. Balls and points are drawn at random, and measured "
        "without any code of the baker. The map's reader is the baker's: what it makes of the map, such as "
        "flat triangles within a unit of curved patches, is taken for the obstacles.");
    command->add_option("file", options->file, "The baked file, MAP.vfs")->required();
    command->add_option("--map", options->map, "The map: a file, or archive.pk3:maps/name.bsp")->required();
    command
        ->add_option("--balls", options->parameters.balls,
                     "Balls to draw, in addition to every vertex and edge midpoint")
        ->check(CLI::Range(std::uint64_t{0}, std::uint64_t{10'000'000'000}))
        ->capture_default_str();
    command
        ->add_option("--points", options->parameters.points,
                     "Reachable free points to draw for coverage and tightness")
        ->check(CLI::Range(std::uint64_t{1}, std::uint64_t{100'000'000}))
        ->capture_default_str();
    command->add_option("--seed-rng", options->parameters.seed, "Seed of the random numbers")
        ->capture_default_str();
    command->add_option("--json", options->json,
                        "Write the result as JSON to this file; - is standard output");
    command->callback([options, &run] {
        run = [options] {
            const Result<int> code = verify(*options);
            return code ? *code : report(code.error());
        };
    });
}

}  // namespace camdir::app
