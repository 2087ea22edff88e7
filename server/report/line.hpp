// A long series as a short line of an SVG.
#pragma once

#include <span>
#include <string>
#include <vector>

namespace camdir::report {

struct Sample {
    double time;
    double value;  // NaN interrupts the line
};

// At most three samples for each of `columns` equal parts of 0 .. duration: the smallest and the largest
// value of each, in their order, and a NaN before them where the line is interrupted. Times ascend within 0
// .. duration.
[[nodiscard]] std::vector<Sample> decimate(std::span<const Sample> samples, double duration, int columns);

// Where values are in a picture of `width` x `height`: time 0 .. duration from left to right, value 0 ..
// largest from bottom to top; what is larger is at the top.
struct Axes {
    double duration, largest;
    int width, height;
};

// The `d` of an SVG path in whole steps of the picture.
[[nodiscard]] std::string path_of(std::span<const Sample> samples, const Axes& axes);

}  // namespace camdir::report
