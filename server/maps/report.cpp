#include "maps/report.hpp"

#include <sys/resource.h>

#include <iomanip>
#include <sstream>

namespace camdir::maps {

using nlohmann::ordered_json;

BakeReport report_of(const scene::Scene& scene, const bake::Baked& baked, std::uint64_t file_bytes) {
    BakeReport report;
    report.map = scene.name;
    report.source = scene.source;
    report.metres_per_unit = scene.metres_per_unit;
    report.d0 = static_cast<double>(baked.contents.metadata.d0);
    report.parameters = baked.contents.metadata.parameters;
    report.vertices = baked.contents.vertices.size();
    report.triangles = baked.contents.triangles.size();
    report.file_bytes = file_bytes;
    report.stages = baked.stages;
    for (const bake::StageReport& stage : baked.stages)
        report.seconds += stage.seconds;
    return report;
}

ordered_json to_json(const BakeReport& report) {
    ordered_json stages = ordered_json::array();
    for (const bake::StageReport& stage : report.stages) {
        ordered_json counts = ordered_json::object();
        for (const freespace::Count& count : stage.counts)
            counts[count.what] = count.value;
        stages.push_back({{"stage", stage.stage}, {"seconds", stage.seconds}, {"counts", counts}});
    }
    return {{"map", report.map},
            {"source", report.source},
            {"metres_per_unit", report.metres_per_unit},
            {"d0_map_units", report.d0},
            {"parameters", ordered_json::parse(report.parameters)},
            {"vertices", report.vertices},
            {"triangles", report.triangles},
            {"file_bytes", report.file_bytes},
            {"seconds", report.seconds},
            {"stages", stages}};
}

std::string seconds_text(double seconds) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(2) << seconds << " s";
    return text.str();
}

std::string line_of(const bake::StageReport& stage) {
    std::ostringstream line;
    line << std::left << std::setw(12) << stage.stage << std::right << std::setw(9)
         << seconds_text(stage.seconds);
    const char* separator = "  ";
    for (const freespace::Count& count : stage.counts) {
        line << separator << std::fixed << std::setprecision(0) << count.value << ' ' << count.what;
        separator = ", ";
    }
    return line.str();
}

std::uint64_t peak_memory_bytes() {
    rusage usage{};
    ::getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024U;
}

}  // namespace camdir::maps
