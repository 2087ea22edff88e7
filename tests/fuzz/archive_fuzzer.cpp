// Arbitrary bytes as a pk3: a map is read from it, or an error of one line is given.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "scene/load.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const int file = ::memfd_create("archive", 0);
    if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
    const std::string path = "/proc/self/fd/" + std::to_string(file);
    for (const std::string& source : {path + ":maps/a.bsp", path}) {
        const auto scene = camdir::scene::load(source);
        if (!scene && scene.error().message.empty()) std::abort();
    }
    ::close(file);
    return 0;
}
