// The figures of a camera beside those of others.
#pragma once

#include <string>

#include "report/subject.hpp"

namespace camdir::report {

// The main figures, a table of all of them with the best of each row marked, what they mean, and how to get
// those of further cameras. A value is in the table as it was measured too: <data value="...">.
[[nodiscard]] std::string comparison(const Subject& subject);

}  // namespace camdir::report
