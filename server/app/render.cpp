// camera-director render: a picture of a baked map.
#include <algorithm>
#include <cstdio>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands.hpp"
#include "app/progress.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "config/json_text.hpp"
#include "export/picture_layers.hpp"
#include "maps/source.hpp"
#include "render/draw.hpp"
#include "render/page.hpp"
#include "scene/load.hpp"

namespace camdir::app {
namespace {

using freespace::Freespace;
using render::KeyEntry;

struct RenderOptions {
    std::string file;
    std::string map;
    std::string output;
    std::string json;
    std::string view = "auto";
    std::string size = "1600x1200";
    std::vector<double> between;
    exports::Tracks tracks;
    double cut = std::numeric_limits<double>::infinity();
    float opacity = 0.5F;
    bool no_mesh = false;
    bool roadmap = false;
    bool samples = false;
};

Result<render::PageSize> parse_size(const std::string& text) {
    render::PageSize size{};
    char rest = '\0';
    if (std::sscanf(text.c_str(), "%5dx%5d%c", &size.width, &size.height, &rest) != 2 ||
        std::min(size.width, size.height) < render::min_page ||
        std::max(size.width, size.height) > render::max_page) {
        return fail("size '" + text + "': expected WIDTHxHEIGHT, each " + std::to_string(render::min_page) +
                    " to " + std::to_string(render::max_page));
    }
    return size;
}

// The upper end of the colour scale: 98 % of the vertices are below it.
float scale_maximum_of(const Freespace& freespace) {
    std::vector<float> distances;
    for (const freespace::Vertex& vertex : freespace.vertices())
        distances.push_back(vertex.free_distance);
    if (distances.empty()) return 1.0F;
    const auto high = distances.begin() + static_cast<std::ptrdiff_t>((distances.size() - 1) * 98 / 100);
    std::nth_element(distances.begin(), high, distances.end());
    return static_cast<float>(render::round_up(std::max(static_cast<double>(*high), 1e-3)));
}

Box3d box_of(const Freespace& freespace, const scene::Scene& map) {
    const Box3d box = freespace.vertices().empty() ? map.bounds : freespace.bounds().cast<double>();
    const Vec3d margin = Vec3d::Constant(static_cast<double>(freespace.metadata().d0));
    return {box.min() - margin, box.max() + margin};
}

render::Legend make_legend(const RenderOptions& options, const Freespace& freespace) {
    const freespace::Metadata& metadata = freespace.metadata();
    render::Legend legend;
    legend.title = metadata.map_name;
    std::ostringstream counts;
    counts << freespace.triangles().size() << " triangles, " << freespace.vertices().size()
           << " vertices, d0 = " << metadata.d0 << " units = " << metadata.d0 * metadata.metres_per_unit
           << " m";
    legend.subtitle = counts.str();
    legend.metres_per_unit = static_cast<double>(metadata.metres_per_unit);
    if (!options.no_mesh || options.roadmap) legend.scale_maximum = scale_maximum_of(freespace);
    return legend;
}

struct Composition {
    render::PageSize page;
    render::View view;
    render::Layers layers;
    render::Legend legend;

