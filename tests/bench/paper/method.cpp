#include "bench/paper/method.hpp"

namespace camdir::paper {

const std::vector<Method>& methods() {
    using enum SamplingRule;
    using enum Engine;
    using enum FreeDistance;
    using Scene = scene::Scene;
    static const std::vector<Method> all{
        {"paper", "paper: edge sampling, qhull, constant distance, swaps",
         [](const Scene& s, const Settings& o) {
             return run({edges, qhull, constant}, s, o);
         }},
        {"cgal", "with CGAL",
         [](const Scene& s, const Settings& o) {
             return run({edges, cgal, constant}, s, o);
         }},
        {"covering", "+ covering-radius sampling, without what brushes hide",
         [](const Scene& s, const Settings& o) {
             return run({covering_radius, cgal, constant}, s, o);
         }},
        {"certified", "+ certified distance",
         [](const Scene& s, const Settings& o) {
             return run({covering_radius, cgal, certified}, s, o);
         }},
        {"collapse", "+ edges from 1.7 d0, welded vertices, half-edge collapse",
         [](const Scene& s, const Settings& o) { return run_baker(false, s, o); }},
        {"adaptive", "+ adaptive sampling: the baker",
         [](const Scene& s, const Settings& o) { return run_baker(true, s, o); }},
    };
    return all;
}

const std::vector<std::string>& part_names() {
    static const std::vector<std::string> names{"sampling",      "Voronoi diagram", "inner mesh",
                                                "free distance", "reduction",       "packing"};
    return names;
}

}  // namespace camdir::paper
