// The probe's findings as a table, for people.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "shot_checker.hpp"

namespace camdir::soak {

struct Row {
    std::string name;         // of the match, or of the player
    std::uint32_t shots = 1;  // that the findings are the sum of
    Findings findings;
    std::optional<camera_director::Camera> latest;  // of a single shot
};

// Prints rows under a heading. A live table on a terminal is overwritten by the next one.
class FindingsTable {
  public:
    // `heading` names the first column. With `live` the output is a terminal whose cursor may move.
    FindingsTable(std::ostream& out, std::string heading, bool live);

    void print(const std::vector<Row>& rows, double seconds);

  private:
    std::ostream& out_;
    std::string heading_;
    bool live_;
    std::size_t printed_lines_ = 0;
};

}  // namespace camdir::soak
