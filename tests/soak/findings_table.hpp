// Prints the probe's findings as a table.
#pragma once

#include <iosfwd>
#include <string>
#include <vector>

#include "shot_checker.hpp"

namespace camdir::soak {

struct Row {
    std::string name;         // of the match, or of the player
    std::uint32_t shots = 1;  // number of shots summed up in the findings
    Findings findings;
    std::optional<camera_director::Camera> latest;  // for a single shot
};

// On a live terminal each table overwrites the previous one.
class FindingsTable {
  public:
    // `heading` names the first column. `live`: `out` is the terminal of standard error, to whose width lines
    // are cut.
    FindingsTable(std::ostream& out, std::string heading, bool live);

    void print(const std::vector<Row>& rows, double seconds);

  private:
    std::ostream& out_;
    std::string heading_;
    bool live_;
    std::size_t printed_lines_ = 0;
};

}  // namespace camdir::soak
