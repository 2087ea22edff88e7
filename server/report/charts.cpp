#include "report/charts.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>

#include "evaluation/figures.hpp"
#include "evaluation/statistics.hpp"
#include "render/page.hpp"
#include "report/faults.hpp"
#include "report/line.hpp"
#include "report/markup.hpp"
#include "report/runs.hpp"

namespace camdir::report {
namespace {

using evaluation::Judgement;
using evaluation::Thresholds;

constexpr int columns = 700;  // of a chart, each a step of its picture
constexpr int rows = 400;
constexpr double axis_share = 0.998;  // of the values; the others are cut off at the top

struct Series {
    std::string name;
    std::string unit;
    std::function<double(const Judgement&)> value;
    double largest = evaluation::unmeasured;  // of the axis; unmeasured: from the values
    double low = evaluation::unmeasured;      // of the band of values that are good, in the axis
    double high = evaluation::unmeasured;
};

std::vector<Series> all_series(const Thresholds& limits) {
    return {
        {"Distance", "units", [](const Judgement& j) { return j.distance; }, 2.0 * limits.distance,
         limits.distance - limits.distance_error, limits.distance + limits.distance_error},
        {"Clearance", "units", [](const Judgement& j) { return j.clearance; }, limits.largest_clearance,
         limits.clearance, limits.largest_clearance},
        {"Body visible", "%",
         [](const Judgement& j) {
             return j.counted ? 100.0 * j.body_points / evaluation::body_point_count : evaluation::unmeasured;
         },
         100.0},
        {"Speed", "units/s", [](const Judgement& j) { return j.speed; }},
        {"Acceleration", "units/s\u00b2", [](const Judgement& j) { return j.motion.acceleration; }},
        {"Rotation", "deg/s", [](const Judgement& j) { return j.motion.angular_speed; }},
    };
}

// The axis' end where the series has none of its own: one for all players.
void scale(Series& series, const std::vector<Judgement>& judgements) {
    if (!std::isnan(series.largest)) return;
    const double high = evaluation::percentile(evaluation::measured(judgements, series.value), axis_share);
    series.largest = high > 0.0 ? render::round_up(high) : 1.0;
}

std::string rectangle(long x, long y, long width, long height) {
    return 'M' + std::to_string(x) + ' ' + std::to_string(y) + 'h' + std::to_string(width) + 'v' +
           std::to_string(height) + 'h' + std::to_string(-width) + 'z';
}

class PlayerCharts {
  public:
    PlayerCharts(const Subject& subject, const std::vector<Series>& series, std::size_t player)
        : subject_(subject),
          series_(series),
          number_(std::to_string(subject.trace.players[player])),
          track_(evaluation::track_of(subject.trace, subject.trace.players[player])) {}

    // The block is open or folded.
    [[nodiscard]] std::string html(bool open) const {
        std::string html = std::string("<details class=\"player\"") + (open ? " open" : "") +
                           " data-player=\"" + number_ + "\"><summary><span>Player " + number_ +
                           "</span><span class=\"good\">" + good() + "</span>" + ribbon() +
                           "</summary>\n<svg class=\"definitions\"><defs>" + background() + "</defs></svg>\n";
        for (const Series& series : series_)
            html += chart(series);
        return html + faults_chart() + time_axis() + "</details>\n";
    }

  private:
    // Null: the player has no pose in this frame.
    [[nodiscard]] const Judgement* at(const JudgedCamera& camera, std::size_t frame) const {
        return track_[frame] == evaluation::absent ? nullptr : &camera.judgements[track_[frame]];
    }
    [[nodiscard]] const JudgedCamera& own() const { return subject_.cameras.front(); }

    [[nodiscard]] std::string good() const {
        std::vector<Judgement> judgements;
        for (std::size_t frame = 0; frame < track_.size(); ++frame)
            if (const Judgement* judgement = at(own(), frame)) judgements.push_back(*judgement);
        return "good " + evaluation::format_value(evaluation::summarise(judgements).good, 1) + " %";
    }

