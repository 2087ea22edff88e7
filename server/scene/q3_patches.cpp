#include "scene/q3_patches.hpp"

#include <algorithm>
#include <cmath>
#include <string>

namespace camdir::scene::q3 {
namespace {

constexpr double max_deviation = 1.0;  // map units

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

// Bounds of the surface's second derivatives within each span of columns (u) or rows (v), each span
// having the parameter interval [0, 1].
struct Curvature {
    std::vector<double> uu;  // one a span of columns
    std::vector<double> vv;  // one a span of rows
    double uv = 0.0;
};

Curvature curvature_of(const ControlGrid& grid) {
    Curvature bound;
    bound.uu.resize(grid.columns() / 2);
    bound.vv.resize(grid.rows() / 2);
    for (std::size_t row = 0; row < grid.rows(); ++row) {
        for (std::size_t i = 0; i < bound.uu.size(); ++i) {
            const double bend =
                second_difference(grid.at(2 * i, row), grid.at(2 * i + 1, row), grid.at(2 * i + 2, row));
            bound.uu[i] = std::max(bound.uu[i], 2.0 * bend);
        }
    }
    for (std::size_t column = 0; column < grid.columns(); ++column) {
        for (std::size_t j = 0; j < bound.vv.size(); ++j) {
            const double bend = second_difference(grid.at(column, 2 * j), grid.at(column, 2 * j + 1),
                                                  grid.at(column, 2 * j + 2));
            bound.vv[j] = std::max(bound.vv[j], 2.0 * bend);
        }
    }
    for (std::size_t row = 0; row + 1 < grid.rows(); ++row) {
        for (std::size_t column = 0; column + 1 < grid.columns(); ++column) {
            const Vec3d twist = grid.at(column, row) - grid.at(column + 1, row) - grid.at(column, row + 1) +
                                grid.at(column + 1, row + 1);
            bound.uv = std::max(bound.uv, 4.0 * twist.norm());
        }
    }
    return bound;
}

// Linear interpolation over a grid of steps 1/n and 1/m deviates by at most (uu/n^2 + 2 uv/(n m) + vv/m^2) /
// 8; each of the three terms gets a third of the allowed deviation.
std::vector<std::size_t> steps_of(const std::vector<double>& along, double uv) {
    std::vector<std::size_t> steps;
    const double allowed = 8.0 / 3.0 * max_deviation;
    for (const double curvature : along) {
        const double needed = std::sqrt(std::max(curvature, 2.0 * uv) / allowed);
        steps.push_back(static_cast<std::size_t>(std::max(1.0, std::ceil(needed))));
    }
    return steps;
}

struct Parameter {
    std::size_t first;  // control point where the span starts
    double t;           // within the span
};

std::vector<Parameter> parameters_of(const std::vector<std::size_t>& steps) {
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

}  // namespace

std::vector<std::array<Vec3d, 3>> Tessellation::triangles() const {
    std::vector<std::array<Vec3d, 3>> triangles;
    triangles.reserve(triangle_count());
    for (std::size_t row = 0; row + 1 < rows; ++row) {
        for (std::size_t column = 0; column + 1 < columns; ++column) {
            const Vec3d& a = points[row * columns + column];
            const Vec3d& b = points[row * columns + column + 1];
            const Vec3d& c = points[(row + 1) * columns + column + 1];
            const Vec3d& d = points[(row + 1) * columns + column];
            triangles.push_back({a, b, c});
            triangles.push_back({a, c, d});
        }
    }
    return triangles;
}

Result<Tessellation> tessellate(const Bsp& bsp, const Face& face, std::size_t max_triangles) {
    const ControlGrid grid(bsp, face);
    const Curvature curvature = curvature_of(grid);
    const std::vector<Parameter> across = parameters_of(steps_of(curvature.uu, curvature.uv));
    const std::vector<Parameter> down = parameters_of(steps_of(curvature.vv, curvature.uv));
    Tessellation tessellation{across.size(), down.size(), {}};
    if (tessellation.triangle_count() > max_triangles)
        return fail("patches need more than " + std::to_string(bsp.max_triangles()) +
                    " triangles to be within a unit, which is the limit for a file of this size");
    tessellation.points.reserve(across.size() * down.size());
    for (const Parameter& v : down) {
        for (const Parameter& u : across) {
            tessellation.points.push_back(point_on(grid, u, v));
        }
    }
    return tessellation;
}

}  // namespace camdir::scene::q3
