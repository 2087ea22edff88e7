#include "bench/paper/judgement.hpp"

#include "evaluation/verification.hpp"
#include "freespace/freespace.hpp"
#include "oracle/oracle.hpp"

namespace camdir::paper {
namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Cost& cost) {
    return {{"seconds", cost.seconds}, {"cpu_seconds", cost.cpu_seconds}};
}

Json to_json(const Figures& figures) {
    Json json;
    Cost all;
    for (const Part& part : figures.parts) {
        json["parts"][part.name] = to_json(part.cost);
        all += part.cost;
    }
    json["all"] = to_json(all);
    json["samples"] = figures.samples;
    json["voronoi_vertices"] = figures.voronoi_vertices;
    if (figures.inner_vertices > 0) json["inner_vertices"] = figures.inner_vertices;
    if (figures.inner_faces > 0) json["inner_faces"] = figures.inner_faces;
    json["inner_triangles"] = figures.inner_triangles;
    return json;
}

Json to_json(const evaluation::Verification& found) {
    const auto tested =
        found.by_area.tested + found.by_triangle.tested + found.at_vertices.tested + found.at_edges.tested;
    return {{"coverage", found.coverage[0].share()},
            {"coverage_above_d0", found.coverage[1].share()},
            {"tightness", found.tightness},
            {"balls", tested},
            {"unsafe_balls", found.unsafe_balls()},
            {"overestimates", found.overestimates},
            {"spawn_points", found.spawn_points},
            {"covered_spawn_points", found.covered_spawn_points},
            {"joined_spawn_points", found.joined_spawn_points}};
}

// A mesh or a cloud has none of its own: those that the bake chose.
scene::Scene with_spawn_points(scene::Scene scene, const freespace::Freespace& freespace) {
    if (!scene.spawn_points.empty()) return scene;
    for (const freespace::SpawnPoint& spawn : freespace.spawn_points())
        scene.spawn_points.push_back({spawn.eye.cast<double>(), spawn.yaw, "baked"});
    return scene;
}

}  // namespace

Result<Json> measure(const Method& method, const scene::Scene& scene, const Settings& settings,
                     std::uint64_t balls) {
    auto product = method.run(scene, settings);
    if (!product) return tl::unexpected(std::move(product.error()));
    const std::vector<std::byte> bytes = freespace::encode(product->contents);
    Json json{{"key", method.key}, {"title", method.title}};
    json.update(to_json(product->figures));
    json["peak_memory_bytes"] = peak_memory_bytes();  // before the judge takes more
    json["vertices"] = product->contents.vertices.size();
    json["triangles"] = product->contents.triangles.size();
    json["ratio"] = static_cast<double>(product->figures.inner_triangles) /
                    static_cast<double>(product->contents.triangles.size());
    json["bytes"] = bytes.size();

    const auto freespace = freespace::Freespace::parse(bytes, std::string(method.key));
    if (!freespace) return tl::unexpected(freespace.error());
    evaluation::VerificationParameters parameters;
    parameters.balls = balls;
    const scene::Scene source = with_spawn_points(scene, *freespace);
    const oracle::Oracle oracle(source, freespace->metadata().d0);
    const auto found = evaluation::verify(*freespace, source, oracle, parameters,
                                          [](std::string_view, std::uint64_t, std::uint64_t) {}, {});
    if (!found) return tl::unexpected(found.error());
    json.update(to_json(*found));
    return json;
}

Json to_json(const EngineCost& cost) {
    return {{"points", cost.points}, {"diagram", to_json(cost.diagram)}, {"faces", to_json(cost.faces)}};
}

}  // namespace camdir::paper
