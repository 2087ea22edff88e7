#include "report/film_strip.hpp"

#include <algorithm>
#include <cmath>

#include "evaluation/figures.hpp"
#include "report/faults.hpp"
#include "report/frame_picture.hpp"
#include "report/markup.hpp"

namespace camdir::report {
namespace {

constexpr double frame_aspect = static_cast<double>(picture_width) / picture_height;
constexpr double around_run = 0.2, around_peak = 0.25;  // seconds before and after

class Strip {
  public:
    Strip(const Subject& subject, const Moment& moment)
        : subject_(subject),
          moment_(moment),
          track_(evaluation::track_of(subject.trace, subject.trace.players[moment.player])) {}

    [[nodiscard]] Result<std::string> html(const std::stop_token& stop) const {
        std::string html = "<div class=\"strip\">";
        for (const std::size_t frame : frames()) {
            const auto picture = this->picture(frame, stop);
            if (!picture) return tl::unexpected(picture.error());
            html += *picture;
        }
        return html + "</div>\n";
    }

  private:
    // Evenly in the strip's time, of frames in which the player has a pose.
    [[nodiscard]] std::vector<std::size_t> frames() const {
        const auto [begin, end] = strip_interval(moment_, subject_.trace);
        std::vector<std::size_t> chosen;
        for (int i = 0; i < strip_length; ++i) {
            const double time = begin + (end - begin) * i / (strip_length - 1);
            const std::size_t frame = frame_at(time);
            const bool known = !chosen.empty() && chosen.back() == frame;
            if (!known && track_[frame] != evaluation::absent) chosen.push_back(frame);
        }
        if (moment_.frames.size() == 1 && !chosen.empty()) {
            // At the match's beginning and end it may lie between two of them.
            const auto next = std::ranges::lower_bound(chosen, moment_.frames.first);
            *(next == chosen.end() ? next - 1 : next) = moment_.frames.first;
        }
        return chosen;
    }

    // The last one up to this time.
    [[nodiscard]] std::size_t frame_at(double seconds) const {
        std::size_t below = 0, above = track_.size();
        while (above - below > 1) {
            const std::size_t middle = (below + above) / 2;
            (seconds_at(subject_.trace, middle) <= seconds + 1e-9 ? below : above) = middle;
        }
        return below;
    }

    [[nodiscard]] Result<std::string> picture(std::size_t frame, const std::stop_token& stop) const {
        const std::uint32_t pose = track_[frame];
        const evaluation::CameraSample& camera = subject_.cameras.front().cameras[pose];
        const Stage stage{subject_.scene, subject_.trace, subject_.point_radius};
        const auto picture = frame_picture(stage, frame, camera, stop);
        if (!picture) return picture;
        return "<figure><svg viewBox=\"0 0 320 180\">" + *picture +
               "<rect class=\"middle\" x=\"64\" y=\"36\" width=\"192\" height=\"108\"/>" +
               ring(view_of(camera), subject_.trace.poses[pose].eye) + "</svg><figcaption>" + caption(frame) +
               "</figcaption></figure>";
    }

    [[nodiscard]] static std::string ring(const render::View& view, const Vec3d& eye) {
        const auto place = render::project(view, eye, frame_aspect);
        if (!place || place->cwiseAbs().maxCoeff() > 1.0) return {};
        return "<circle class=\"ring\" cx=\"" + decimal((place->x() + 1.0) * 0.5 * picture_width, 1) +
               "\" cy=\"" + decimal((1.0 - place->y()) * 0.5 * picture_height, 1) + "\" r=\"9\"/>";
    }

    [[nodiscard]] std::string caption(std::size_t frame) const {
        const evaluation::Judgement& judgement = subject_.cameras.front().judgements[track_[frame]];
        std::string text = "<b>" + evaluation::format_value(seconds_at(subject_.trace, frame), 2) + " s</b>";
        if (!judgement.counted) return text + " not counted";
        for (const FaultName& name : fault_names)
            if ((judgement.faults & name.fault) != 0)
                text +=
                    std::string(" <i class=\"key fault-") + name.key + "\" title=\"" + name.text + "\"></i>";
        return text + (judgement.cut ? " cut" : "") + ' ' +
               decimal(judgement.distance, judgement.distance < 10.0 ? 2 : 0) + " units";
    }

    const Subject& subject_;
    const Moment& moment_;
    std::vector<std::uint32_t> track_;
};

}  // namespace

Interval strip_interval(const Moment& moment, const evaluation::Trace& trace) {
    const double around = moment.frames.size() > 1 ? around_run : around_peak;
    return {std::max(0.0, seconds_at(trace, moment.frames.first) - around),
            std::min(duration(trace), seconds_at(trace, moment.frames.last - 1) + around)};
}

Result<std::string> film_strip(const Subject& subject, const Moment& moment, const std::stop_token& stop) {
    return Strip(subject, moment).html(stop);
}

}  // namespace camdir::report
