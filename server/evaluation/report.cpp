#include "evaluation/report.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace camdir::evaluation {
namespace {

struct Figure {
    const char* name;
    const char* unit;
    int decimals;
    double Metrics::*value;
};

struct SpreadFigure {
    const char* name;
    const char* unit;
    Spread Metrics::*value;
};

constexpr Figure frame_figures[] = {
    {"good", "%", 2, &Metrics::good},
    {"visible_head", "%", 2, &Metrics::visible_head},
    {"visible_body", "%", 2, &Metrics::visible_body},
    {"clearance_lt4", "%", 2, &Metrics::clearance_lt4},
    {"in_solid", "%", 2, &Metrics::in_solid},
    {"fly_through", "%", 2, &Metrics::fly_through},
    {"dist_err", "units", 2, &Metrics::dist_err},
    {"dist_err_p95", "units", 2, &Metrics::dist_err_p95},
    {"too_close", "%", 2, &Metrics::too_close},
    {"behind", "deg", 2, &Metrics::behind},
    {"behind_p95", "deg", 2, &Metrics::behind_p95},
    {"in_frame", "%", 2, &Metrics::in_frame},
};

constexpr SpreadFigure spread_figures[] = {
    {"acc", "units/s^2", &Metrics::acc},
    {"jerk", "units/s^3", &Metrics::jerk},
    {"ang_speed", "deg/s", &Metrics::ang_speed},
    {"ang_acc", "deg/s^2", &Metrics::ang_acc},
};

constexpr Figure shot_figures[] = {
    {"comfort", "%", 2, &Metrics::comfort}, {"max_rotation", "deg", 2, &Metrics::max_rotation},
    {"pops", "/min", 2, &Metrics::pops},    {"max_speed", "units/s", 0, &Metrics::max_speed},
    {"cuts", "/min", 2, &Metrics::cuts},    {"cuts_at_events", "/min", 2, &Metrics::cuts_at_events},
};

constexpr const char* kill_in_view = "kill_in_view";

std::string number(double value, int decimals) {
    if (std::isnan(value)) return "-";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string line(const char* name, const std::string& value, const char* unit) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%-16s %s %s\n", name, value.c_str(), unit);
    return text.data();
}

}  // namespace

std::string to_json(const Metrics& metrics) {
    nlohmann::ordered_json json;
    for (const Figure& figure : frame_figures)
        json[figure.name] = metrics.*figure.value;
    for (const SpreadFigure& figure : spread_figures) {
        const Spread& spread = metrics.*figure.value;
        json[figure.name] = {{"rms", spread.rms}, {"p95", spread.p95}, {"p99", spread.p99}};
    }
    for (const Figure& figure : shot_figures)
        json[figure.name] = metrics.*figure.value;
    if (metrics.kill_in_view) json[kill_in_view] = *metrics.kill_in_view;
    return json.dump(2) + "\n";
}

std::string to_table(const Metrics& metrics) {
    std::string table;
    const auto add = [&](const Figure& figure) {
        table += line(figure.name, number(metrics.*figure.value, figure.decimals), figure.unit);
    };
    for (const Figure& figure : frame_figures)
        add(figure);
    for (const SpreadFigure& figure : spread_figures) {
        const Spread& spread = metrics.*figure.value;
        table += line(figure.name,
                      "rms " + number(spread.rms, 0) + "  p95 " + number(spread.p95, 0) + "  p99 " +
                          number(spread.p99, 0),
                      figure.unit);
    }
    for (const Figure& figure : shot_figures)
        add(figure);
    if (metrics.kill_in_view) table += line(kill_in_view, number(*metrics.kill_in_view, 2), "%");
    return table;
}

}  // namespace camdir::evaluation
