#include "report/programme_page.hpp"

#include <algorithm>

#include "evaluation/figures.hpp"
#include "report/frame.hpp"
#include "report/markup.hpp"

namespace camdir::report {
namespace {

using direction::Beat;
using direction::Index;
using direction::Shot;

constexpr std::size_t max_cuts = 60;  // in pictures
constexpr Beat row_beats = 600;       // a minute
constexpr int lane_height = 18;
constexpr int label_width = 60;
constexpr int beat_width = 2;

double seconds(Beat beat) {
    return static_cast<double>(beat) * direction::beat_s;
}

// Colours repeat after eight players; the lane has the number. Fixed cameras have one for themselves.
std::string colour(std::size_t rush, std::size_t players) {
    return rush < players ? "player-" + std::to_string(rush % 8) : "fixed";
}

std::string number(int value) {
    return std::to_string(value);
}

// "player 3", or "fixed camera 2", the map's shot 2.
std::string name_of(const ProgrammeSubject& subject, std::size_t rush) {
    const auto& players = subject.stage.trace.players;
    if (rush < players.size()) return "player " + std::to_string(players[rush]);
    return "fixed camera " + std::to_string(rush - players.size());
}

// Null where the player who is followed has no pose.
const evaluation::CameraSample* camera_of(const ProgrammeSubject& subject, std::size_t frame,
                                          std::size_t rush) {
    const evaluation::Trace& trace = subject.stage.trace;
    if (rush >= trace.players.size()) return &subject.fixed[rush - trace.players.size()];
    const std::uint32_t pose = evaluation::pose_of(trace, trace.frames[frame], trace.players[rush]);
    return pose == evaluation::absent ? nullptr : &subject.cameras[pose];
}

class Timeline {
  public:
    explicit Timeline(const ProgrammeSubject& subject)
        : subject_(subject),
          players_(subject.stage.trace.players),
          kills_(direction::kills_of(subject.events)),
          shown_(direction::kills_shown(subject.footage, subject.shots, kills_)) {}

    [[nodiscard]] std::string html() const {
        std::string html = legend();
        for (Beat begin = 0; begin < subject_.footage.beats(); begin += row_beats)
            html += row(begin);
        return html;
    }

  private:
    static std::string legend() {
        return "<p>A row a minute, a lane a player; the last one is of the fixed cameras. Wide: this camera "
               "is on the air; point at it for the reason. Thin: the player is in a moment. A disc is a kill "
               "on its killer's lane, a cross on its victim's: green where the programme shows one of them "
               "from 1 s before to 0.5 s after, red where not, grey where the recording lacks a part of that "
               "time. “kill 3-1”: player 3 kills player 1; whoever "
               "shows that best is on the air, perhaps neither of them.</p>\n";
    }

    [[nodiscard]] std::string row(Beat begin) const {
        const Beat end = std::min(begin + row_beats, subject_.footage.beats());
        const int height = top(players_.size() + 1) + 16;
        std::string svg = "<div class=\"table\"><svg class=\"timeline\" viewBox=\"0 0 " +
                          number(label_width + beat_width * 600) + ' ' + number(height) +
                          "\" role=\"img\" aria-label=\"Shots from " + decimal(seconds(begin), 0) + " s to " +
                          decimal(seconds(end), 0) + " s\">";
        svg += lanes() + seconds_axis(begin, end, height);
        for (const direction::Moment& moment : subject_.moments)
            if (subject_.rules.moments[moment.rule].is_on()) svg += moment_bars(moment, begin, end);
        for (std::size_t i = 0; i < subject_.shots.size(); ++i)
            svg += shot_bar(i, begin, end);
        for (std::size_t i = 0; i < kills_.size(); ++i)
            svg += kill_marks(i, begin, end);
        return svg + "</svg></div>\n";
    }

    [[nodiscard]] std::string lanes() const {
        std::string svg;
        for (std::size_t lane = 0; lane <= players_.size(); ++lane)
            svg += "<rect class=\"lane\" x=\"" + number(label_width) + "\" y=\"" + number(top(lane)) +
                   "\" width=\"" + number(beat_width * 600) + "\" height=\"" + number(lane_height - 2) +
                   "\"/><text x=\"0\" y=\"" + number(top(lane) + 13) + "\">" +
                   (lane < players_.size() ? std::to_string(players_[lane]) : "fixed") + "</text>";
        return svg;
    }

