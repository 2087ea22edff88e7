// The cameras that `evaluate` judges.
#pragma once

#include <stop_token>
#include <string>

#include "app/evaluate_inputs.hpp"
#include "app/progress.hpp"
#include "camera/profile.hpp"
#include "evaluation/recording.hpp"

namespace camdir::app {

struct NamedRecording {
    std::string name;
    evaluation::Recording recording;  // only the tracker's have objective terms and times
};

// The options' profile, with their solver.
[[nodiscard]] Result<camera::Profile> choose_profile(const EvaluateOptions& options);

// The camera that the options choose.
[[nodiscard]] Result<NamedRecording> make_cameras(const EvaluateOptions& options, const Match& match,
                                                  const SourceMap& map, ProgressLine& line,
                                                  const std::stop_token& stop);

// Cameras to compare it with: beside the tracker the same with the other solver, beside other cameras the
// tracker, where its map is baked; and the rigid one.
[[nodiscard]] Result<std::vector<NamedRecording>> make_compared_cameras(const EvaluateOptions& options,
                                                                        const Match& match,
                                                                        const SourceMap& map,
                                                                        ProgressLine& line,
                                                                        const std::stop_token& stop);

}  // namespace camdir::app
