#include "bench/paper/table.hpp"

#include <algorithm>
#include <functional>
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

// Of a message: in one cell, on one line.
std::string escaped(std::string text) {
    std::replace(text.begin(), text.end(), '|', '/');
    return text;
}

std::string outcome_of(const Json& part) {
    return part.contains("failed") ? "failed: " + escaped(part.at("failed").get<std::string>()) : "done";
}

void print_row(const std::string& label, const Json& columns,
               const std::function<std::string(const Json&)>& cell_of, std::ostream& out) {
    out << "| " << label << " |";
    for (const Json& method : columns)
        out << ' ' << cell_of(method) << " |";
    out << '\n';
}

void print_engine(const char* name, const Json& engine, std::ostream& out) {
    out << name << ' ';
    if (engine.contains("failed")) {
        out << outcome_of(engine);
        return;
    }
    out << fixed(engine.at("diagram").at("cpu_seconds").get<double>(), 2) << " ("
        << fixed(engine.at("faces").at("cpu_seconds").get<double>(), 2) << " with its faces, of "
        << fixed(engine.at("points").get<double>(), 0) << " points)";
}

void print_engines(const Json& engines, std::ostream& out) {
    out << "\nVoronoi diagram of the same samples, CPU seconds, best of " << engines.at("runs") << ": ";
    print_engine("qhull", engines.at("qhull"), out);
    print_engine("; CGAL", engines.at("cgal"), out);
    out << '.';
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
        << "\n\n";
    if (!columns.empty()) {
        out << "| |";
        for (const Json& method : columns)
            out << ' ' << method.at("title").get<std::string>() << " |";
        out << "\n|---|";
        for (std::size_t i = 0; i < columns.size(); ++i)
            out << "---|";
        out << '\n';
        print_row("outcome", columns, outcome_of, out);
        for (const Row& row : rows())
            print_row(
                row.label, columns, [&](const Json& method) { return cell(method, row); }, out);
    }
    if (report.contains("engines")) print_engines(report.at("engines"), out);
    return out.str();
}

}  // namespace camdir::paper