    [[nodiscard]] static std::string seconds_axis(Beat begin, Beat end, int height) {
        std::string svg;
        for (Beat beat = begin; beat <= end; beat += 100)
            svg += "<text class=\"tick\" x=\"" + number(x(beat, begin)) + "\" y=\"" + number(height - 2) +
                   "\">" + decimal(seconds(beat), 0) + " s</text>";
        return svg;
    }

    [[nodiscard]] std::string shot_bar(std::size_t i, Beat begin, Beat end) const {
        const Shot& shot = subject_.shots[i];
        if (shot.end <= begin || shot.begin >= end) return {};
        const int left = x(std::max(shot.begin, begin), begin);
        const int right = x(std::min(shot.end, end), begin);
        // The reason of a fixed camera's shot names it.
        const std::string who = shot.rush < players_.size() ? name_of(subject_, shot.rush) + ": " : "";
        return "<rect class=\"shot " + colour(shot.rush, players_.size()) + "\" x=\"" + number(left) +
               "\" y=\"" + number(top(std::min(shot.rush, players_.size())) + 3) + "\" width=\"" +
               number(right - left) + "\" height=\"10\"><title>" + decimal(seconds(shot.begin), 1) +
               " s to " + decimal(seconds(shot.end), 1) + " s, " + who + escape(subject_.reasons[i]) +
               "</title></rect>";
    }

    [[nodiscard]] std::string moment_bars(const direction::Moment& moment, Beat begin, Beat end) const {
        if (moment.end <= begin || moment.begin >= end) return {};
        const int left = x(std::max(moment.begin, begin), begin);
        const int right = x(std::min(moment.end, end), begin);
        std::string svg;
        for (const Index player : {moment.actor, moment.subject})
            if (player != direction::nobody)
                svg += "<rect class=\"moment\" x=\"" + number(left) + "\" y=\"" + number(top(player) + 14) +
                       "\" width=\"" + number(right - left) + "\" height=\"2\"><title>" +
                       escape(subject_.rules.moments[moment.rule].name) + "</title></rect>";
        return svg;
    }

    [[nodiscard]] std::string kill_marks(std::size_t i, Beat begin, Beat end) const {
        const direction::Kill& kill = kills_[i];
        const Beat beat = direction::beat_of(kill.time);
        if (beat < begin || beat >= end) return {};
        const std::string where = number(x(beat, begin));
        const bool counts = direction::kill_counts(subject_.footage, kill.time);
        const std::string seen = !counts ? "unjudged" : shown_[i] ? "seen" : "missed";
        const std::string title = "<title>" + decimal(kill.time, 1) +
                                  " s: " + std::to_string(players_[kill.killer]) + " kills " +
                                  std::to_string(players_[kill.victim]) + ", " + seen + "</title>";
        const int middle = top(kill.victim) + 8;
        return "<circle class=\"" + seen + "\" cx=\"" + where + "\" cy=\"" + number(top(kill.killer) + 8) +
               "\" r=\"5\">" + title + "</circle><path class=\"" + seen + "\" d=\"M" + where + ' ' +
               number(middle) + "m-4-4l8 8m0-8l-8 8\">" + title + "</path>";
    }

    static int top(std::size_t lane) { return static_cast<int>(lane) * lane_height; }
    static int x(Beat beat, Beat begin) { return label_width + static_cast<int>(beat - begin) * beat_width; }

