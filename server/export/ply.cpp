#include "export/ply.hpp"

#include <bit>
#include <string>

namespace camdir::exports {
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

}  // namespace

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

}  // namespace camdir::exports
