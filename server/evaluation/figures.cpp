#include "evaluation/figures.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

namespace camdir::evaluation {
namespace {

using Better = Figure::Better;

struct SingleFigure {
    const char* name;
    const char* unit;
    int decimals;
    double Metrics::*value;
    Figure::Better better;
    const char* meaning;
};

struct SpreadFigure {
    const char* name;
    const char* unit;
    Spread Metrics::*value;
    const char* meaning;
};

struct SpreadKey {
    const char* name;
    double Spread::*value;
};

constexpr SingleFigure frame_figures[] = {
    {"good", "%", 2, &Metrics::good, Better::more,
     "Frames in which nothing is wrong: the eye is visible and in frame, the clearance is at least 4 units, "
     "the distance is at most 60 units from the wanted 120, and the camera looks at most 60 degrees off the "
     "player's view direction."},
    {"visible_head", "%", 2, &Metrics::visible_head, Better::more,
     "Frames in which no obstacle is before the player's eye."},
    {"visible_body", "%", 2, &Metrics::visible_body, Better::more,
     "Mean share of nine points of the player's box that the camera sees."},
    {"clearance_lt4", "%", 2, &Metrics::clearance_lt4, Better::less,
     "Frames in which the camera is less than 4 units from an obstacle."},
    {"in_solid", "%", 2, &Metrics::in_solid, Better::less,
     "Frames in which the camera is in an obstacle or outside the map."},
    {"fly_through", "%", 2, &Metrics::fly_through, Better::less,
     "Steps without a cut that pass through an obstacle."},
    {"dist_err", "units", 2, &Metrics::dist_err, Better::less,
     "Mean deviation from the wanted distance of 120 units."},
    {"dist_err_p95", "units", 2, &Metrics::dist_err_p95, Better::less, "Its 95th percentile."},
    {"too_close", "%", 2, &Metrics::too_close, Better::less,
     "Frames nearer than a third of the wanted distance."},
    {"behind", "deg", 2, &Metrics::behind, Better::less,
     "Mean angle between the line from the camera to the eye and the player's view direction."},
    {"behind_p95", "deg", 2, &Metrics::behind_p95, Better::less, "Its 95th percentile."},
    {"in_frame", "%", 2, &Metrics::in_frame, Better::more,
     "Frames with the eye in the central 60 % of a picture 90 degrees wide, 16:9."},
};

constexpr SpreadFigure spread_figures[] = {
    {"acc", "units/s^2", &Metrics::acc, "The camera's acceleration."},
    {"jerk", "units/s^3", &Metrics::jerk, "The change of its acceleration."},
    {"ang_speed", "deg/s", &Metrics::ang_speed, "How fast the camera turns."},
    {"ang_acc", "deg/s^2", &Metrics::ang_acc, "The change of its angular velocity."},
};

constexpr SpreadKey spread_keys[] = {{"rms", &Spread::rms}, {"p95", &Spread::p95}, {"p99", &Spread::p99}};

constexpr SingleFigure shot_figures[] = {
    {"comfort", "%", 2, &Metrics::comfort, Better::more,
     "Frames that turn at most at 120 degrees/s and in which a distant background crosses less than half the "
     "picture a second, over the last second."},
    {"max_rotation", "deg", 2, &Metrics::max_rotation, Better::less, "The largest turn between two frames."},
    {"pops", "/min", 2, &Metrics::pops, Better::less,
     "Undeclared jumps: steps of more than 64 units and three times the eye's own."},
    {"max_speed", "units/s", 0, &Metrics::max_speed, Better::less,
     "The largest speed without a declared cut."},
    {"cuts", "/min", 2, &Metrics::cuts, Better::less, "Declared cuts that no respawn or teleport explains."},
    {"cuts_at_events", "/min", 2, &Metrics::cuts_at_events, Better::neither,
     "Declared cuts up to 100 ms after a respawn or teleport."},
};

constexpr const char* kill_in_view = "kill_in_view";

std::string line(const std::string& name, const std::string& value, const std::string& unit) {
    std::array<char, 160> text{};
    std::snprintf(text.data(), text.size(), "%-16s %s %s\n", name.c_str(), value.c_str(), unit.c_str());
    return text.data();
}

Figure figure_of(const SingleFigure& figure, const Metrics& metrics) {
    return {figure.name, figure.unit, figure.meaning, figure.decimals, figure.better, metrics.*figure.value};
}

Figure figure_of(const SpreadFigure& figure, const SpreadKey& key, const Metrics& metrics) {
    return {std::string(figure.name) + '.' + key.name, figure.unit, figure.meaning, 0, Better::less,
            metrics.*figure.value.*key.value};
}

}  // namespace

std::vector<Figure> figures_of(const Metrics& metrics) {
    std::vector<Figure> figures;
    for (const SingleFigure& figure : frame_figures)
        figures.push_back(figure_of(figure, metrics));
    for (const SpreadFigure& figure : spread_figures)
        for (const SpreadKey& key : spread_keys)
            figures.push_back(figure_of(figure, key, metrics));
    for (const SingleFigure& figure : shot_figures)
        figures.push_back(figure_of(figure, metrics));
    if (metrics.kill_in_view)
        figures.push_back({kill_in_view, "%", "Kills of the followed players that their camera showed.", 2,
                           Better::more, *metrics.kill_in_view});
    if (metrics.movers)
        for (const MoverFigureName& figure : mover_figure_names())
            figures.push_back({figure.name, figure.unit, figure.meaning, 0, Better::less,
                               static_cast<double>((*metrics.movers).*figure.member)});
    return figures;
}

std::string format_value(double value, int decimals) {
    if (std::isnan(value)) return "-";
    std::array<char, 64> text{};
    std::snprintf(text.data(), text.size(), "%.*f", decimals, value);
    return text.data();
}

std::string to_json(const Metrics& metrics) {
    nlohmann::ordered_json json;
    for (const Figure& figure : figures_of(metrics)) {
        const std::size_t dot = figure.name.find('.');
        if (dot == std::string::npos)
            json[figure.name] = figure.value;
        else
            json[figure.name.substr(0, dot)][figure.name.substr(dot + 1)] = figure.value;
    }
    return json.dump(2) + "\n";
}

std::string to_table(const Metrics& metrics) {
    std::string table;
    const auto add = [&](const SingleFigure& figure) {
        table += line(figure.name, format_value(metrics.*figure.value, figure.decimals), figure.unit);
    };
    for (const SingleFigure& figure : frame_figures)
        add(figure);
    for (const SpreadFigure& figure : spread_figures) {
        std::string values;
        for (const SpreadKey& key : spread_keys)
            values += (values.empty() ? "" : "  ") + std::string(key.name) + ' ' +
                      format_value(metrics.*figure.value.*key.value, 0);
        table += line(figure.name, values, figure.unit);
    }
    for (const SingleFigure& figure : shot_figures)
        add(figure);
    if (metrics.kill_in_view) table += line(kill_in_view, format_value(*metrics.kill_in_view, 2), "%");
    if (metrics.movers)
        for (const MoverFigureName& figure : mover_figure_names())
            table += line(figure.name, std::to_string((*metrics.movers).*figure.member), figure.unit);
    return table;
}

}  // namespace camdir::evaluation
