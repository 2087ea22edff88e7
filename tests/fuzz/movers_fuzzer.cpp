#include <cassert>
#include <cmath>
#include <cstdint>
#include <span>

#include "evaluation/mover_tracks.hpp"

// Whatever the bytes: an error with a message, or rows in order, of which the mover of a fixed scene is
// somewhere at any time.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace camdir;
    const auto rows = evaluation::parse_movers(std::as_bytes(std::span(data, size)), "input");
    if (!rows) {
        assert(!rows.error().message.empty());
        return 0;
    }
    evaluation::Trace trace;
    trace.frames = {{0, 0, 0}, {50'000'000, 0, 0}, {100'000'000, 0, 0}};
    const scene::Mover movers[] = {{"*1", "func_door", {}, Vec3d::Zero()}};
    const evaluation::MoverTracks tracks(*rows, movers, trace);
    for (std::size_t i = 0; i < rows->size(); ++i) {
        assert(i == 0 || (*rows)[i - 1].time <= (*rows)[i].time);
        for (const std::int64_t time : {(*rows)[i].time, (*rows)[i].time + 1'000'000}) {
            const auto placement = tracks.at(0, time);
            assert((*rows)[i].model != 1 || placement);
            assert(!placement ||
                   (placement->position.allFinite() && std::abs(placement->orientation.norm() - 1.0) < 1e-6));
        }
    }
    return 0;
}
