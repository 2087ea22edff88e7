#include "bench/cameras/table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "evaluation/figures.hpp"

namespace camdir::bench {
namespace {

struct Figure {
    const char* name;
    int decimals;
    double (*value)(const Row& row);
};

constexpr Figure figures[] = {
    {"good", 1, [](const Row& row) { return row.metrics.good; }},
    {"visible_head", 2, [](const Row& row) { return row.metrics.visible_head; }},
    {"clearance_lt4", 2, [](const Row& row) { return row.metrics.clearance_lt4; }},
    {"in_solid", 2, [](const Row& row) { return row.metrics.in_solid; }},
    {"fly_through", 2, [](const Row& row) { return row.metrics.fly_through; }},
    {"dist_err", 1, [](const Row& row) { return row.metrics.dist_err; }},
    {"too_close", 1, [](const Row& row) { return row.metrics.too_close; }},
    {"behind", 1, [](const Row& row) { return row.metrics.behind; }},
    {"in_frame", 1, [](const Row& row) { return row.metrics.in_frame; }},
    {"acc p95", 0, [](const Row& row) { return row.metrics.acc.p95; }},
    {"acc p99", 0, [](const Row& row) { return row.metrics.acc.p99; }},
    {"ang_speed p95", 0, [](const Row& row) { return row.metrics.ang_speed.p95; }},
    {"comfort", 1, [](const Row& row) { return row.metrics.comfort; }},
    {"kill_in_view", 1, [](const Row& row) { return row.metrics.kill_in_view.value_or(std::nan("")); }},
    {"pops", 2, [](const Row& row) { return row.metrics.pops; }},
    {"cuts", 2, [](const Row& row) { return row.metrics.cuts; }},
    {"max_rotation", 1, [](const Row& row) { return row.metrics.max_rotation; }},
    {"ns p50", 0, [](const Row& row) { return row.ns_p50; }},
    {"ns p99", 0, [](const Row& row) { return row.ns_p99; }},
};
constexpr std::size_t figure_count = std::size(figures);

struct Line {
    std::string match;
    std::string camera;
    std::array<double, figure_count> values{};
};

Line line_of(const Row& row) {
    Line line{row.match, row.camera, {}};
    for (std::size_t i = 0; i < figure_count; ++i)
        line.values[i] = figures[i].value(row);
    return line;
}

Line mean_of(const std::string& camera, const std::vector<Line>& lines) {
    Line mean{"mean", camera, {}};
    for (std::size_t i = 0; i < figure_count; ++i) {
        double sum = 0.0;
        int count = 0;
        for (const Line& line : lines) {
            if (line.camera != camera || std::isnan(line.values[i])) continue;
            sum += line.values[i];
            ++count;
        }
        mean.values[i] = count == 0 ? evaluation::unmeasured : sum / count;
    }
    return mean;
}

std::vector<Line> lines_of(std::span<const Row> rows) {
    std::vector<Line> lines;
    std::vector<std::string> cameras;
    for (const Row& row : rows) {
        lines.push_back(line_of(row));
        if (std::ranges::find(cameras, row.camera) == cameras.end()) cameras.push_back(row.camera);
    }
    std::vector<Line> means;
    for (const std::string& camera : cameras)
        means.push_back(mean_of(camera, lines));
    lines.insert(lines.end(), means.begin(), means.end());
    return lines;
}

std::string cell(double value, int decimals) {
    return std::isnan(value) ? "" : evaluation::format_value(value, decimals);
}

}  // namespace

std::string to_markdown(std::span<const Row> rows) {
    std::string head = "| match | camera |";
    std::string rule = "|---|---|";
    for (const Figure& figure : figures) {
        head += std::string(" ") + figure.name + " |";
        rule += "---|";
    }
    std::string text = head + '\n' + rule + '\n';
    for (const Line& line : lines_of(rows)) {
        text += "| " + line.match + " | " + line.camera + " |";
        for (std::size_t i = 0; i < figure_count; ++i)
            text += ' ' + cell(line.values[i], figures[i].decimals) + " |";
        text += '\n';
    }
    return text;
}

std::string to_csv(std::span<const Row> rows) {
    std::string text = "match,camera";
    for (const Figure& figure : figures)
        text += std::string(",") + figure.name;
    text += '\n';
    for (const Line& line : lines_of(rows)) {
        text += line.match + ',' + line.camera;
        for (std::size_t i = 0; i < figure_count; ++i)
            text += ',' + cell(line.values[i], 6);
        text += '\n';
    }
    return text;
}

}  // namespace camdir::bench
