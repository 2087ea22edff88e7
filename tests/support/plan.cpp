#include "support/plan.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

namespace camdir::test {
namespace {

constexpr float pitch = 8.0F;                          // of the grid of vertices
constexpr float circumradius2 = pitch * pitch / 2.0F;  // of the grid's triangles, squared
constexpr float eye_height = 54.0F;

// The parameters at which the segment enters and leaves the box (slab method); no intersection when first >
// second.
std::pair<float, float> crossing(const Eigen::AlignedBox2f& box, const Eigen::Vector2f& from,
                                 const Eigen::Vector2f& way) {
    float enter = 0.0F;
    float leave = 1.0F;
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0.0F) {
            if (from[axis] < box.min()[axis] || from[axis] > box.max()[axis]) return {1.0F, 0.0F};
            continue;
        }
        const float a = (box.min()[axis] - from[axis]) / way[axis];
        const float b = (box.max()[axis] - from[axis]) / way[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    return {enter, leave};
}

}  // namespace

Plan::Plan(std::vector<std::string> rows, float cell, float height)
    : rows_(std::move(rows)), cell_(cell), height_(height) {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        for (std::size_t column = 0; column < rows_[row].size(); ++column) {
            if (rows_[row][column] != '#') continue;
            const float x = static_cast<float>(column) * cell_;
            const float y = static_cast<float>(rows_.size() - 1 - row) * cell_;
            solids_.emplace_back(Eigen::Vector2f(x, y), Eigen::Vector2f(x + cell_, y + cell_));
        }
    }
}

freespace::Freespace Plan::freespace(float metres_per_unit) const {
    auto parsed = freespace::Freespace::parse(freespace::encode(contents(metres_per_unit)), "plan");
    if (!parsed) throw std::runtime_error(parsed.error().message);
    return *std::move(parsed);
}

freespace::Contents Plan::contents(float metres_per_unit) const {
    freespace::Contents contents;
    contents.metadata.map_name = "plan";
    contents.metadata.metres_per_unit = metres_per_unit;
    contents.metadata.d0 = pitch;
    contents.metadata.parameters = "{}";
    const auto columns = static_cast<int>(static_cast<float>(rows_.front().size()) * cell_ / pitch);
    const auto lines = static_cast<int>(static_cast<float>(rows_.size()) * cell_ / pitch);
    std::map<std::pair<int, int>, std::uint32_t> vertices;
    for (int line = 0; line <= lines; ++line) {
        for (int column = 0; column <= columns; ++column) {
            const float x = static_cast<float>(column) * pitch;
            const float y = static_cast<float>(line) * pitch;
            const float clearance = std::min(plan_clearance(x, y), 0.5F * height_);
            if (clearance * clearance <= circumradius2) continue;
            // For every solid point o, |m - o|^2 on a triangle is at least its linear interpolation less
            // the squared circumradius: with these radii no slab reaches o.
            const float radius = std::sqrt(clearance * clearance - circumradius2);
            vertices.emplace(std::pair(column, line), static_cast<std::uint32_t>(contents.vertices.size()));
            contents.vertices.push_back({x, y, 0.5F * height_, radius});
        }
    }
    for (const auto& [place, vertex] : vertices) {
        const auto [column, line] = place;
        const auto right = vertices.find({column + 1, line});
        const auto above = vertices.find({column, line + 1});
        const auto across = vertices.find({column + 1, line + 1});
        if (across == vertices.end()) continue;
        if (right != vertices.end()) contents.triangles.push_back({vertex, right->second, across->second});
        if (above != vertices.end()) contents.triangles.push_back({vertex, across->second, above->second});
    }
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        for (std::size_t column = 0; column < rows_[row].size(); ++column) {
            if (rows_[row][column] == 's') contents.spawn_points.push_back({eye(row, column), 0.0F});
        }
    }
    return contents;
}

Vec3f Plan::eye(std::size_t row, std::size_t column) const {
    return {(static_cast<float>(column) + 0.5F) * cell_,
            (static_cast<float>(rows_.size() - 1 - row) + 0.5F) * cell_, eye_height};
}

Vec3f Plan::eye(char letter) const {
    for (std::size_t row = 0; row < rows_.size(); ++row) {
        const std::size_t column = rows_[row].find(letter);
        if (column != std::string::npos) return eye(row, column);
    }
    throw std::runtime_error(std::string("no cell marked ") + letter);
}

float Plan::clearance(const Vec3f& point) const {
    return std::min({plan_clearance(point.x(), point.y()), point.z(), height_ - point.z()});
}

float Plan::plan_clearance(float x, float y) const {
    float least = std::numeric_limits<float>::infinity();
    for (const Eigen::AlignedBox2f& solid : solids_) {
        least = std::min(least, solid.exteriorDistance(Eigen::Vector2f(x, y)));
    }
    return least;
}

bool Plan::segment_clear(const Vec3f& from, const Vec3f& to) const {
    if (clearance(from) <= 0.0F || clearance(to) <= 0.0F) return false;
    return std::none_of(solids_.begin(), solids_.end(), [&](const Eigen::AlignedBox2f& solid) {
        const auto [enter, leave] = crossing(solid, from.head<2>(), (to - from).head<2>());
        return enter <= leave;
    });
}

Eigen::AlignedBox3f Plan::bounds() const {
    return {Vec3f::Zero(), Vec3f(static_cast<float>(rows_.front().size()) * cell_,
                                 static_cast<float>(rows_.size()) * cell_, height_)};
}

Plan box_room() {
    return Plan({"##########",  //
                 "#........#",  //
                 "#........#",  //
                 "#........#",  //
                 "#........#",  //
                 "#s......t#",  //
                 "#........#",  //
                 "##########"});
}

Plan l_corridor() {
    return Plan({"################",  //
                 "#s............##",  //
                 "#.............##",  //
                 "###########...##",  //
                 "###########...##",  //
                 "###########...##",  //
                 "###########...##",  //
                 "###########.t.##",  //
                 "################"});
}

Plan figure_eight() {
    return Plan({"##################",  //
                 "#s..............##",  //
                 "#...............##",  //
                 "#..#####..#####..#",  //
                 "#..#####..#####..#",  //
                 "#..#####..#####..#",  //
                 "#................#",  //
                 "#...............t#",  //
                 "##################"});
}

Plan two_rooms() {
    return Plan({"############",  //
                 "#....##....#",  //
                 "#....##....#",  //
                 "#.s..##..t.#",  //
                 "#....##....#",  //
                 "#....##....#",  //
                 "############"});
}

}  // namespace camdir::test
