#include "measured_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iomanip>
#include <sstream>

namespace camdir::bench {
namespace {

enum class Worst { largest, smallest };

struct Column {
    std::string title;
    int decimals;
    Worst worst;
    std::function<double(const MeasuredMap&)> value;  // NaN: not measured
};

Column of_bake(std::string title, int decimals, double BakeFigures::*member) {
    return {std::move(title), decimals, Worst::largest,
            [=](const MeasuredMap& map) { return map.bake ? (*map.bake).*member : std::nan(""); }};
}

Column of_verify(std::string title, int decimals, double VerifyFigures::*member,
                 Worst worst = Worst::largest) {
    return {std::move(title), decimals, worst,
            [=](const MeasuredMap& map) { return map.verify ? (*map.verify).*member : std::nan(""); }};
}

std::vector<Column> columns() {
    return {
        of_bake("s", 1, &BakeFigures::seconds),
        of_bake("CPU s", 1, &BakeFigures::cpu_seconds),
        of_bake("yardsticks", 1, &BakeFigures::yardsticks),
        of_bake("samples", 0, &BakeFigures::samples),
        of_bake("unreduced", 0, &BakeFigures::unreduced_triangles),
        of_bake("triangles", 0, &BakeFigures::triangles),
        of_bake("MB", 2, &BakeFigures::megabytes),
        of_verify("coverage %", 2, &VerifyFigures::coverage, Worst::smallest),
        of_verify("> d0 %", 3, &VerifyFigures::coverage_above_d0, Worst::smallest),
        of_verify("tightness", 3, &VerifyFigures::tightness, Worst::smallest),
        of_verify("spawn points", 0, &VerifyFigures::spawn_points, Worst::smallest),
        of_verify("not covered", 0, &VerifyFigures::uncovered_spawn_points),
        of_verify("not joined", 0, &VerifyFigures::unjoined_spawn_points),
        of_verify("components", 0, &VerifyFigures::components),
        of_verify("unsafe", 0, &VerifyFigures::unsafe),
        of_verify("of balls", 0, &VerifyFigures::balls, Worst::smallest),
        of_bake("peak MB", 0, &BakeFigures::peak_megabytes),
        of_bake("first query ms", 2, &BakeFigures::first_query_ms),
    };
}

std::string cell(double value, const Column& column) {
    if (std::isnan(value)) return " |";
    std::ostringstream text;
    text << ' ' << std::fixed << std::setprecision(column.decimals) << value << " |";
    return text.str();
}

// Of what was measured, ascending.
std::vector<double> sorted_values(const std::vector<MeasuredMap>& maps, const Column& column) {
    std::vector<double> values;
    for (const MeasuredMap& map : maps)
        if (const double value = column.value(map); !std::isnan(value)) values.push_back(value);
    std::sort(values.begin(), values.end());
    return values;
}

double median(const std::vector<double>& sorted) {
    if (sorted.empty()) return std::nan("");
    const std::size_t middle = sorted.size() / 2;
    return sorted.size() % 2 == 1 ? sorted[middle] : 0.5 * (sorted[middle - 1] + sorted[middle]);
}

double worst(const std::vector<double>& sorted, Worst which) {
    if (sorted.empty()) return std::nan("");
    return which == Worst::largest ? sorted.back() : sorted.front();
}

}  // namespace

std::string head_of_table() {
    std::string head = "| map |";
    std::string rule = "|---|";
    for (const Column& column : columns()) {
        head += " " + column.title + " |";
        rule += "---|";
    }
    return head + '\n' + rule + '\n';
}

std::string row_of(const MeasuredMap& map) {
    std::string row = "| " + map.name + " |";
    for (const Column& column : columns())
        row += cell(column.value(map), column);
    return row + '\n';
}

std::string end_of_table(const std::vector<MeasuredMap>& maps) {
    std::string medians = "| **median** |";
    std::string worsts = "| **worst** |";
    for (const Column& column : columns()) {
        const std::vector<double> values = sorted_values(maps, column);
        medians += cell(median(values), column);
        worsts += cell(worst(values, column.worst), column);
    }
    std::string failures;
    for (const MeasuredMap& map : maps)
        for (const std::string& failure : map.failures)
            failures += "- " + map.name + ": " + failure + '\n';
    return medians + '\n' + worsts + "\n\n" +
           (failures.empty() ? "Every limit holds on all maps.\n" : "Failures:\n" + failures);
}

}  // namespace camdir::bench
