#include "report/line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace camdir::report {
namespace {

// The samples of one column so far.
class Column {
  public:
    void add(const Sample& sample) {
        if (std::isnan(sample.value)) {
            gap_ = true;
            return;
        }
        if (!low_ || sample.value < low_->value) low_ = sample;
        if (!high_ || sample.value > high_->value) high_ = sample;
    }

    void write(std::vector<Sample>& line) {
        if (gap_ && !line.empty() && !std::isnan(line.back().value))
            line.push_back({line.back().time, std::numeric_limits<double>::quiet_NaN()});
        if (low_) {
            const auto [first, second] =
                std::minmax(*low_, *high_, [](const Sample& a, const Sample& b) { return a.time < b.time; });
            line.push_back(first);
            if (second.time > first.time) line.push_back(second);
        }
        *this = {};
    }

  private:
    std::optional<Sample> low_, high_;
    bool gap_ = false;
};

}  // namespace

std::vector<Sample> decimate(std::span<const Sample> samples, double duration, int columns) {
    std::vector<Sample> line;
    Column column;
    int place = 0;
    for (const Sample& sample : samples) {
        const int now = std::min(static_cast<int>(sample.time / duration * columns), columns - 1);
        if (now != place) column.write(line);
        place = now;
        column.add(sample);
    }
    column.write(line);
    return line;
}

std::string path_of(std::span<const Sample> samples, const Axes& axes) {
    std::string path;
    long x = 0, y = 0;
    bool pen_down = false;
    for (const Sample& sample : samples) {
        if (std::isnan(sample.value)) {
            pen_down = false;
            continue;
        }
        const double share = std::clamp(sample.value / axes.largest, 0.0, 1.0);
        const long to_x = std::lround(sample.time / axes.duration * axes.width);
        const long to_y = std::lround((1.0 - share) * axes.height);
        path += pen_down ? 'l' + std::to_string(to_x - x) + ' ' + std::to_string(to_y - y)
                         : 'M' + std::to_string(to_x) + ' ' + std::to_string(to_y);
        x = to_x;
        y = to_y;
        pen_down = true;
    }
    return path;
}

}  // namespace camdir::report
