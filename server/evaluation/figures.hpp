// The figures of Metrics by name, for programs and for people.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "evaluation/metrics.hpp"

namespace camdir::evaluation {

struct Figure {
    enum class Better : std::uint8_t { neither, more, less };

    std::string name;     // as in to_json; of a Spread with its key behind a dot: acc.p95
    std::string unit;     // %, units, deg, units/s^2, /min, ...
    std::string meaning;  // one sentence
    int decimals = 2;     // that a table shows
    Better better = Better::neither;
    double value = unmeasured;
};

// Every figure in the order of the tables; kill_in_view and those of movers only where they were asked for.
[[nodiscard]] std::vector<Figure> figures_of(const Metrics& metrics);

// With `decimals` digits behind the point; "-" where nothing was measured.
[[nodiscard]] std::string format_value(double value, int decimals);

// A JSON object with a key for each figure of Metrics, by the same name; a Spread is an object with the keys
// rms, p95, p99; what was not measured is null; kill_in_view and mover_frames_inside, mover_passages and
// mover_seen_through are absent where they were not asked for. The same metrics give the same text.
[[nodiscard]] std::string to_json(const Metrics& metrics);

// A table of lines `name value unit`.
[[nodiscard]] std::string to_table(const Metrics& metrics);

}  // namespace camdir::evaluation
