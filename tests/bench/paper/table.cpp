#include "bench/paper/table.hpp"

#include <iomanip>
#include <sstream>
#include <vector>

#include "bench/paper/method.hpp"

namespace camdir::paper {
namespace {

using Json = nlohmann::ordered_json;

struct Row {
    std::string label;
    std::string pointer;
    double factor;
    int decimals;
};

std::vector<Row> rows() {
    std::vector<Row> result;
    for (const std::string& part : part_names())
        result.push_back({part + ", CPU s", "/parts/" + part + "/cpu_seconds", 1.0, 2});
    const std::vector<Row> others{
        {"all, CPU s", "/all/cpu_seconds", 1.0, 2},
        {"all, s", "/all/seconds", 1.0, 2},
        {"peak memory, MB", "/peak_memory_bytes", 1e-6, 0},
        {"samples", "/samples", 1.0, 0},
        {"Voronoi vertices", "/voronoi_vertices", 1.0, 0},
        {"inner vertices", "/inner_vertices", 1.0, 0},
        {"inner faces", "/inner_faces", 1.0, 0},
        {"inner triangles", "/inner_triangles", 1.0, 0},
        {"reduced vertices", "/vertices", 1.0, 0},
        {"reduced triangles", "/triangles", 1.0, 0},
        {"reduction", "/ratio", 1.0, 1},
        {"file, KB", "/bytes", 1e-3, 0},
        {"coverage of all, %", "/coverage", 100.0, 2},
        {"coverage at clearance > d0, %", "/coverage_above_d0", 100.0, 2},
        {"tightness", "/tightness", 1.0, 3},
        {"unsafe balls", "/unsafe_balls", 1.0, 0},
        {"balls tested", "/balls", 1.0, 0},
    };
    result.insert(result.end(), others.begin(), others.end());
    return result;
}

std::string fixed(double value, int decimals) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << value;
    std::string digits = text.str();
    const std::size_t point = std::min(digits.find('.'), digits.size());
    for (std::size_t i = point; i > 3; i -= 3)
        digits.insert(i - 3, ",");
    return digits;
}

std::string cell(const Json& method, const Row& row) {
    const Json::json_pointer pointer(row.pointer);
    if (!method.contains(pointer) || !method.at(pointer).is_number()) return "";
    return fixed(row.factor * method.at(pointer).get<double>(), row.decimals);
}

void print_engines(const Json& engines, std::ostream& out) {
    const auto seconds = [&](const char* engine, const char* part) {
        return engines.at(engine).at(part).at("cpu_seconds").get<double>();
    };
    const auto ratio = [&](const char* part) {
        return fixed(seconds("qhull", part) / seconds("cgal", part), 1);
    };
    out << "\nVoronoi diagram of the same " << fixed(engines.at("points").get<double>(), 0)
        << " points, CPU seconds, best of " << engines.at("runs") << ": qhull "
        << fixed(seconds("qhull", "diagram"), 2) << ", CGAL " << fixed(seconds("cgal", "diagram"), 2) << " ("
        << ratio("diagram") << " times faster); with its faces " << fixed(seconds("qhull", "faces"), 2)
        << " and " << fixed(seconds("cgal", "faces"), 2) << " (" << ratio("faces") << " times faster).";
    if (engines.contains("yardstick_seconds"))
        out << " CGAL's Delaunay triangulation of 200,000 random points, wall time: "
            << fixed(engines.at("yardstick_seconds").get<double>(), 2) << '.';
    out << '\n';
}

}  // namespace

std::string table_of(const Json& report) {
    std::ostringstream out;
    const Json& columns = report.at("methods");
    out << report.at("map").get<std::string>() << ", d0 = " << fixed(report.at("d0").get<double>(), 2)
        << "\n\n| |";
    for (const Json& method : columns)
        out << ' ' << method.at("title").get<std::string>() << " |";
    out << "\n|---|";
    for (std::size_t i = 0; i < columns.size(); ++i)
        out << "---|";
    out << '\n';
    for (const Row& row : rows()) {
        out << "| " << row.label << " |";
        for (const Json& method : columns)
            out << ' ' << cell(method, row) << " |";
        out << '\n';
    }
    if (report.contains("engines")) print_engines(report.at("engines"), out);
    return out.str();
}

}  // namespace camdir::paper
