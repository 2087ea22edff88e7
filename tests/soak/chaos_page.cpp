#include "chaos_page.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "render/page.hpp"
#include "report/line.hpp"
#include "report/markup.hpp"
#include "report/style.hpp"

namespace camdir::soak {
namespace {

using report::decimal;
using report::escape;
using report::Sample;

constexpr int columns = 1000;  // of a chart, each a step of its picture
constexpr int rows = 400;
constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

using Value = std::function<double(const Slice&)>;  // NaN: none

struct Chart {
    std::string name, unit;
    std::vector<std::pair<std::string, Value>> lines;
};

Value of_director(std::size_t index, const std::function<double(const Usage&)>& value) {
    return [=](const Slice& slice) {
        return slice.directors[index] ? value(*slice.directors[index]) : no_value;
    };
}

Chart of_directors(const Timeline& timeline, const std::string& name, const std::string& unit,
                   const std::function<double(const Usage&)>& value) {
    Chart chart{name, unit, {}};
    for (std::size_t i = 0; i < static_cast<std::size_t>(timeline.scenario.directors); ++i)
        chart.lines.emplace_back("director " + std::to_string(i), of_director(i, value));
    return chart;
}

double when_seen(const Slice& slice, double value) {
    return slice.seen.frames > 0 ? value : no_value;
}

std::vector<Chart> charts_of(const Timeline& timeline) {
    return {{"Latency",
             "ms",
             {{"p50", [](const Slice& s) { return when_seen(s, 1e3 * s.seen.p50_s); }},
              {"p99", [](const Slice& s) { return when_seen(s, 1e3 * s.seen.p99_s); }}}},
            {"Longest gap", "ms", {{"of an observer", [](const Slice& s) { return 1e3 * s.seen.gap_s; }}}},
            {"Frames lost",
             "",
             {{"of all observers", [](const Slice& s) { return static_cast<double>(s.seen.lost); }}}},
            of_directors(timeline, "Memory", "MiB", &Usage::resident_mib),
            of_directors(timeline, "Descriptors", "", &Usage::descriptors),
            of_directors(timeline, "Threads", "", &Usage::threads),
            {"Machine's stall", "ms", {{"longest", [](const Slice& s) { return 1e3 * s.stall_s; }}}}};
}

double duration_of(const Timeline& timeline) {
    return timeline.slices.empty() ? 1.0 : timeline.slices.back().end;
}

// As lines from the top to the bottom of a chart.
std::string marks(const Timeline& timeline) {
    std::string svg;
    for (const ActRecord& act : timeline.acts) {
        const long x = std::lround(act.begin / duration_of(timeline) * columns);
        svg += "<path class=\"cut\" d=\"M" + std::to_string(x) + " 0v" + std::to_string(rows) + "\"><title>" +
               name_of(act.act.kind) + " at " + decimal(act.begin, 1) + " s</title></path>";
    }
    return svg;
}

std::string line(const Timeline& timeline, const Value& value, double largest) {
    std::vector<Sample> samples;
    for (const Slice& slice : timeline.slices)
        samples.push_back({slice.begin, value(slice)});
    const double duration = duration_of(timeline);
    return report::path_of(report::decimate(samples, duration, columns), {duration, largest, columns, rows});
}

double largest_of(const Chart& chart, const Timeline& timeline) {
    double largest = 0.0;
    for (const auto& [name, value] : chart.lines)
        for (const Slice& slice : timeline.slices)
            largest = std::fmax(largest, value(slice));
    return largest > 0.0 ? render::round_up(largest) : 1.0;
}

std::string html_of(const Chart& chart, const Timeline& timeline) {
    const double largest = largest_of(chart, timeline);
    std::string legend, lines;
    for (std::size_t i = 0; i < chart.lines.size(); ++i) {
        const auto& [name, value] = chart.lines[i];
        const std::string camera = "camera-" + std::to_string(i);
        legend += "<br><i class=\"key " + camera + "\"></i>" + name;
        lines += "<path class=\"line " + camera + "\" d=\"" + line(timeline, value, largest) + "\"/>";
    }
    return "<figure class=\"chart\"><figcaption>" + chart.name + " <small>" + chart.unit + legend +
           "</small></figcaption><div class=\"ticks\"><span>" + decimal(largest, 1) + "</span><span>" +
           decimal(largest / 2.0, 1) + "</span><span>0</span></div><svg class=\"plot\" viewBox=\"0 -10 " +
           std::to_string(columns) + ' ' + std::to_string(rows + 20) + "\" preserveAspectRatio=\"none\">" +
           marks(timeline) + lines + "</svg></figure>\n";
}

std::string time_axis(const Timeline& timeline) {
    constexpr int parts = 5;
    std::string html = "<div class=\"times\">";
    for (int i = 0; i <= parts; ++i)
        html += "<span>" + decimal(duration_of(timeline) * i / parts, 1) + " s</span>";
    return html + "</div>\n";
}

std::string row(const std::vector<std::string>& cells) {
    std::string html = "<tr><th>" + escape(cells.front()) + "</th>";
    for (std::size_t i = 1; i < cells.size(); ++i)
        html += "<td>" + escape(cells[i]) + "</td>";
    return html + "</tr>\n";
}

std::string table(const std::string& heading, const std::string& body) {
    return "<div class=\"table\"><table><thead>" + heading + "</thead><tbody>\n" + body +
           "</tbody></table></div>\n";
}

std::string verdict_table(const std::vector<Check>& checks) {
    std::string body;
    for (const Check& check : checks)
        body += row({check.what, check.seen, check.allowed, name_of(check.verdict)});
    return table("<tr><th></th><th>seen</th><th>allowed</th><th></th></tr>", body);
}

std::string act_table(const Timeline& timeline) {
    std::string body;
    for (const ActRecord& act : timeline.acts) {
        const ActFindings found = findings_of(act, timeline);
        body += row({name_of(act.act.kind), decimal(act.begin, 1), decimal(act.end, 1),
                     decimal(1e3 * found.gap_s, 0), std::to_string(found.lost), decimal(found.back_s, 1),
                     act.failure});
    }
    return table(
        "<tr><th></th><th>from s</th><th>to s</th><th>longest gap ms</th><th>frames lost</th><th>back "
        "after s</th><th></th></tr>",
        body);
}

std::string section(const std::string& title, const std::string& content) {
    return "<section><h2>" + title + "</h2>\n" + content + "</section>\n";
}

}  // namespace

std::string to_html(const Timeline& timeline, const std::vector<Check>& checks) {
    const bool passed = std::ranges::none_of(checks, is_failed);
    const std::string title = std::string("Chaos: ") + (passed ? "passed" : "FAILED");
    std::string plots;
    for (const Chart& chart : charts_of(timeline))
        plots += html_of(chart, timeline);
    return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
           "content=\"width=device-width,initial-scale=1\"><title>" +
           title + "</title><style>" + report::style + "</style></head><body>\n<header><h1>" + title +
           "</h1></header><main>\n" + section("Verdict", verdict_table(checks)) +
           section("Over time", "<p>Dashed lines: acts; point at them for their names.</p>\n" + plots +
                                    time_axis(timeline)) +
           section("Acts", act_table(timeline)) + "</main></body></html>\n";
}

}  // namespace camdir::soak
