// Converts exceptions of libraries into errors of one map, so that the others continue.
#pragma once

#include <exception>
#include <new>
#include <string>

#include "base/error.hpp"

namespace camdir::maps {

// Calls `body`, which returns a Result. `what` is the prefix of the message.
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