    [[nodiscard]] int height() const { return render::picture_height(page); }
};

Result<render::View> make_view(const RenderOptions& options, const Box3d& box, const render::PageSize& page) {
    const double aspect = static_cast<double>(page.width) / render::picture_height(page);
    auto view = render::parse_view(options.view, box, aspect);
    if (view) view->top = options.cut;
    return view;
}

Result<Composition> compose(const RenderOptions& options, const Freespace& freespace,
                            const scene::Scene& map) {
    const auto page = parse_size(options.size);
    if (!page) return tl::unexpected(page.error());
    const Box3d box = box_of(freespace, map);
    const auto view = make_view(options, box, *page);
    if (!view) return tl::unexpected(view.error());
    Composition made{*page, *view, {}, make_legend(options, freespace)};
    // Marks have the width of pixels at the middle of the map, but from inside, near them, at most half a
    // foot.
    const double foot = 0.3 / static_cast<double>(freespace.metadata().metres_per_unit);
    const auto pixel =
        static_cast<float>(std::min(render::units_per_pixel(*view, box.center(), made.height()), 0.5 * foot));
    made.layers.map = &map;
    made.layers.map_point_radius = freespace.metadata().d0 * 0.5F;
    made.layers.mesh = &freespace;
    made.layers.mesh_opacity = options.no_mesh ? 0.0F : options.opacity;
    made.layers.roadmap_width = options.roadmap ? 1.6F * pixel : 0.0F;
    made.layers.free_distance_maximum = std::max(made.legend.scale_maximum, 1e-3F);
    if (view->parallel) made.legend.units_per_pixel = 2.0 * view->half_height / made.height();
    if (options.roadmap)
        made.legend.key.push_back({KeyEntry::Mark::thin_line, {render::colour_scale(0.4F)}, "roadmap"});
    if (options.samples) {
        const auto d0 = static_cast<double>(freespace.metadata().d0);
        const auto added = exports::add_samples(map, d0, pixel, made.layers, made.legend.key);
        if (!added) return tl::unexpected(added.error());
    }
    exports::add_spawn_points(freespace, pixel, made.layers, made.legend.key);
    const auto added = exports::add_tracks(options.tracks, pixel, made.layers, made.legend.key);
    if (!added) return tl::unexpected(added.error());
    return made;
}

nlohmann::ordered_json array(const Vec3d& p) {
    return {p.x(), p.y(), p.z()};
}

std::string to_json(const Composition& made, const Freespace& freespace, bool same_source) {
    nlohmann::ordered_json json{{"map_name", freespace.metadata().map_name},
                                {"source_matches", same_source},
                                {"width", made.page.width},
                                {"height", made.page.height},
                                {"picture_height", made.height()},
                                {"position", array(made.view.position)},
                                {"forward", array(made.view.forward)},
                                {"up", array(made.view.up)},
                                {"parallel", made.view.parallel},
                                {"half_height", made.view.half_height},
                                {"free_distance_maximum", made.legend.scale_maximum}};
    if (made.view.parallel) json["units_per_pixel"] = made.legend.units_per_pixel;
    return config::format_json(json);
}

Result<void> render_file(const RenderOptions& options) {
    const Interruption interruption;
    if (auto writable = check_outputs({options.output, options.json}, {options.file, options.map}); !writable)
        return writable;
    const auto freespace = Freespace::open(options.file);
    if (!freespace) return tl::unexpected(freespace.error());
    const auto map = maps::load_source(*freespace, options.map);
    if (!map) return tl::unexpected(map.error());
    const bool same_source = freespace->metadata().source_hash == map->source_hash;
    if (!same_source)
        std::cerr << "camera-director: warning: " << options.file << " was baked from other bytes ("
                  << freespace->metadata().source_name << ") than " << options.map << '\n';

    const auto made = compose(options, *freespace, *map);
    if (!made) return tl::unexpected(made.error());
    ProgressLine line;
    const auto show = [&](std::uint64_t done, std::uint64_t total) { line.show("drawing", done, total); };
    const auto picture =
        render::draw(made->layers, made->view, made->page.width, made->height(), show, interruption.token());
    line.clear();
    if (!picture) return tl::unexpected(picture.error());
    const auto png = render::to_png(*picture, made->legend, made->page);
    if (!png) return tl::unexpected(png.error());
    if (auto written = write_file(options.output, *png); !written) return written;
    return options.json.empty() ? Result<void>{}
                                : write_file(options.json, to_json(*made, *freespace, same_source));
}

// A CLI11 check: the error of the text, or an empty string.
template <class Parse>
std::function<std::string(const std::string&)> checked(Parse parse) {
    return [parse](const std::string& text) {
        const auto parsed = parse(text);
        return parsed ? std::string() : parsed.error().message;
    };
}

void add_track_options(CLI::App& command, RenderOptions& options) {
    auto* trace =
        command.add_option("--trace", options.tracks.trace,
                           "Draw the players' tracks of this recorded match, CSV or .mvd, perhaps .gz");
    command
        .add_option("--cameras", options.tracks.cameras, "Draw the cameras that `evaluate --cameras` wrote")
        ->needs(trace);
    command
        .add_option("--between", options.between,
                    "Draw the tracks between these seconds of the match: FROM,TO")
        ->delimiter(',')
        ->expected(2)
        ->check(number_between(0.0, 1e9))
        ->needs(trace);
    command.add_option("--players", options.tracks.players, "Draw the tracks of these players only: 0,3")
        ->delimiter(',')
        ->needs(trace);
}

void check_usage(RenderOptions& options) {
    check_one_standard_output({{"--output", options.output}, {"--json", options.json}});
    if (options.between.empty()) return;
    options.tracks.from = options.between[0];
    options.tracks.until = options.between[1];
    if (!(options.tracks.from < options.tracks.until))
        throw CLI::ValidationError("--between", "expected FROM,TO with FROM before TO");
}

}  // namespace

void add_render(CLI::App& root, Run& run) {
    auto options = std::make_shared<RenderOptions>();
    CLI::App* command =
        root.add_subcommand("render", "Draw a baked map: obstacles, medial mesh, roadmap, recorded tracks.");
    command->add_option("FILE.vfs", options->file, "Baked map")->required();
    command->add_option("--map", options->map, "The source map: a file, or archive.pk3:maps/name.bsp")
        ->required();
    command->add_option("-o,--output", options->output, "PNG file to write; - is standard output")
        ->required();
    const auto view = [](const std::string& text) {
        return render::parse_view(text, Box3d(Vec3d::Zero(), Vec3d::Ones()), 1.0);
    };
    command
        ->add_option("--view", options->view,
                     "plan: from straight above; auto: from above at an angle; or a viewpoint inside, "
                     "x,y,z,yaw,pitch in map units and degrees, pitch upwards")
        ->capture_default_str()
        ->check(CLI::Validator(checked(view), ""));
    command->add_option("--size", options->size, "WIDTHxHEIGHT in pixels")
        ->capture_default_str()
        ->check(CLI::Validator(checked(parse_size), ""));
    command->add_option("--cut", options->cut, "Hide everything above this height, map units")
        ->check(number_between(-1e8, 1e8));
    command->add_flag("--roadmap", options->roadmap, "Draw the edges of the mesh that lie in free space");
    command->add_flag("--no-mesh", options->no_mesh, "Do not draw the triangles of the mesh");
    command->add_option("--opacity", options->opacity, "Opacity of the mesh's triangles")
        ->check(number_between(0.05, 1.0))
        ->capture_default_str();
    command->add_flag("--samples", options->samples,
                      "Draw points that uniform sampling puts on the obstacles, or those of the point cloud");
    add_track_options(*command, *options);
    command->add_option("--json", options->json,
                        "Write the viewpoint and the scale as JSON to this file; - is standard output");
    command->callback([options, &run] {
        check_usage(*options);
        run = [options] { return exit_code_of(render_file(*options)); };
    });
}

}  // namespace camdir::app
