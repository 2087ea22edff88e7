// The rows of the table: what is done to the processes, hosts and clocks of a stage.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "hand_over_stage.hpp"

namespace camdir::soak {

struct Row {
    std::string name;
    std::function<void(Stage&)> happens;
    bool from_start = false;    // measures from the first frame
    double more_gap_ms = 0.0;   // where it is not the directors' fault
    bool fills_delay = false;   // anew, and that is no fault either
    std::uint64_t forced = 0;   // cuts where the game's own poses jump
    std::uint64_t changes = 0;  // of the director, where the leader fails or leaves
    bool planned = false;       // the leader hands over: at most one frame is lost
    enum class Means { processes, hosts, clocks } means = Means::processes;
};

[[nodiscard]] std::vector<Row> rows();

}  // namespace camdir::soak
