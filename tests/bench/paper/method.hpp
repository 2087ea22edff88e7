// The methods that bench-paper compares: from the paper as written, one change after the other, to the baker.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bake/bake.hpp"
#include "bench/paper/stopwatch.hpp"

namespace camdir::paper {

enum class SamplingRule { edges, covering_radius };
enum class Engine { qhull, cgal };
enum class FreeDistance { constant, certified };

// A pipeline with the paper's reduction.
struct Pipeline {
    SamplingRule sampling;
    Engine engine;
    FreeDistance free_distance;
};

struct Settings {
    double d0 = 16.0;  // as bake::Parameters
    unsigned threads = 1;
    double swap_threshold = 1.0;  // d0 cubed: vertices whose elimination loses less freespace go
    double loss = bake::Parameters{}.loss;
};

struct Part {
    std::string name;
    Cost cost;
};

// Figure 6 of the paper. 0: not known of this method.
struct Figures {
    std::vector<Part> parts;
    std::uint64_t samples = 0;
    std::uint64_t voronoi_vertices = 0;
    std::uint64_t inner_vertices = 0;
    std::uint64_t inner_faces = 0;
    std::uint64_t inner_triangles = 0;
};

struct Product {
    freespace::Contents contents;
    Figures figures;
};

[[nodiscard]] Result<Product> run(const Pipeline& pipeline, const scene::Scene& scene,
                                  const Settings& settings);

// The baker itself; `settings` say its d0, threads and loss.
[[nodiscard]] Result<Product> run_baker(bool adaptive, const scene::Scene& scene, const Settings& settings);

struct Method {
    std::string_view key;    // on the command line
    std::string_view title;  // in the table
    Result<Product> (*run)(const scene::Scene&, const Settings&);
};

// In the order of the table.
[[nodiscard]] const std::vector<Method>& methods();

// The parts in which all methods report their costs, in order.
[[nodiscard]] const std::vector<std::string>& part_names();

}  // namespace camdir::paper
