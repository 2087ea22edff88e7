// A page of HTML that shows how good a camera was on a match: figures beside other cameras, the worst moments
// as film strips, a floor plan, series over time, distributions. One file that needs no other and no network.
#pragma once

#include <cstdint>
#include <functional>
#include <stop_token>
#include <string>

#include "base/error.hpp"
#include "report/subject.hpp"

namespace camdir::report {

// Film strips drawn and film strips in all.
using ProgressSink = std::function<void(std::uint64_t, std::uint64_t)>;

// UTF-8. Its size hardly grows with the match's: series are reduced to the width of a picture, ways to a
// number of points, and charts, strips and marks are limited in number. Fails with ErrorCode::interrupted
// soon after `stop` is requested, and when memory is short for a picture.
[[nodiscard]] Result<std::string> to_html(const Subject& subject, const ProgressSink& progress,
                                          const std::stop_token& stop);

}  // namespace camdir::report
