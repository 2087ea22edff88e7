#include "findings_table.hpp"

#include <sys/ioctl.h>
#include <unistd.h>

#include <iomanip>
#include <ostream>
#include <sstream>
#include <utility>

namespace camdir::soak {
namespace {

const char* state_of(const std::optional<camera_director::Camera>& camera) {
    if (!camera) return "-";
    if ((camera->flags & CDIR_CAMERA_CUT) != 0) return "cut";
    if ((camera->flags & CDIR_CAMERA_TARGET_ABSENT) != 0) return "absent";
    if ((camera->flags & CDIR_CAMERA_SEARCHING) != 0) return "searching";
    if ((camera->flags & CDIR_CAMERA_HELD) != 0) return "held";
    return "tracking";
}

double percent(std::uint64_t part, std::uint64_t whole) {
    return whole == 0 ? 0.0 : 100.0 * static_cast<double>(part) / static_cast<double>(whole);
}

void print_row(std::ostream& out, const Row& row, double seconds) {
    const Findings& found = row.findings;
    const auto milliseconds = [&](double share) { return 1e3 * found.latency.percentile(share); };
    out << std::left << std::setw(12) << row.name << std::setw(11) << state_of(row.latest) << std::right
        << std::setw(9) << percent(found.visible, found.cameras) << std::setw(11);
    if (row.latest)
        out << row.latest->clearance;
    else
        out << "-";
    out << std::setw(9) << milliseconds(0.5) << std::setw(8) << milliseconds(0.99) << std::setw(9)
        << static_cast<double>(found.frames) / row.shots / seconds << std::setw(7) << found.gaps
        << std::setw(6) << found.cuts << std::setw(13) << found.in_obstacle << std::setw(9)
        << found.through_geometry << std::setw(7) << found.jumps << '\n';
}

// A longer line would take two, and the next table would not be where this one was.
std::size_t columns_of_terminal() {
    winsize size{};
    const bool known = ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
    return known ? size.ws_col : std::string::npos;
}

}  // namespace

FindingsTable::FindingsTable(std::ostream& out, std::string heading, bool live)
    : out_(out), heading_(std::move(heading)), live_(live) {}

void FindingsTable::print(const std::vector<Row>& rows, double seconds) {
    std::stringstream table;
    table << std::fixed << std::setprecision(1) << std::left << std::setw(12) << heading_
          << "state      visible %  clearance  p50 ms  p99 ms  frames/s  gaps  cuts  in obstacle  through  "
             "jumps\n";
    for (const Row& row : rows)
        print_row(table, row, seconds);
    // Moves the cursor up to the start of the previous table and clears from there.
    if (live_ && printed_lines_ > 0) out_ << "\x1b[" << printed_lines_ << "A\x1b[J";
    const std::size_t width = live_ ? columns_of_terminal() : std::string::npos;
    for (std::string line; std::getline(table, line);)
        out_ << line.substr(0, width) << '\n';
    out_.flush();
    printed_lines_ = rows.size() + 1;
}

}  // namespace camdir::soak
