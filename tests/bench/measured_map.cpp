#include "measured_map.hpp"

#include <sys/resource.h>

#include <chrono>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <thread>

#include "base/file.hpp"
#include "freespace/distance.hpp"
#include "freespace/freespace.hpp"
#include "support/child_process.hpp"

namespace camdir::bench {
namespace {

using nlohmann::json;
using Clock = std::chrono::steady_clock;

constexpr double least_coverage = 99.9;  // percent, at clearance > d0
constexpr double not_measured = std::numeric_limits<double>::quiet_NaN();

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

double cpu_seconds_of_children() {
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage);
    const auto seconds = [](const timeval& time) {
        return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

std::string last_line(const std::string& text) {
    std::istringstream lines(text);
    std::string last;
    for (std::string line; std::getline(lines, line);)
        if (!line.empty()) last = line;
    return last;
}

double number_at(const json& object, const std::string& pointer) {
    const json& value = object.at(json::json_pointer(pointer));
    return value.is_number() ? value.get<double>() : not_measured;
}

// `what` as counted by the last stage before `end` that counts it.
double count_of(const json& stages, const std::string& what, const std::string& end = "") {
    double found = not_measured;
    for (const json& stage : stages) {
        if (stage.at("stage") == end) break;
        if (stage.at("counts").contains(what)) found = stage.at("counts").at(what).get<double>();
    }
    return found;
}

class Measurement {
  public:
    Measurement(const MapSource& map, const MeasureParameters& parameters)
        : map_(map),
          parameters_(parameters),
          director_(parameters.programs / "camera-director"),
          file_(parameters.work / (map.name + ".vfs")) {
        measured_.name = map.name;
    }

    MeasuredMap run() {
        if (!bake()) return std::move(measured_);
        if (parameters_.check_threads) bake_with_one_and_two_threads();
        verify();
        return std::move(measured_);
    }

  private:
    bool bake();
    void bake_with_one_and_two_threads();
    void verify();
    void judge(const VerifyFigures& figures);
    [[nodiscard]] double yardstick_seconds() const;
    [[nodiscard]] double first_query_ms() const;
    [[nodiscard]] std::vector<std::string> bake_command(const std::string& output) const;

    const MapSource& map_;
    const MeasureParameters& parameters_;
    const std::string director_;
    const std::string file_;
    MeasuredMap measured_;
};

std::vector<std::string> Measurement::bake_command(const std::string& output) const {
    std::vector<std::string> command{director_, "bake", map_.source, "-o", output};
    command.insert(command.end(), parameters_.bake_options.begin(), parameters_.bake_options.end());
    return command;
}

bool Measurement::bake() {
    const double yardstick = yardstick_seconds();
    std::vector<std::string> command = bake_command(file_);
    command.insert(command.end(), {"--report", "-", "--quiet"});
    const double cpu_before = cpu_seconds_of_children();
    const auto begin = Clock::now();
    test::ChildProcess process(command);
    if (process.wait() != 0) {
        measured_.failures.push_back("bake: " + last_line(process.errors()));
        return false;
    }
    BakeFigures& figures = measured_.bake.emplace();
    figures.seconds = seconds_since(begin);
    figures.cpu_seconds = cpu_seconds_of_children() - cpu_before;
    figures.yardsticks = figures.seconds / yardstick;
    const json report = json::parse(process.output());
    figures.samples = count_of(report.at("stages"), "samples");
    figures.unreduced_triangles = count_of(report.at("stages"), "triangles", "reduce");
    figures.triangles = number_at(report, "/triangles");
    figures.megabytes = number_at(report, "/file_bytes") / 1e6;
    figures.peak_megabytes = number_at(report, "/peak_memory_bytes") / 1e6;
    figures.first_query_ms = first_query_ms();
    return true;
}

// The bake that was measured took all processors.
void Measurement::bake_with_one_and_two_threads() {
    for (const char* threads : {"1", "2"}) {
        if (std::to_string(std::thread::hardware_concurrency()) == threads) continue;
        const std::string again = file_ + ".again";
        std::vector<std::string> command = bake_command(again);
        command.insert(command.end(), {"--quiet", "--threads", threads});
        test::ChildProcess process(command);
        if (process.wait() != 0)
            measured_.failures.push_back("bake with --threads " + std::string(threads) + ": " +
                                         last_line(process.errors()));
        else if (read_file(again).value() != read_file(file_).value())
            measured_.failures.push_back("other bytes with --threads " + std::string(threads));
        std::filesystem::remove(again);
    }
}

void Measurement::verify() {
    test::ChildProcess process({director_, "verify", file_, "--map", map_.source, "--balls",
                                std::to_string(parameters_.balls), "--points",
                                std::to_string(parameters_.points), "--json", "-"});
    process.wait();
    const json result = json::parse(process.output(), nullptr, false);
    if (result.is_discarded()) {
        measured_.failures.push_back("verify: " + last_line(process.errors()));
        return;
    }
    VerifyFigures& figures = measured_.verify.emplace();
    figures.unsafe = number_at(result, "/unsafe_balls");
    for (const auto& [kind, counts] : result.at("balls").items())
        figures.balls += number_at(counts, "/tested");
    figures.overestimates = number_at(result, "/overestimates/points");
    figures.coverage = 100.0 * number_at(result, "/coverage/above_0/share");
    figures.coverage_above_d0 = 100.0 * number_at(result, "/coverage/above_d0/share");
    figures.tightness = number_at(result, "/tightness");
    figures.spawn_points = number_at(result, "/spawn_points/count");
    figures.uncovered_spawn_points = figures.spawn_points - number_at(result, "/spawn_points/covered");
    figures.unjoined_spawn_points =
        figures.spawn_points - number_at(result, "/spawn_points/in_one_component");
    figures.components = number_at(result, "/components");
    judge(figures);
}

void Measurement::judge(const VerifyFigures& figures) {
    const auto fail = [&](double value, const char* what) {
        std::ostringstream text;
        text << value << ' ' << what;
        measured_.failures.push_back(text.str());
    };
    if (figures.unsafe > 0) fail(figures.unsafe, "unsafe balls");
    if (figures.overestimates > 0)
        fail(figures.overestimates, "points with more distance reported than there is");
    if (!(figures.coverage_above_d0 >= least_coverage))
        fail(figures.coverage_above_d0, "% coverage at clearance > d0");
    if (figures.uncovered_spawn_points > 0)
        fail(figures.uncovered_spawn_points, "spawn points not covered");
    else if (figures.unjoined_spawn_points > 0)
        fail(figures.unjoined_spawn_points, "spawn points apart from the others");
}

double Measurement::yardstick_seconds() const {
    test::ChildProcess process({parameters_.programs / "bench-delaunay"});
    if (process.wait() != 0) throw std::runtime_error("bench-delaunay failed: " + process.errors());
    return std::stod(process.output());
}

double Measurement::first_query_ms() const {
    const auto begin = Clock::now();
    const auto freespace = freespace::Freespace::open(file_);
    if (!freespace) throw std::runtime_error(freespace.error().message);
    const Vec3f point = freespace->spawn_points().empty() ? freespace->vertices().front().position()
                                                          : freespace->spawn_points().front().eye;
    (void)freespace::distance(*freespace, point);
    return 1000.0 * seconds_since(begin);
}

}  // namespace

MeasuredMap measure(const MapSource& map, const MeasureParameters& parameters) {
    return Measurement(map, parameters).run();
}

}  // namespace camdir::bench