    [[nodiscard]] long column(std::size_t frame) const {
        const std::size_t known = std::min(frame, track_.size() - 1);
        return std::lround(seconds_at(subject_.trace, known) / duration(subject_.trace) * columns);
    }

    // Where holds(judgement or null), as bars from `y` on, at least a column wide.
    template <class Holds>
    [[nodiscard]] std::string bars(const Holds& holds, long y, long height) const {
        std::string path;
        long end = -1;
        for (const Run& run :
             runs_where(track_.size(), [&](std::size_t frame) { return holds(at(own(), frame)); })) {
            const long from = std::max(column(run.first), end);
            const long to = std::max(column(run.last), from + (from == end ? 0 : 1));
            if (to > from) path += rectangle(from, y, to - from, height);
            end = to;
        }
        return path;
    }

    [[nodiscard]] std::string uncounted(long height) const {
        return "<path class=\"uncounted\" d=\"" +
               bars([](const Judgement* j) { return j == nullptr || !j->counted; }, 0, height) + "\"/>";
    }

    [[nodiscard]] std::string fault_bars(const FaultName& name, long y, long height) const {
        const auto has = [&](const Judgement* j) { return j != nullptr && (j->faults & name.fault) != 0; };
        return std::string("<path class=\"fault-") + name.key + "\" d=\"" + bars(has, y, height) + "\"/>";
    }

    // All faults in one row; the worst is drawn last.
    [[nodiscard]] std::string ribbon() const {
        std::string svg = open_svg("ribbon", 10) + uncounted(10);
        for (std::size_t i = std::size(fault_names); i-- > 0;)
            svg += fault_bars(fault_names[i], 0, 10);
        return svg + "</svg>";
    }

    // With `margin` above and below, so that lines at the ends of the axis are seen.
    [[nodiscard]] static std::string open_svg(const std::string& kind, int height, int margin = 0) {
        return "<svg class=\"" + kind + "\" viewBox=\"0 " + std::to_string(-margin) + ' ' +
               std::to_string(columns) + ' ' + std::to_string(height + 2 * margin) +
               "\" preserveAspectRatio=\"none\" aria-hidden=\"true\">";
    }

    // What all charts of the player have: what is not counted, and cuts.
    [[nodiscard]] std::string background() const {
        std::string cuts;
        long last = -1;
        for (std::size_t frame = 0; frame < track_.size(); ++frame) {
            const Judgement* judgement = at(own(), frame);
            if (judgement == nullptr || !judgement->cut || column(frame) == last) continue;
            last = column(frame);
            cuts += 'M' + std::to_string(last) + " 0v" + std::to_string(rows);
        }
        return "<g id=\"background-" + number_ + "\">" + uncounted(rows) + "<path class=\"cut\" d=\"" + cuts +
               "\"/></g>";
    }

    [[nodiscard]] std::string line_of(const JudgedCamera& camera, const Series& series) const {
        std::vector<Sample> samples;
        for (std::size_t frame = 0; frame < track_.size(); ++frame) {
            const Judgement* judgement = at(camera, frame);
            samples.push_back({seconds_at(subject_.trace, frame),
                               judgement == nullptr ? evaluation::unmeasured : series.value(*judgement)});
        }
        const double end = duration(subject_.trace);
        return path_of(decimate(samples, end, columns), {end, series.largest, columns, rows});
    }

