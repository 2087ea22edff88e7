// A page of HTML that shows the programme of a match: its figures beside other directors', a timeline of
// shots and what happened, and every cut in pictures. One file that needs no other and no network.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <stop_token>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "direction/figures.hpp"
#include "direction/moments.hpp"
#include "report/frame_picture.hpp"
#include "report/page.hpp"
#include "report/subject.hpp"

namespace camdir::report {

struct JudgedProgramme {
    std::string name;
    direction::Figures figures;
};

// Rush r is the camera of stage.trace.players[r]; behind them come the fixed ones.
struct ProgrammeSubject {
    Stage stage;
    const evaluation::CameraPath& cameras;  // of trace.poses
    const std::vector<evaluation::CameraSample>& fixed;
    std::string title;
    std::vector<Fact> facts;
    std::vector<JudgedProgramme> judged;  // the page's own first
    std::vector<direction::Shot> shots;
    std::vector<std::string> reasons;  // of each shot
    const direction::Footage& footage;
    std::vector<direction::Event> events;
    std::vector<direction::Moment> moments;  // of the whole match
    const direction::Rules& rules;
};

// UTF-8. Pictures are of the first 60 cuts. Fails as to_html(const Subject&).
[[nodiscard]] Result<std::string> to_html(const ProgrammeSubject& subject, const ProgressSink& progress,
                                          const std::stop_token& stop);

}  // namespace camdir::report