    const ProgrammeSubject& subject_;
    const std::vector<std::uint32_t>& players_;
    std::vector<direction::Kill> kills_;
    std::vector<bool> shown_;  // of each kill
};

std::string figures(const ProgrammeSubject& subject) {
    std::string html = "<div class=\"table\"><table><thead><tr><th></th>";
    for (const JudgedProgramme& one : subject.judged)
        html += "<th>" + escape(one.name) + "</th>";
    html += "<th></th></tr></thead><tbody>";
    for (const direction::FigureName& figure : direction::figure_names()) {
        html += "<tr id=\"" + std::string(figure.name) + "\"><th>" + figure.name + "</th>";
        for (const JudgedProgramme& one : subject.judged)
            html += "<td><data value=\"" + decimal(one.figures.*figure.member, 6) + "\">" +
                    evaluation::format_value(one.figures.*figure.member, figure.decimals) + "</data></td>";
        html += "<td>" + escape(figure.meaning) + "</td></tr>";
    }
    return html + "</tbody></table></div>\n" +
           "<p>direction: by cameras that run all the time; running: as a running director shows it, whose "
           "cameras begin with its cuts; random: somebody else every 6 s; hltv, quakeworld: the rules of "
           "these; bound: the most kills that the same grammar allows who knows the whole match: of "
           "kills_seen alone, its other figures bound nothing.</p>\n";
}

// The first frame from the beat on; the match's last where there is none.
std::size_t frame_from(const evaluation::Trace& trace, Beat beat) {
    std::size_t frame = 0;
    while (frame + 1 < trace.frames.size() && direction::beat_of(seconds_at(trace, frame)) < beat)
        ++frame;
    return frame;
}

Result<std::string> picture(const ProgrammeSubject& subject, std::size_t frame, std::size_t rush,
                            const std::string& caption, const std::stop_token& stop) {
    const evaluation::CameraSample* camera = camera_of(subject, frame, rush);
    if (camera == nullptr) return std::string();
    const auto drawn = frame_picture(subject.stage, frame, *camera, stop);
    if (!drawn) return drawn;
    return "<figure><svg viewBox=\"0 0 320 180\">" + *drawn + "</svg><figcaption>" + caption +
           "</figcaption></figure>";
}

// Before the cut, after it, and in the middle of the new shot.
Result<std::string> cut_pictures(const ProgrammeSubject& subject, std::size_t i,
                                 const std::stop_token& stop) {
    const evaluation::Trace& trace = subject.stage.trace;
    const Shot& before = subject.shots[i - 1];
    const Shot& after = subject.shots[i];
    const std::size_t cut = frame_from(trace, after.begin);
    std::string html = "<article><h3>" + decimal(seconds(after.begin), 1) +
                       " s: " + escape(subject.reasons[i]) + "</h3>\n<div class=\"strip cut\">";
    struct Part {
        std::size_t frame;
        const Shot& shot;
        std::string caption;
    };
    for (const Part& part :
         {Part{cut > 0 ? cut - 1 : 0, before, "before: " + name_of(subject, before.rush)},
          Part{cut, after, "after: " + name_of(subject, after.rush)},
          Part{frame_from(trace, (after.begin + after.end) / 2), after,
               "in the middle, " + decimal(seconds((after.begin + after.end) / 2), 1) + " s"}}) {
        const auto drawn = picture(subject, part.frame, part.shot.rush, part.caption, stop);
        if (!drawn) return drawn;
        html += *drawn;
    }
    return html + "</div></article>\n";
}

Result<std::string> cuts(const ProgrammeSubject& subject, const ProgressSink& progress,
                         const std::stop_token& stop) {
    const std::size_t count = std::min(subject.shots.size(), max_cuts + 1);
    std::string html;
    if (count < subject.shots.size())
        html = "<p>The first " + std::to_string(max_cuts) + " of " +
               std::to_string(subject.shots.size() - 1) + " cuts.</p>\n";
    for (std::size_t i = 1; i < count; ++i) {
        progress(i, count);
        const auto shown = cut_pictures(subject, i, stop);
        if (!shown) return shown;
        html += *shown;
    }
    return html.empty() ? "<p>None: one shot shows the whole match.</p>\n" : html;
}

}  // namespace

Result<std::string> to_html(const ProgrammeSubject& subject, const ProgressSink& progress,
                            const std::stop_token& stop) {
    const auto pictures = cuts(subject, progress, stop);
    if (!pictures) return pictures;
    return head(subject.title, subject.facts) + "<main>\n" + section("figures", "Figures", figures(subject)) +
           section("timeline", "Timeline", Timeline(subject).html()) + section("cuts", "Cuts", *pictures) +
           "</main>\n</body></html>\n";
}

}  // namespace camdir::report
