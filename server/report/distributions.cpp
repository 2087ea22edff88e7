#include "report/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "evaluation/statistics.hpp"
#include "render/page.hpp"
#include "report/markup.hpp"

namespace camdir::report {
namespace {

using evaluation::Judgement;

constexpr int chart_width = 400, chart_height = 220;  // of the chart without its letters
constexpr int left = 34, top = 8, bottom = 22, right = 12;
constexpr int points = 150;           // of a line
constexpr double decades = 1000.0;    // of a logarithmic axis: from its end / decades
constexpr double shown_share = 0.99;  // of each camera's values

struct Distribution {
    const char* name;
    const char* unit;
    bool logarithmic;
    std::function<double(const Judgement&)> value;
};

const Distribution all[] = {
    {"Deviation from the wanted distance", "units", false,
     [](const Judgement& j) { return j.distance_error; }},
    {"Angle off the view direction", "degrees", false, [](const Judgement& j) { return j.behind; }},
    {"Acceleration", "units/s\u00b2, logarithmic", true,
     [](const Judgement& j) { return j.motion.acceleration; }},
    {"Rotation", "degrees/s, logarithmic", true, [](const Judgement& j) { return j.motion.angular_speed; }},
};

struct Axis {
    double largest;
    bool logarithmic;

    [[nodiscard]] double x(double value) const {
        const double share = logarithmic
                                 ? 1.0 + std::log(std::max(value, 1e-300) / largest) / std::log(decades)
                                 : value / largest;
        return left + chart_width * std::clamp(share, 0.0, 1.0);
    }
};

double y(double share) {
    return top + chart_height * (1.0 - share);
}

// The line (x of a quantile, its share).
std::string line_of(std::vector<double> values, const Axis& axis) {
    std::ranges::sort(values);
    std::string path;
    for (int i = 0; i <= points; ++i) {
        const double share = static_cast<double>(i) / points;
        const auto rank = static_cast<std::size_t>(share * static_cast<double>(values.size() - 1));
        path += (path.empty() ? 'M' : 'L') + decimal(axis.x(values[rank]), 1) + ' ' + decimal(y(share), 1);
    }
    return path;
}

std::string grid(const Axis& axis) {
    std::string lines, letters;
    const auto text = [&](double x, double y, const char* anchor, const std::string& value) {
        letters += "<text x=\"" + decimal(x, 1) + "\" y=\"" + decimal(y, 1) + "\" text-anchor=\"" + anchor +
                   "\">" + value + "</text>";
    };
    for (const double share : {0.0, 0.25, 0.5, 0.75, 1.0}) {
        lines += 'M' + std::to_string(left) + ' ' + decimal(y(share), 1) + 'h' + std::to_string(chart_width);
        text(left - 5, y(share) + 4, "end", decimal(100.0 * share, 0));
    }
    const int parts = axis.logarithmic ? 3 : 4;  // of a logarithmic axis: decades
    for (int i = 0; i <= parts; ++i) {
        const double part = static_cast<double>(i) / parts;
        const double value =
            axis.logarithmic ? axis.largest / std::pow(decades, 1.0 - part) : axis.largest * part;
        const double x = left + chart_width * part;
        lines += 'M' + decimal(x, 1) + ' ' + std::to_string(top) + 'v' + std::to_string(chart_height);
        text(x, top + chart_height + 16, i == parts ? "end" : "middle", decimal(value, value < 10.0 ? 1 : 0));
    }
    return "<path class=\"grid\" d=\"" + lines + "\"/>" + letters;
}

std::string chart(const Subject& subject, const Distribution& distribution) {
    std::vector<std::vector<double>> values;
    double high = 0.0;
    for (const JudgedCamera& camera : subject.cameras) {
        values.push_back(evaluation::measured(camera.judgements, distribution.value));
        if (!values.back().empty()) high = std::max(high, evaluation::percentile(values.back(), shown_share));
    }
    const Axis axis{high > 0.0 ? render::round_up(high) : 1.0, distribution.logarithmic};
    std::string svg = "<svg viewBox=\"0 0 " + std::to_string(left + chart_width + right) + ' ' +
                      std::to_string(top + chart_height + bottom) + "\" role=\"img\" aria-label=\"" +
                      distribution.name + "\">" + grid(axis);
    for (std::size_t i = values.size(); i-- > 0;)
        if (!values[i].empty())
            svg +=
                "<path class=\"camera-" + std::to_string(i) + "\" d=\"" + line_of(values[i], axis) + "\"/>";
    return std::string("<figure><figcaption>") + distribution.name + " <small>" + distribution.unit +
           "</small></figcaption>" + svg + "</svg></figure>\n";
}

}  // namespace

std::string distributions(const Subject& subject) {
    std::string html =
        "<p>Per cent of the frames (upwards) in which the value is at most that (to the right).</p>"
        "<p class=\"legend\">";
    for (std::size_t i = 0; i < subject.cameras.size(); ++i)
        html += "<span><i class=\"key camera-" + std::to_string(i) + "\"></i>" +
                escape(subject.cameras[i].name) + "</span>";
    html += "</p>\n<div class=\"distributions\">\n";
    for (const Distribution& distribution : all)
        html += chart(subject, distribution);
    return html + "</div>\n";
}

}  // namespace camdir::report
