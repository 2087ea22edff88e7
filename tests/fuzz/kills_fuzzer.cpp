#include <cassert>
#include <cstdint>
#include <span>

#include "evaluation/events.hpp"
#include "evaluation/kills.hpp"

// Whatever the bytes: an error with a message, or kills of one player of a fixed trace by another, and events
// in order.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace camdir::evaluation;
    Trace trace;
    trace.players = {0, 1};
    const auto events = parse_events(std::as_bytes(std::span(data, size)), "input", trace);
    if (events)
        for (std::size_t i = 1; i < events->size(); ++i)
            assert((*events)[i - 1].time <= (*events)[i].time);
    else
        assert(!events.error().message.empty());
    const auto kills = parse_kills(std::as_bytes(std::span(data, size)), "input", trace);
    if (!kills) {
        assert(!kills.error().message.empty());
        return 0;
    }
    for (const Kill& kill : *kills)
        assert(kill.time >= 0 && kill.killer + kill.victim == 1);
    return 0;
}