    [[nodiscard]] std::string chart(const Series& series) const {
        std::string svg = open_svg("plot", rows, 10) + "<use href=\"#background-" + number_ + "\"/>";
        if (!std::isnan(series.low)) {
            const auto row = [&](double value) { return std::lround((1.0 - value / series.largest) * rows); };
            svg += "<path class=\"band\" d=\"" +
                   rectangle(0, row(series.high), columns, row(series.low) - row(series.high)) + "\"/>";
        }
        if (subject_.cameras.size() > 1)
            svg += "<path class=\"line camera-1\" d=\"" + line_of(subject_.cameras[1], series) + "\"/>";
        svg += "<path class=\"line camera-0\" d=\"" + line_of(own(), series) + "\"/></svg>";
        return "<figure class=\"chart\"><figcaption>" + series.name + " <small>" + series.unit +
               "</small></figcaption><div class=\"ticks\"><span>" + decimal(series.largest, 1) +
               "</span><span>" + decimal(series.largest / 2.0, 1) + "</span><span>0</span></div>" + svg +
               "</figure>\n";
    }

    [[nodiscard]] std::string faults_chart() const {
        constexpr int height = 20;
        std::string svg = open_svg("plot", static_cast<int>(std::size(fault_names)) * height) +
                          uncounted(height * static_cast<long>(std::size(fault_names)));
        std::string names;
        long y = 0;
        for (const FaultName& name : fault_names) {
            names += std::string("<span>") + name.text + "</span>";
            svg += fault_bars(name, y + 3, height - 6);
            y += height;
        }
        return "<figure class=\"chart\"><figcaption class=\"rows\">" + names + "</figcaption>" + svg +
               "</svg></figure>\n";
    }

    [[nodiscard]] std::string time_axis() const {
        constexpr int parts = 5;
        std::string html = "<div class=\"times\">";
        for (int i = 0; i <= parts; ++i)
            html += "<span>" + decimal(duration(subject_.trace) * i / parts, 1) + " s</span>";
        return html + "</div>\n";
    }

    const Subject& subject_;
    const std::vector<Series>& series_;
    std::string number_;
    std::vector<std::uint32_t> track_;
};

// The positions in trace.players of those who get charts, ascending.
std::vector<std::size_t> charted_players(const Subject& subject) {
    const auto& players = subject.trace.players;
    std::vector<std::size_t> bad(players.size());
    for (std::size_t i = 0; i < subject.trace.poses.size(); ++i) {
        const auto place = std::ranges::lower_bound(players, subject.trace.poses[i].player);
        bad[static_cast<std::size_t>(place - players.begin())] +=
            subject.cameras.front().judgements[i].faults != 0;
    }
    std::vector<std::size_t> chosen(players.size());
    for (std::size_t i = 0; i < chosen.size(); ++i)
        chosen[i] = i;
    std::ranges::stable_sort(chosen, std::greater<>(), [&](std::size_t i) { return bad[i]; });
    chosen.resize(std::min(chosen.size(), max_charted_players));
    std::ranges::sort(chosen);
    return chosen;
}

std::string legend_entry(const std::string& key, const std::string& meaning) {
    return "<span><i class=\"key " + key + "\"></i>" + meaning + "</span>";
}

std::string legend(const Subject& subject) {
    std::string html = "<p class=\"legend\">" + legend_entry("camera-0", escape(subject.cameras[0].name));
    if (subject.cameras.size() > 1) html += legend_entry("camera-1", escape(subject.cameras[1].name));
    return html + legend_entry("band", "good") +
           legend_entry("uncounted", "not counted: dead, absent or just spawned") +
           legend_entry("cut", "cut") + "</p>\n" + fault_legend();
}

}  // namespace

std::string charts(const Subject& subject) {
    std::vector<Series> series = all_series(Thresholds(subject.scene.metres_per_unit));
    for (Series& one : series)
        scale(one, subject.cameras.front().judgements);
    const auto players = charted_players(subject);
    std::string html = legend(subject);
    if (players.size() < subject.trace.players.size())
        html += "<p>Of the " + std::to_string(subject.trace.players.size()) + " players the " +
                std::to_string(players.size()) + " with the most frames that are not good.</p>\n";
    for (const std::size_t player : players)
        html += PlayerCharts(subject, series, player).html(player == players.front());
    return html;
}

}  // namespace camdir::report
