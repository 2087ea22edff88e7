// Arbitrary bytes are a scene that keeps its promises, or an error of one line.
#include <cstdint>
#include <span>

#include "scene/quake3/read_scene.hpp"
#include "scene_promises.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    camdir::fuzz::check(camdir::scene::read_q3_scene(std::as_bytes(std::span(data, size))));
    return 0;
}
