#include <xxhash.h>

#include <cassert>
#include <cmath>
#include <cstring>
#include <optional>
#include <vector>

#include "freespace/distance.hpp"
#include "freespace/freespace.hpp"
#include "freespace/roadmap.hpp"
#include "freespace/visibility.hpp"

namespace {

using namespace camdir;

template <class Value>
std::optional<Value> read_at(const std::vector<std::byte>& bytes, std::size_t position) {
    if (bytes.size() < sizeof(Value) || position > bytes.size() - sizeof(Value)) return std::nullopt;
    Value value;
    std::memcpy(&value, bytes.data() + position, sizeof value);
    return value;
}

// Offset of the file's header: the first field of FlatBuffers' root table.
std::optional<std::size_t> header_position(const std::vector<std::byte>& bytes) {
    const auto root = read_at<std::uint32_t>(bytes, 0);
    if (!root) return std::nullopt;
    const auto table = read_at<std::int32_t>(bytes, *root);
    if (!table) return std::nullopt;
    const std::int64_t fields = static_cast<std::int64_t>(*root) - *table;
    if (fields < 0) return std::nullopt;
    const auto field = read_at<std::uint16_t>(bytes, static_cast<std::size_t>(fields) + 4);
    if (!field) return std::nullopt;
    return *root + *field;
}

// Repairs size and hash of damaged bytes, so that the checks behind the hash are reached.
void reseal(std::vector<std::byte>& bytes) {
    const auto header = header_position(bytes);
    if (!header || !read_at<std::array<std::uint64_t, 3>>(bytes, *header)) return;
    const std::array<std::uint64_t, 2> size_and_no_hash = {bytes.size(), 0};
    std::memcpy(bytes.data() + *header + 8, size_and_no_hash.data(), sizeof size_and_no_hash);
    const std::uint64_t hash = XXH3_64bits(bytes.data(), bytes.size());
    std::memcpy(bytes.data() + *header + 16, &hash, sizeof hash);
}

// Every query must end, with an answer that keeps its contract.
void query(const freespace::Freespace& freespace) {
    std::vector<Vec3f> points = {Vec3f::Zero(), freespace.bounds().center()};
    for (const freespace::Vertex& vertex :
         freespace.vertices().first(std::min<std::size_t>(freespace.vertices().size(), 4)))
        points.push_back(vertex.position());
    freespace::RoadmapSearch roadmap(freespace);
    for (const Vec3f& from : points) {
        const freespace::Distance near = freespace::distance(freespace, from);
        assert(!std::isnan(near.value));
        for (const Vec3f& to : points) {
            const freespace::Sight sight = freespace::sight(freespace, from, to);
            assert(!sight.clear || sight.clearance > 0.0F);
            assert(sight.free_length >= 0.0F && sight.clearance >= 0.0F);
            const freespace::RoadmapPath& path = roadmap.find(from, to);
            assert(path.found != path.vertices.empty());
        }
    }
}

}  // namespace

// Whatever the bytes: an error with a message, or a freespace that can be queried.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const auto bytes = std::as_bytes(std::span(data, size));
    std::vector<std::byte> sealed(bytes.begin(), bytes.end());
    reseal(sealed);
    for (const auto& input : {std::vector(bytes.begin(), bytes.end()), sealed}) {
        const auto freespace = freespace::Freespace::parse(input, "input");
        if (freespace)
            query(*freespace);
        else
            assert(!freespace.error().message.empty());
    }
    return 0;
}
