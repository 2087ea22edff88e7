#include <cassert>
#include <cmath>
#include <vector>

#include "freespace/distance.hpp"
#include "freespace/freespace.hpp"
#include "freespace/roadmap.hpp"
#include "freespace/visibility.hpp"
#include "support/vfs_seal.hpp"

namespace {

using namespace camdir;

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
    test::reseal(sealed);
    for (const auto& input : {std::vector(bytes.begin(), bytes.end()), sealed}) {
        const auto freespace = freespace::Freespace::parse(input, "input");
        if (freespace)
            query(*freespace);
        else
            assert(!freespace.error().message.empty());
    }
    return 0;
}
