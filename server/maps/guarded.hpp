// What a library throws becomes an error of the map that it was about: the others go on.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "base/error.hpp"

namespace camdir::maps {

// Runs `body`, which returns a Result. `what` begins the message.
template <class Body>
[[nodiscard]] auto guarded(const std::string& what, const Body& body) -> decltype(body()) {
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return fail(what + ": not enough memory");
    } catch (const std::exception& error) {
        return fail(what + ": " + error.what());
    }
}

}  // namespace camdir::maps
