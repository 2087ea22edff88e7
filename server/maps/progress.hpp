// How far a bake is, over all of its stages, and how long the rest takes.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "bake/bake.hpp"

namespace camdir::maps {

// A stage's part of the time of a whole bake.
struct StageWeight {
    std::string_view stage;
    double weight;  // the weights of a list sum to 1
    // The stage reports its progress as one pass from start to end. The others are estimated by their time.
    bool one_pass;
};

// The stages of a bake in their order: of a map with surfaces, and of a point cloud.
[[nodiscard]] std::span<const StageWeight> surface_stages();
[[nodiscard]] std::span<const StageWeight> cloud_stages();

// A value; `seconds` are those of any clock that does not go back.
class BakeProgress {
  public:
    void update(const bake::Progress& progress, double seconds);

    // The stage that runs; empty before the first one.
    [[nodiscard]] const std::string& stage() const { return stage_; }
    // Of the whole bake, 0 .. 1; never falls.
    [[nodiscard]] double fraction(double seconds) const;

  private:
    void enter(std::string_view stage, double seconds);

    std::span<const StageWeight> stages_;  // empty before a stage that is in one of the lists
    std::string stage_;
    double bake_start_ = 0.0;
    double stage_start_ = 0.0;
    double before_ = 0.0;    // weights of the stages before this one
    double weight_ = 0.0;    // of this stage; 0: in no list
    double reported_ = 0.0;  // by this stage, 0 .. 1
    bool one_pass_ = false;
    double expected_ = 0.0;  // seconds of this stage by the speed of those before; 0: unknown
    double reached_ = 0.0;   // the largest fraction so far
};

// Estimates the time that is left from the fraction that is done. Smooth: a fraction that advances unevenly
// changes the estimate only little by little. A value.
class TimeEstimate {
  public:
    // `seconds` since the work began.
    void update(double fraction, double seconds);

    // Seconds; nothing before the first second and the first 2 %.
    [[nodiscard]] std::optional<double> remaining(double fraction, double seconds) const;

  private:
    [[nodiscard]] double total(double fraction, double seconds) const;

    double total_ = 0.0;    // seconds of the whole work; 0: no estimate yet
    double updated_ = 0.0;  // when
};

}  // namespace camdir::maps
