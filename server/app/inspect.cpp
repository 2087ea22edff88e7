// camera-director inspect: the contents of a MAP.vfs.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <limits>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/commands.hpp"
#include "base/file.hpp"
#include "base/signals.hpp"
#include "config/json_text.hpp"
#include "freespace/freespace.hpp"

namespace camdir::app {
namespace {

using freespace::Freespace;
using nlohmann::ordered_json;

std::string hexadecimal(std::uint64_t hash) {
    std::ostringstream text;
    text << std::hex << std::setw(16) << std::setfill('0') << hash;
    return text.str();
}

// As --centre and --seed take it.
std::string triple(const Vec3f& p) {
    std::ostringstream text;
    text << p.x() << ',' << p.y() << ',' << p.z();
    return text.str();
}

ordered_json array(const Vec3f& p) {
    return {p.x(), p.y(), p.z()};
}

void print_row(const std::string& name, const std::string& value) {
    std::cerr << std::left << std::setw(18) << name << value << '\n';
}

template <class Number>
std::string number(Number value) {
    std::ostringstream text;
    text << std::setprecision(std::numeric_limits<Number>::digits10) << value;
    return text.str();
}

// Whole numbers with all digits, others with six.
std::string count_text(double value) {
    if (value == std::floor(value) && std::abs(value) < 1e15) return std::to_string(std::llround(value));
    std::ostringstream text;
    text << value;
    return text.str();
}

// What the bake counted: a row for each number, the name of the stage in its first row.
void print_counts(const std::vector<freespace::Count>& counts) {
    if (counts.empty()) return;
    std::cerr << "counts of the bake, lengths in units\n";
    std::string stage;
    for (const freespace::Count& count : counts) {
        std::cerr << "  " << std::left << std::setw(14) << (count.stage == stage ? "" : count.stage)
                  << std::right << std::setw(14) << count_text(count.value) << "  " << count.what << '\n';
        stage = count.stage;
    }
}

std::string degrees(float angle) {
    return count_text(static_cast<double>(angle / radians_of_a_degree<float>));
}

std::string near_spawn_point(const freespace::FixedShot& shot) {
    return shot.spawn_point == freespace::none ? "" : ", near spawn point " + number(shot.spawn_point);
}

void print_table(const Freespace& freespace) {
    const freespace::Metadata& metadata = freespace.metadata();
    print_row("map", metadata.map_name);
    print_row("source", metadata.source_name);
    print_row("source hash", hexadecimal(metadata.source_hash));
    print_row("metres per unit", number(metadata.metres_per_unit));
    print_row("d0", number(metadata.d0 * metadata.metres_per_unit) + " m, " + number(metadata.d0) + " units");
    print_row("parameters", metadata.parameters);
    print_row("vertices", number(freespace.vertices().size()));
    print_row("triangles", number(freespace.triangles().size()));
    print_row("bytes", number(freespace.byte_size()));
    print_row("bounds",
              triple(freespace.bounds().min()) + " .. " + triple(freespace.bounds().max()) + " units");
    for (const freespace::SpawnPoint& spawn : freespace.spawn_points())
        print_row("spawn point", triple(spawn.eye) + " units, yaw " + degrees(spawn.yaw) + " degrees");
    for (const freespace::MoverShape& mover : freespace.movers())
        print_row("mover", mover.name + " " + mover.kind + ", " + number(mover.hulls.size()) + " hulls, " +
                               number(mover.balls.size()) + " balls, at " + triple(mover.rest) + " units");
    const auto fixed_shots = freespace.fixed_shots();
    for (std::size_t i = 0; i < fixed_shots.size(); ++i)
        print_row("fixed shot " + number(i), triple(fixed_shots[i].position) + " units, yaw " +
                                                 degrees(fixed_shots[i].yaw) + ", pitch " +
                                                 degrees(fixed_shots[i].pitch) + " degrees" +
                                                 near_spawn_point(fixed_shots[i]));
    print_counts(metadata.counts);
}

ordered_json to_json(const Freespace& freespace) {
    const freespace::Metadata& metadata = freespace.metadata();
    ordered_json spawn_points = ordered_json::array();
    for (const freespace::SpawnPoint& spawn : freespace.spawn_points())
        spawn_points.push_back({{"eye", array(spawn.eye)}, {"yaw", spawn.yaw}});
    ordered_json movers = ordered_json::array();
    for (const freespace::MoverShape& mover : freespace.movers())
        movers.push_back({{"name", mover.name},
                          {"kind", mover.kind},
                          {"rest", array(mover.rest)},
                          {"hulls", mover.hulls.size()},
                          {"balls", mover.balls.size()}});
    ordered_json fixed_shots = ordered_json::array();
    for (const freespace::FixedShot& shot : freespace.fixed_shots())
        fixed_shots.push_back(
            {{"position", array(shot.position)},
             {"yaw", shot.yaw},
             {"pitch", shot.pitch},
             {"spawn_point",
              shot.spawn_point == freespace::none ? ordered_json(nullptr) : ordered_json(shot.spawn_point)}});
    ordered_json counts = ordered_json::array();
    for (const freespace::Count& count : metadata.counts)
        counts.push_back({{"stage", count.stage}, {"what", count.what}, {"value", count.value}});
    // Parameters that are not JSON are shown as a string.
    ordered_json parameters = metadata.parameters;
    if (config::parse_json(metadata.parameters)) parameters = ordered_json::parse(metadata.parameters);
    return {{"map_name", metadata.map_name},
            {"source_name", metadata.source_name},
            {"source_hash", hexadecimal(metadata.source_hash)},
            {"metres_per_unit", metadata.metres_per_unit},
            {"d0", metadata.d0},
            {"parameters", parameters},
            {"vertices", freespace.vertices().size()},
            {"triangles", freespace.triangles().size()},
            {"bytes", freespace.byte_size()},
            {"bounds", {{"min", array(freespace.bounds().min())}, {"max", array(freespace.bounds().max())}}},
            {"spawn_points", spawn_points},
            {"movers", movers},
            {"fixed_shots", fixed_shots},
            {"counts", counts}};
}

Result<Freespace> open_interruptibly(const std::string& file, const Interruption& interruption) {
    const ExitWhenInterrupted exits(interruption);
    return Freespace::open(file);
}

int inspect(const std::string& file, const std::string& json) {
    const Interruption interruption;
    const auto freespace = open_interruptibly(file, interruption);
    if (!freespace) return report(freespace.error());
    print_table(*freespace);
    if (json.empty()) return exit_done;
    return exit_code_of(write_file(json, config::format_json(to_json(*freespace))));
}

}  // namespace

void add_inspect(CLI::App& root, Run& run) {
    struct InspectOptions {
        std::string file, json;
    };
    const auto options = std::make_shared<InspectOptions>();
    CLI::App* command = root.add_subcommand("inspect", "Show the contents of a baked map.");
    command->add_option("FILE.vfs", options->file, "Baked map")->required();
    command->add_option("--json", options->json,
                        "Write the same as JSON to this file, angles in radians; - is standard output");
    command->callback([options, &run] { run = [options] { return inspect(options->file, options->json); }; });
}

}  // namespace camdir::app
