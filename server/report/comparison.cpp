#include "report/comparison.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string_view>

#include "evaluation/figures.hpp"
#include "report/markup.hpp"

namespace camdir::report {
namespace {

using evaluation::Figure;

constexpr std::string_view main_figures[] = {"good",     "visible_head", "in_solid",      "pops",
                                             "dist_err", "acc.p95",      "ang_speed.p95", "comfort"};

// One row a figure, one value a camera.
struct Row {
    Figure figure;  // the first camera's
    std::vector<double> values;

    [[nodiscard]] std::string text(std::size_t camera) const {
        return evaluation::format_value(values[camera], figure.decimals);
    }
};

std::vector<Row> rows_of(const Subject& subject) {
    std::vector<Row> rows;
    for (const JudgedCamera& camera : subject.cameras) {
        const auto figures = evaluation::figures_of(camera.metrics);
        for (std::size_t i = 0; i < figures.size(); ++i) {
            if (rows.size() <= i) rows.push_back({figures[i], {}});
            rows[i].values.push_back(figures[i].value);
        }
    }
    return rows;
}

// The shortest text that reads as the same number.
std::string exact(double value) {
    if (std::isnan(value)) return "";
    std::array<char, 64> digits{};
    return {digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), value).ptr};
}

// The cameras that show the best value, where not all show the same.
bool is_best(const Row& row, std::size_t camera) {
    if (row.figure.better == Figure::Better::neither || std::isnan(row.values[camera])) return false;
    bool differs = false;
    for (std::size_t i = 0; i < row.values.size(); ++i) {
        if (row.text(i) == row.text(camera) || std::isnan(row.values[i])) continue;
        differs = true;
        const bool more = row.values[camera] > row.values[i];
        if (more != (row.figure.better == Figure::Better::more)) return false;
    }
    return differs;
}

std::string tiles(const Subject& subject, const std::vector<Row>& rows) {
    std::string html = "<div class=\"tiles\">";
    for (const std::string_view name : main_figures) {
        const auto row =
            std::ranges::find(rows, name, [](const Row& r) -> std::string_view { return r.figure.name; });
        html += "<div title=\"" + escape(row->figure.meaning) + "\"><small>" + row->figure.name +
                "</small><b>" + row->text(0) + " <small>" + row->figure.unit + "</small></b>";
        if (subject.cameras.size() > 1)
            html += "<small>" + escape(subject.cameras[1].name) + ": " + row->text(1) + "</small>";
        html += "</div>";
    }
    return html + "</div>\n";
}

// A Spread has one meaning for its three figures.
bool repeats(const Row& row) {
    return row.figure.name.ends_with(".p95") || row.figure.name.ends_with(".p99");
}

std::string table(const Subject& subject, const std::vector<Row>& rows) {
    std::string html = "<div class=\"table\"><table><thead><tr><th></th>";
    for (const JudgedCamera& camera : subject.cameras)
        html += "<th>" + escape(camera.name) + "</th>";
    html += "<th></th></tr></thead><tbody>\n";
    for (const Row& row : rows) {
        html += "<tr id=\"" + row.figure.name + "\"><th>" + row.figure.name + " <small>" + row.figure.unit +
                "</small></th>";
        for (std::size_t camera = 0; camera < row.values.size(); ++camera)
            html += std::string(is_best(row, camera) ? "<td class=\"best\">" : "<td>") + "<data value=\"" +
                    exact(row.values[camera]) + "\">" + row.text(camera) + "</data></td>";
        html += "<td>" + (repeats(row) ? "" : escape(row.figure.meaning)) + "</td></tr>\n";
    }
    return html + "</tbody></table></div>\n";
}

std::string more_cameras(const Subject& subject) {
    if (subject.freespace_file.empty()) return {};
    return "<p>The same figures of the cameras that games use, spring arms among them, on this match "
           "(tests/bench/README.md describes them; <code>cmake --build --preset release --target "
           "bench-cameras</code> builds it):</p><pre><code>bench-cameras " +
           escape(
               shell_word(subject.freespace_file + ',' + subject.scene.source + ',' + subject.trace_file)) +
           "</code></pre>\n";
}

}  // namespace

std::string comparison(const Subject& subject) {
    const auto rows = rows_of(subject);
    return tiles(subject, rows) +
           "<p>Judged by rays and nearest points on the source map, over frames in which the player is alive "
           "and more than 0.5 s after a respawn or teleport. The limits are units of 0.0254 m. rms: root "
           "mean square; p95, p99: percentiles. Green: the best of a row.</p>\n" +
           table(subject, rows) + more_cameras(subject);
}

}  // namespace camdir::report
