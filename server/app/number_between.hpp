// A range of numbers for an option of a command line.
#pragma once

#include <CLI/CLI.hpp>
#include <cmath>
#include <string>

namespace camdir::app {

// From `least` to `most`: as CLI::Range, which takes "nan" for such a number.
[[nodiscard]] inline CLI::Validator number_between(double least, double most) {
    const auto is_number = [](const std::string& text) {
        double value = 0.0;
        return CLI::detail::lexical_cast(text, value) && std::isnan(value) ? text + " is not a number" : "";
    };
    return CLI::Range(least, most) & CLI::Validator(is_number, "");
}

}  // namespace camdir::app
