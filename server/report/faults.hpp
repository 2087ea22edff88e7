// How a page names the faults of a frame, the worst first.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <string>

#include "evaluation/judgement.hpp"

namespace camdir::report {

struct FaultName {
    evaluation::Fault fault;
    const char* key;  // the class in the style sheet
    const char* text;
};

inline constexpr FaultName fault_names[] = {
    {evaluation::hidden, "hidden", "eye hidden"},
    {evaluation::low_clearance, "clearance", "too near to an obstacle"},
    {evaluation::out_of_frame, "frame", "eye out of the middle"},
    {evaluation::wrong_side, "side", "too far off the view direction"},
    {evaluation::wrong_distance, "distance", "too near or too far"},
};

// A paragraph that explains their colours.
[[nodiscard]] inline std::string fault_legend() {
    std::string html = "<p class=\"legend\">";
    for (const FaultName& name : fault_names)
        html += std::string("<span><i class=\"key fault-") + name.key + "\"></i>" + name.text + "</span>";
    return html + "</p>\n";
}

// How many frames have each fault, in the order of fault_names.
using FaultCounts = std::array<std::size_t, std::size(fault_names)>;

inline void count(std::uint8_t faults, FaultCounts& counts) {
    for (std::size_t i = 0; i < counts.size(); ++i)
        if ((faults & fault_names[i].fault) != 0) ++counts[i];
}

[[nodiscard]] inline const FaultName& most_frequent(const FaultCounts& counts) {
    return fault_names[std::ranges::max_element(counts) - counts.begin()];
}

}  // namespace camdir::report
