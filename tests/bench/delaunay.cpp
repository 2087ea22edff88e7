// The yardstick for the time of bakes: CGAL's Delaunay triangulation of 200,000 points drawn uniformly in a
// cube with a fixed seed, on one thread. Prints the seconds and the number of finite cells.
#include <CGAL/Delaunay_triangulation_3.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <chrono>
#include <iostream>
#include <random>
#include <vector>

int main() {
    using Triangulation = CGAL::Delaunay_triangulation_3<CGAL::Exact_predicates_inexact_constructions_kernel>;
    constexpr std::size_t count = 200'000;
    std::mt19937_64 random(1);
    const auto coordinate = [&] { return static_cast<double>(random() >> 11U) * 0x1p-53; };
    std::vector<Triangulation::Point> points;
    points.reserve(count);
    while (points.size() < count) {
        const double x = coordinate();
        const double y = coordinate();
        points.emplace_back(x, y, coordinate());
    }
    const auto begin = std::chrono::steady_clock::now();
    const Triangulation triangulation(points.begin(), points.end());
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    std::cout << seconds.count() << ' ' << triangulation.number_of_finite_cells() << '\n';
    return triangulation.number_of_vertices() == count ? 0 : 1;
}
