// bench-queries: the freespace's queries beside Embree's and Bullet's on the same pairs of points of one map,
// in one run, with what they miss and what they wrongly report, judged by exact queries on the map.
//
// Exit codes: 0 done, 1 something failed or a query reported free what is not, 2 bad usage.
#include <cmath>
#include <cstdio>
#include <iostream>
#include <random>
#include <string>
#include <vector>

#include "bench/program.hpp"
#include "bench/queries/bullet_queries.hpp"
#include "bench/queries/embree_queries.hpp"
#include "bench/queries/samples.hpp"
#include "evaluation/trace.hpp"
#include "freespace/distance.hpp"
#include "freespace/roadmap.hpp"
#include "freespace/slab_octree.hpp"
#include "freespace/visibility.hpp"
#include "oracle/oracle.hpp"
#include "scene/load.hpp"
#include "support/freespace_meshes.hpp"
#include "support/freespace_twins.hpp"

namespace camdir::bench {
namespace {

constexpr float sight_length = 512.0F;
constexpr float beam_length = 120.0F;
constexpr float beam_radius = 5.0F;
constexpr int bundle_size = 32;

struct Options {
    std::string vfs;
    std::string map;
    std::string trace;
    int count = 10'000;
    int judged = 2'000;
};

struct Pair {
    Vec3f from, to;
};

// The eyes of a recorded match in the order of one player after the other, or covered points in a random
// order.
std::vector<Vec3f> points_of(const freespace::Freespace& freespace, const Options& options,
                             std::mt19937& random) {
    std::vector<Vec3f> points;
    if (options.trace.empty()) {
        while (points.size() < static_cast<std::size_t>(options.count))
            points.push_back(test::covered_point(random, freespace));
        return points;
    }
    const auto trace = evaluation::read_trace(options.trace);
    if (!trace) throw std::runtime_error(trace.error().message);
    for (const std::uint32_t player : trace->players)
        for (const std::uint32_t pose : evaluation::track_of(*trace, player)) {
            if (pose == evaluation::absent || !trace->poses[pose].alive) continue;
            const Vec3f eye = trace->poses[pose].eye.cast<float>();
            if (freespace::distance(freespace, eye).covered()) points.push_back(eye);
        }
    if (points.empty()) throw std::runtime_error(options.trace + ": no eye of it lies in " + options.vfs);
    return points;
}

Vec3f random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return Vec3f(normal(random), normal(random), normal(random)).normalized();
}

class Bench {
  public:
    Bench(const Options& options, const freespace::Freespace& freespace, const scene::Scene& scene)
        : options_(options), freespace_(freespace), embree_(scene), bullet_(scene), oracle_(scene) {
        points_ = points_of(freespace, options, random_);
        const auto any = [&] { return points_[random_() % points_.size()]; };
        const auto count = static_cast<std::size_t>(options.count);
        for (std::size_t i = 0; i < count; ++i)
            starts_.push_back(any());
        for (int tries = 0; pairs_.size() < count && tries < 1000 * options.count; ++tries) {
            const Pair pair{any(), any()};
            if ((pair.to - pair.from).norm() <= sight_length) pairs_.push_back(pair);
        }
        if (pairs_.empty()) throw std::runtime_error("no two points are within 512 units of each other");
        for (const Vec3f& start : starts_)
            beams_.push_back({start, start + beam_length * random_direction(random_)});
    }

    // False: something was reported free that is not.
    bool run() {
        time_yardstick();
        std::printf("| query | ns p50 | p90 | p99 | rays | |\n|---|---|---|---|---|---|\n");
        row("Embree: occlusion ray, <= 512 units", ray_);
        time_peers();
        time_distance();
        time_sight();
        time_beams();
        time_bundle();
        time_path();
        return false_ == 0;
    }

  private:
    void row(const char* name, const Samples& samples, const std::string& note = "") const {
        std::printf("| %s | %.0f | %.0f | %.0f | %.2f | %s |\n", name, samples.quantile(0.5),
                    samples.quantile(0.9), samples.quantile(0.99), samples.quantile(0.5) / ray_.quantile(0.5),
                    note.c_str());
        std::fflush(stdout);
    }

    // Twice: the first warms up.
    void time_yardstick() {
        for (int round = 0; round < 2; ++round) {
            ray_ = Samples();
            for (const auto& [from, to] : pairs_)
                (void)ray_.time([&, &a = from, &b = to] { return embree_.clear(a, b); });
        }
    }

