#include "scene/quake3/patches.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace camdir::scene::q3 {
namespace {

constexpr double max_deviation = 1.0;  // map units
// Of max_deviation the share of the bend along each direction; the rest is for twist.
constexpr double curve_deviation = 0.4;

// Biquadratic: spans of 3 x 3 control points that share their borders.
class ControlGrid {
  public:
    ControlGrid(const Bsp& bsp, const Face& face) : bsp_(bsp), face_(face) {}

    [[nodiscard]] std::size_t columns() const { return static_cast<std::size_t>(face_.patch_width); }
    [[nodiscard]] std::size_t rows() const { return static_cast<std::size_t>(face_.patch_height); }
    [[nodiscard]] Vec3d at(std::size_t column, std::size_t row) const {
        const auto& p =
            bsp_.vertices[static_cast<std::size_t>(face_.first_vertex) + row * columns() + column].position;
        return {p[0], p[1], p[2]};
    }

  private:
    const Bsp& bsp_;
    const Face& face_;
};

double second_difference(const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    return (a - 2.0 * b + c).norm();
}

// Steps for each span of control points along one direction. Chords of a quadratic curve, n to a span,
// deviate from it by a quarter of its second difference over n^2.
using Steps = std::vector<std::size_t>;

void raise(std::size_t& steps, double second_difference) {
    const double needed = std::sqrt(second_difference / (4.0 * curve_deviation));
    steps = std::max(steps, static_cast<std::size_t>(std::ceil(needed)));
}

Steps steps_across(const ControlGrid& grid) {
    Steps steps(grid.columns() / 2, 1);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t i = 0; i < steps.size(); ++i) {
            raise(steps[i],
                  second_difference(grid.at(2 * i, row), grid.at(2 * i + 1, row), grid.at(2 * i + 2, row)));
        }
    }
    return steps;
}

Steps steps_down(const ControlGrid& grid) {
    Steps steps(grid.rows() / 2, 1);
    for (std::size_t column = 0; column < grid.columns(); ++column) {
        for (std::size_t j = 0; j < steps.size(); ++j) {
            raise(steps[j], second_difference(grid.at(column, 2 * j), grid.at(column, 2 * j + 1),
                                              grid.at(column, 2 * j + 2)));
        }
    }
    return steps;
}

struct Parameter {
    std::size_t first;  // control point where the span starts
    double t;           // within the span
};

std::size_t cells_along(const Steps& steps) {
    return std::accumulate(steps.begin(), steps.end(), std::size_t{0});
}

std::vector<Parameter> parameters_of(const Steps& steps) {
    std::vector<Parameter> parameters;
    for (std::size_t span = 0; span < steps.size(); ++span) {
        for (std::size_t step = 0; step < steps[span]; ++step) {
            parameters.push_back({2 * span, static_cast<double>(step) / static_cast<double>(steps[span])});
        }
    }
    parameters.push_back({2 * steps.size() - 2, 1.0});
    return parameters;
}

std::array<double, 3> bernstein(double t) {
    return {(1.0 - t) * (1.0 - t), 2.0 * t * (1.0 - t), t * t};
}

Vec3d point_on(const ControlGrid& grid, const Parameter& u, const Parameter& v) {
    const std::array<double, 3> across = bernstein(u.t);
    const std::array<double, 3> down = bernstein(v.t);
    Vec3d point = Vec3d::Zero();
    for (std::size_t j = 0; j < 3; ++j) {
        for (std::size_t i = 0; i < 3; ++i) {
            point += across[i] * down[j] * grid.at(u.first + i, v.first + j);
        }
    }
    return point;
}

// How far `point` is from the plane of the triangle; 0 for a triangle without area.
double height_over(const Vec3d& point, const Vec3d& a, const Vec3d& b, const Vec3d& c) {
    const Vec3d normal = (b - a).cross(c - a);
    const double length = normal.norm();
    return length > 0.0 ? std::abs((point - a).dot(normal)) / length : 0.0;
}

Parameter halfway(const Parameter& from, const Parameter& to) {
    const double end = to.first == from.first ? to.t : 1.0;
    return {from.first, (from.t + end) / 2.0};
}

// The largest height of the surface over the middle of a cell, where bend and twist both peak.
double deviation_at_middles(const ControlGrid& grid, const std::vector<Parameter>& across,
                            const std::vector<Parameter>& down, const Tessellation& cells) {
    double largest = 0.0;
    for (std::size_t row = 0; row + 1 < cells.rows; ++row) {
        for (std::size_t column = 0; column + 1 < cells.columns; ++column) {
            const Vec3d middle = point_on(grid, halfway(across[column], across[column + 1]),
                                          halfway(down[row], down[row + 1]));
            const auto& [a, b, c, d] = cells.corners(column, row);
            largest = std::max({largest, height_over(middle, a, b, c), height_over(middle, a, c, d)});
        }
    }
    return largest;
}

void double_all(Steps& steps) {
    for (std::size_t& step : steps) {
        step *= 2;
    }
}

}  // namespace

std::array<Vec3d, 4> Tessellation::corners(std::size_t column, std::size_t row) const {
    const std::size_t first = row * columns + column;
    return {points[first], points[first + 1], points[first + columns + 1], points[first + columns]};
}

std::vector<std::array<Vec3d, 3>> Tessellation::triangles() const {
    std::vector<std::array<Vec3d, 3>> triangles;
    triangles.reserve(triangle_count());
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const auto& [a, b, c, d] = corners(column, row);
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, d});
        }
    }
    return triangles;
}

Result<Tessellation> tessellate(const Bsp& bsp, const Face& face, std::size_t max_triangles) {
    const ControlGrid grid(bsp, face);
    for (Steps u = steps_across(grid), v = steps_down(grid);; double_all(u), double_all(v)) {
        if (2 * cells_along(u) * cells_along(v) > max_triangles)
            return fail("patches need more than " + std::to_string(bsp.max_triangles()) +
                        " triangles to be within a unit, which is the limit for a file of this size");
        const std::vector<Parameter> across = parameters_of(u);
        const std::vector<Parameter> down = parameters_of(v);
        Tessellation tessellation{across.size(), down.size(), {}};
        tessellation.points.reserve(across.size() * down.size());
        for (const Parameter& row : down) {
            for (const Parameter& column : across) {
                tessellation.points.push_back(point_on(grid, column, row));
            }
        }
        if (deviation_at_middles(grid, across, down, tessellation) <= max_deviation) return tessellation;
    }
}

}  // namespace camdir::scene::q3
