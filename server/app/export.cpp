// camera-director export: the medial mesh with its free distances as a PLY file, for mesh viewers.
#include <bit>
#include <cstring>

#include "app/commands.hpp"
#include "base/file.hpp"
#include "freespace/freespace.hpp"

namespace camdir::app {
namespace {

using freespace::Freespace;
using freespace::Triangle;
using freespace::Vertex;

static_assert(std::endian::native == std::endian::little, "PLY is written in the order of memory");

std::string ply_header(const Freespace& freespace) {
    return "ply\n"
           "format binary_little_endian 1.0\n"
           "element vertex " +
           std::to_string(freespace.vertices().size()) +
           "\n"
           "property float x\n"
           "property float y\n"
           "property float z\n"
           "property float free_distance\n"
           "element face " +
           std::to_string(freespace.triangles().size()) +
           "\n"
           "property list uchar uint vertex_indices\n"
           "end_header\n";
}

template <class Value>
void append(Bytes& bytes, const Value& value) {
    const auto raw = std::as_bytes(std::span(&value, 1));
    bytes.insert(bytes.end(), raw.begin(), raw.end());
}

Bytes to_ply(const Freespace& freespace) {
    Bytes bytes;
    for (const char character : ply_header(freespace))
        append(bytes, character);
    for (const Vertex& vertex : freespace.vertices())
        append(bytes, vertex);
    for (const Triangle& triangle : freespace.triangles()) {
        append(bytes, std::uint8_t{3});
        append(bytes, triangle);
    }
    return bytes;
}

int export_ply(const std::string& file, const std::string& ply) {
    const auto freespace = Freespace::open(file);
    if (!freespace) return report(freespace.error());
    const auto written = write_file(ply, to_ply(*freespace));
    return written ? exit_done : report(written.error());
}

}  // namespace

void add_export(CLI::App& root, Run& run) {
    struct Options {
        std::string file, ply;
    };
    const auto options = std::make_shared<Options>();
    CLI::App* command =
        root.add_subcommand("export", "Write the medial mesh of a baked map for mesh viewers.");
    command->add_option("FILE.vfs", options->file, "Baked map")->required();
    command->add_option("--ply", options->ply, "Binary PLY file to write, - for standard output")->required();
    command->callback(
        [options, &run] { run = [options] { return export_ply(options->file, options->ply); }; });
}

}  // namespace camdir::app
