#include "app/read_options.hpp"

#include "maps/source.hpp"

namespace camdir::app {
namespace {

Vec3d checked_point(const std::string& option, const std::string& text) {
    const auto point = maps::parse_point(text);
    if (!point) throw CLI::ValidationError(option, "'" + text + "': expected three numbers, x,y,z");
    return *point;
}

}  // namespace

void add_read_options(CLI::App& command, scene::ReadOptions& options) {
    command
        .add_option_function<double>(
            "--metres-per-unit", [&options](double value) { options.metres_per_unit = value; },
            "Length of a map unit; default: 0.0254 for a BSP, 1 for a mesh or a point cloud")
        ->check(CLI::Range(1e-6, 1e6));
    command
        .add_option_function<std::string>(
            "--up", [&options](const std::string& axis) { options.up = maps::parse_up(axis); },
            "Axis of a mesh or a point cloud that points up: y or z; default: y for glTF, else z. With y, "
            "(x, y, z) becomes (z, x, y)")
        ->check(CLI::IsMember({"y", "z"}));
    command.add_option_function<std::string>(
        "--origin", [&options](const std::string& text) { options.origin = checked_point("--origin", text); },
        "x,y,z of a mesh or a point cloud, in its own axes, that becomes 0,0,0");
    command
        .add_option_function<std::vector<std::string>>(
            "--seed",
            [&options](const std::vector<std::string>& texts) {
                options.seeds.clear();
                for (const std::string& text : texts)
                    options.seeds.push_back(checked_point("--seed", text));
            },
            "x,y,z in the free space, in map units with z up, beside the map's spawn points; repeatable. "
            "Without either the largest connected part is baked")
        ->type_name("X,Y,Z")
        ->expected(1)
        ->take_all();
}

}  // namespace camdir::app
