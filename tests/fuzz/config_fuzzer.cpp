#include <cassert>
#include <cstdint>
#include <string>

#include "config/config.hpp"

// Whatever the bytes, as a configuration and as an observer's overrides: an error with a message, or values
// in range.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace camdir::config;
    const std::string text(reinterpret_cast<const char*>(data), size);
    const auto config = parse(text, "input", "/");
    if (config)
        assert(config->profiles.contains(config->matches.default_profile) && config->limits.matches >= 1);
    else
        assert(!config.error().message.empty());
    const auto profile = override_profile({}, text, config ? config->overrides : std::nullopt);
    assert(profile ? profile->distance > 0.0F : !profile.error().message.empty());
    return 0;
}
