#include "bench/paper/dynamic_mesh.hpp"

#include <algorithm>

namespace camdir::paper {
namespace {

bool has(const Corners& corners, std::uint32_t vertex) {
    return std::find(corners.begin(), corners.end(), vertex) != corners.end();
}

}  // namespace

DynamicMesh::DynamicMesh(const std::vector<Vec3f>& positions, std::vector<float>& free_distance,
                         const std::vector<Corners>& triangles)
    : positions_(positions), free_distance_(free_distance), stars_(positions.size()) {
    for (const Corners& corners : triangles)
        add(corners);
}

bool DynamicMesh::is_edge(std::uint32_t a, std::uint32_t b) const {
    return std::any_of(stars_[a].begin(), stars_[a].end(),
                       [&](std::uint32_t t) { return has(triangles_[t], b); });
}

bool DynamicMesh::is_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return std::any_of(stars_[a].begin(), stars_[a].end(),
                       [&](std::uint32_t t) { return has(triangles_[t], b) && has(triangles_[t], c); });
}

double DynamicMesh::area(const Corners& corners) const {
    const Vec3d a = position(corners[0]);
    return 0.5 * (position(corners[1]) - a).cross(position(corners[2]) - a).norm();
}

std::vector<Corners> DynamicMesh::triangles() const {
    std::vector<Corners> left;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
        if (gone_[i] == 0) left.push_back(triangles_[i]);
    }
    return left;
}

void DynamicMesh::remove_star(std::uint32_t vertex) {
    const std::vector<std::uint32_t> star = std::move(stars_[vertex]);
    stars_[vertex].clear();
    for (const std::uint32_t triangle : star) {
        gone_[triangle] = 1;
        for (const std::uint32_t corner : triangles_[triangle]) {
            if (corner != vertex) std::erase(stars_[corner], triangle);
        }
    }
}

void DynamicMesh::add(const Corners& corners) {
    for (const std::uint32_t corner : corners)
        stars_[corner].push_back(static_cast<std::uint32_t>(triangles_.size()));
    triangles_.push_back(corners);
    gone_.push_back(0);
}

}  // namespace camdir::paper