    void time_peers() {
        Samples nearest, bundle, sweep;
        for (const Vec3f& start : starts_)
            (void)nearest.time([&] { return embree_.nearest(start); });
        row("Embree: point query", nearest);
        for (std::size_t i = 0; i < starts_.size() / 8; ++i) {
            const std::vector<Vec3f> ends = bundle_of(starts_[i]);
            (void)bundle.time([&] { return embree_.clear_of_bundle(starts_[i], ends); });
        }
        row("Embree: bundle of 32 rays, 120 units", bundle);
        for (const auto& [from, to] : beams_)
            (void)sweep.time([&, &a = from, &b = to] { return bullet_.sweep(a, b, beam_radius); });
        row("Bullet: sweep of a sphere of 5, 120 units", sweep);
    }

    void time_distance() {
        Samples coherent, cold;
        for (std::size_t i = 0; i < std::min(points_.size(), starts_.size()); ++i)
            (void)coherent.time([&] { return freespace::distance(freespace_, points_[i]); });
        for (const Vec3f& start : starts_)
            (void)cold.time([&] { return freespace::distance(freespace_, start); });
        int below = 0, judged = 0;
        for (std::size_t i = 0; i < starts_.size() && judged < options_.judged / 4; ++i, ++judged) {
            const double exact = test::exact_distance(freespace_, starts_[i].cast<double>());
            below += freespace::distance(freespace_, starts_[i]).value < 0.98 * exact ? 1 : 0;
        }
        row("distance, from the preceding point", coherent);
        row("distance, anywhere", cold,
            "below 98 % of the best slab: " + std::to_string(below) + " of " + std::to_string(judged));
    }

    void time_sight() {
        Samples all, clear, blocked;
        for (const auto& [from, to] : pairs_) {
            Samples one;
            const bool is_clear =
                one.time([&, &a = from, &b = to] { return freespace::sight(freespace_, a, b); }).clear;
            all.add(one);
            (is_clear ? clear : blocked).add(one);
        }
        judge_sights();
        row("sight, <= 512 units", all, judgement_);
        row("sight, clear", clear, std::to_string(clear.count()) + " of " + std::to_string(all.count()));
        row("sight, blocked", blocked);
    }

    void judge_sights() {
        int truly = 0, missed = 0, wrong = 0, roomy = 0, roomy_missed = 0;
        const auto room = static_cast<double>(freespace_.metadata().d0);
        for (std::size_t i = 0; i < pairs_.size() && truly < options_.judged; ++i) {
            const auto& [from, to] = pairs_[i];
            const bool seen = freespace::sight(freespace_, from, to).clear;
            if (!oracle_.segment_clear(from.cast<double>(), to.cast<double>())) {
                wrong += seen ? 1 : 0;
                continue;
            }
            ++truly;
            missed += seen ? 0 : 1;
            if (!has_clearance(pairs_[i], room)) continue;
            ++roomy;
            roomy_missed += seen ? 0 : 1;
        }
        judgement_ = missed_text(missed, truly) + ", where the clearance is >= d0 " +
                     missed_text(roomy_missed, roomy) + "; false " + std::to_string(wrong);
        false_ += wrong;
    }

    void time_beams() {
        Samples all, clear, blocked;
        int truly = 0, missed = 0, wrong = 0;
        for (std::size_t i = 0; i < beams_.size(); ++i) {
            Samples one;
            const auto seen = one.time(
                [&] { return freespace::sight(freespace_, beams_[i].from, beams_[i].to, beam_radius); });
            all.add(one);
            (seen.clear ? clear : blocked).add(one);
        }
        for (int i = 0; i < std::min(options_.judged, options_.count); ++i) {
            const Pair& beam = beams_[static_cast<std::size_t>(i)];
            const bool seen = freespace::sight(freespace_, beam.from, beam.to, beam_radius).clear;
            const bool is_free = has_clearance(beam, beam_radius + 0.3);
            truly += is_free ? 1 : 0;
            missed += is_free && !seen ? 1 : 0;
            wrong += seen && !has_clearance(beam, beam_radius - 0.02) ? 1 : 0;
        }
        false_ += wrong;
        row("beam of radius 5, 120 units", all,
            missed_text(missed, truly) + "; false " + std::to_string(wrong));
        row("beam, clear", clear, std::to_string(clear.count()) + " of " + std::to_string(all.count()));
        row("beam, blocked", blocked);
    }

    void time_bundle() {
        Samples bundle;
        for (std::size_t i = 0; i < starts_.size() / 8; ++i) {
            const std::vector<Vec3f> ends = bundle_of(starts_[i]);
            (void)bundle.time([&] {
                const freespace::SightOrigin origin(freespace_, starts_[i], beam_radius);
                return std::ranges::count_if(ends, [&](const Vec3f& end) { return origin.to(end).clear; });
            });
        }
        row("bundle of 32 beams of radius 5, 120 units", bundle);
    }

