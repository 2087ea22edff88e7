#include "failure.hpp"

#include <cstdio>

namespace camdir::sdk {

namespace {

thread_local char last_error_text[512] = "";

}  // namespace

void set_last_error(const char* text) noexcept {
    std::snprintf(last_error_text, sizeof last_error_text, "%s", text);
}

const char* last_error() noexcept {
    return last_error_text;
}

}  // namespace camdir::sdk
