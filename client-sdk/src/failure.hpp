// How the library reports failures inside, and their conversion to a status at the C boundary.
#pragma once

#include <camera_director/camera_director.h>

#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace camdir::sdk {

// The only exception thrown on purpose; never leaves the C functions.
struct Failure {
    cdir_status status;
    std::string text;  // one line: what was wrong, and what was expected
};

// cdir_last_error() of this thread; longer messages are cut.
inline thread_local char last_error_text[512] = "";

inline void set_last_error(const char* text) noexcept {
    std::snprintf(last_error_text, sizeof last_error_text, "%s", text);
}

// Runs the body of a C function: exceptions become a status and cdir_last_error().
template <class Call>
[[nodiscard]] cdir_status guarded(Call&& call) noexcept {
    try {
        return call();
    } catch (const Failure& failure) {
        set_last_error(failure.text.c_str());
        return failure.status;
    } catch (const std::bad_alloc&) {
        set_last_error("out of memory");
        return CDIR_OUT_OF_MEMORY;
    } catch (const std::exception& error) {
        set_last_error(error.what());
    } catch (...) {
        set_last_error("unknown exception");
    }
    return CDIR_INTERNAL;
}

}  // namespace camdir::sdk