    void time_path() {
        freespace::RoadmapSearch search(freespace_);
        Samples path;
        int found = 0;
        const std::size_t half = starts_.size() / 2;
        for (std::size_t i = 0; i < half; ++i)
            found += path.time([&] { return search.find(starts_[i], starts_[half + i]).found ? 1 : 0; });
        row("roadmap path", path, "found " + std::to_string(found) + " of " + std::to_string(half));
    }

    // 16 around the eye and 16 above, as a camera asks.
    static std::vector<Vec3f> bundle_of(const Vec3f& eye) {
        std::vector<Vec3f> ends;
        for (int i = 0; i < bundle_size; ++i) {
            const float yaw = static_cast<float>(i % 16) * std::numbers::pi_v<float> / 8.0F;
            const float elevation = i < 16 ? 0.1F : 0.6F;
            const Vec3f direction(std::cos(yaw) * std::cos(elevation), std::sin(yaw) * std::cos(elevation),
                                  std::sin(elevation));
            ends.push_back(eye + beam_length * direction);
        }
        return ends;
    }

    // At points half a unit apart.
    [[nodiscard]] bool has_clearance(const Pair& pair, double clearance) const {
        const int steps = static_cast<int>(2.0F * (pair.to - pair.from).norm()) + 1;
        for (int i = 0; i <= steps; ++i) {
            const Vec3d point =
                (pair.from + (pair.to - pair.from) * (static_cast<float>(i) / static_cast<float>(steps)))
                    .cast<double>();
            if (!(oracle_.clearance(point, 2.0 * clearance) >= clearance)) return false;
        }
        return true;
    }

    static std::string missed_text(int missed, int of) {
        char text[80];
        std::snprintf(text, sizeof text, "missed %.2f %% (%d of %d)", of == 0 ? 0.0 : 100.0 * missed / of,
                      missed, of);
        return text;
    }

    const Options& options_;
    const freespace::Freespace& freespace_;
    EmbreeQueries embree_;
    BulletQueries bullet_;
    oracle::Oracle oracle_;
    std::mt19937 random_{1};
    std::vector<Vec3f> points_;  // coherent
    std::vector<Vec3f> starts_;
    std::vector<Pair> pairs_;
    std::vector<Pair> beams_;
    Samples ray_;
    std::string judgement_;
    int false_ = 0;
};

double milliseconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
}

double megabytes(std::size_t bytes) {
    return static_cast<double>(bytes) * 1e-6;
}

int run(const Options& options) {
    const auto begin = std::chrono::steady_clock::now();
    const auto freespace = freespace::Freespace::open(options.vfs);
    if (!freespace) throw std::runtime_error(freespace.error().message);
    const double opened = milliseconds_since(begin);
    const auto indexed = std::chrono::steady_clock::now();
    const std::size_t octree_size = freespace->octree().memory();
    const double octree = milliseconds_since(indexed);
    const auto mapped = std::chrono::steady_clock::now();
    const std::size_t roadmap_size = freespace->roadmap().memory();
    const double roadmap = milliseconds_since(mapped);
    const auto scene = scene::load(options.map);
    if (!scene) throw std::runtime_error(scene.error().message);
    if (scene->triangles.empty()) throw std::runtime_error(options.map + ": has no triangles");
    std::printf(
        "%s: %zu triangles, of the map %zu; file %.2f MB, opened in %.1f ms; octree %.2f MB, made in %.1f "
        "ms; "
        "roadmap %.2f MB, made in %.1f ms\n\n",
        freespace->metadata().map_name.c_str(), freespace->triangles().size(), scene->triangles.size(),
        megabytes(freespace->byte_size()), opened, megabytes(octree_size), octree, megabytes(roadmap_size),
        roadmap);
    return Bench(options, *freespace, *scene).run() ? 0 : 1;
}

int run(int argc, char** argv) {
    Options options;
    CLI::App app("Times the queries of a baked map beside Embree and Bullet, and judges them on the map.",
                 "bench-queries");
    app.add_option("VFS", options.vfs, "The baked map")->required();
    app.add_option("MAP", options.map, "What it was baked from")->required();
    app.add_option("--trace", options.trace, "A recorded match: its eyes are the points; else random ones");
    app.add_option("--count", options.count, "Queries of each kind")
        ->capture_default_str()
        ->check(CLI::Range(100, 1'000'000));
    app.add_option("--judged", options.judged, "Of these to judge by exact queries")
        ->capture_default_str()
        ->check(CLI::Range(0, 1'000'000));
    return run_program(app, argc, argv, [&] { return run(options); });
}

}  // namespace
}  // namespace camdir::bench

int main(int argc, char** argv) {
    return camdir::bench::run(argc, argv);
}
