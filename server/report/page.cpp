#include "report/page.hpp"

#include <algorithm>

#include "evaluation/figures.hpp"
#include "report/charts.hpp"
#include "report/comparison.hpp"
#include "report/distributions.hpp"
#include "report/faults.hpp"
#include "report/film_strip.hpp"
#include "report/floor_plan.hpp"
#include "report/frame.hpp"
#include "report/markup.hpp"
#include "report/moments.hpp"
#include "report/style.hpp"

namespace camdir::report {
namespace {

constexpr std::size_t max_moments = 9;

std::string player_choice(const evaluation::Trace& trace) {
    std::string html =
        "<nav hidden><div><span>Show</span><button value=\"\" aria-pressed=\"true\">all players</button>";
    for (const std::uint32_t player : trace.players) {
        const std::string number = std::to_string(player);
        html += "<button value=\"" + number + "\" aria-pressed=\"false\">" + number + "</button>";
    }
    return html + "</div></nav>\n";
}

// The film of the same moment, drawn by the game that has the map.
std::string film_command(const Subject& subject, const Moment& moment, std::size_t number) {
    const auto [begin, end] = strip_interval(moment, subject.trace);
    return "deploy/film.sh " + shell_word(subject.scene.name) + ' ' +
           shell_word(subject.cameras_file.empty() ? "cameras.csv" : subject.cameras_file) + ' ' +
           shell_word(subject.trace_file) + " --players " +
           std::to_string(subject.trace.players[moment.player]) + " --seconds " +
           decimal(std::max(0.0, begin - 1.0), 2) + ',' + decimal(end + 1.0, 2) + " -o moment-" +
           std::to_string(number) + ".mp4";
}

bool is_filmed(const Subject& subject) {
    return subject.scene.kind.find("Quake 3") != std::string::npos;
}

std::string about_moments(const Subject& subject) {
    std::string html =
        "<p>What the camera saw then: the players as simple figures with a dark nose, the followed one's eye "
        "ringed, and the middle of the picture, in which the eye should be. A mouse pointer enlarges "
        "them.</p>\n" +
        fault_legend();
    if (!is_filmed(subject)) return html;
    html += "<p>The commands film the same moment with OpenArena's renderer, where that game has the map";
    if (subject.cameras_file.empty())
        html += ", after <code>camera-director evaluate ... --cameras cameras.csv</code>";
    return html + ".</p>\n";
}

Result<std::string> article(const Subject& subject, const Moment& moment, std::size_t number,
                            const std::stop_token& stop) {
    const auto strip = film_strip(subject, moment, stop);
    if (!strip) return strip;
    const std::string player = std::to_string(subject.trace.players[moment.player]);
    const double begin = seconds_at(subject.trace, moment.frames.first);
    std::string html = "<article data-player=\"" + player + "\"><h3>" + std::to_string(number) + ". Player " +
                       player + " at " + evaluation::format_value(begin, 2) + " s</h3><p>" +
                       describe(moment, subject.trace, subject.cameras.front().judgements) + ".</p>\n" +
                       *strip;
    if (is_filmed(subject))
        html += "<pre><code>" + escape(film_command(subject, moment, number)) + "</code></pre>";
    return html + "</article>\n";
}

Result<std::string> moments(const Subject& subject, const ProgressSink& progress,
                            const std::stop_token& stop) {
    const auto worst = worst_moments(subject.trace, subject.cameras.front().judgements, max_moments);
    if (worst.empty()) return "<p>None: no frame was counted in which anything was wrong or moved.</p>\n";
    std::string html = about_moments(subject);
    for (std::size_t i = 0; i < worst.size(); ++i) {
        progress(i, worst.size());
        const auto shown = article(subject, worst[i], i + 1, stop);
        if (!shown) return shown;
        html += *shown;
    }
    return html;
}

Result<std::string> plan(const Subject& subject, const std::stop_token& stop) {
    const auto svg = floor_plan(subject, stop);
    if (!svg) return svg;
    return "<p>From above: the ways of the players (wide) and of their cameras (thin). A disc marks where "
           "the camera was while it was not good: its colour is the most frequent fault, its size how long "
           "it lasted; point at it for more.</p>" +
           fault_legend() + *svg;
}

}  // namespace

Result<std::string> to_html(const Subject& subject, const ProgressSink& progress,
                            const std::stop_token& stop) {
    const auto worst = moments(subject, progress, stop);
    if (!worst) return worst;
    const auto from_above = plan(subject, stop);
    if (!from_above) return from_above;
    return head(subject.cameras.front().name + " on " + subject.scene.name, subject.facts) +
           player_choice(subject.trace) + "<main data-duration=\"" + decimal(duration(subject.trace), 3) +
           "\">\n" + section("figures", "Figures", comparison(subject)) +
           section("moments", "The worst moments", *worst) + section("plan", "Floor plan", *from_above) +
           section("series", "Over time", charts(subject)) +
           section("distributions", "Distributions", distributions(subject)) + "</main>\n<script>" + script +
           "</script>\n</body></html>\n";
}

}  // namespace camdir::report
