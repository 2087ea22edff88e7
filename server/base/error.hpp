// The project's one error type. Operational failures are values with context; bugs assert.
#pragma once

#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace camdir {

enum class ErrorCode {
    failed,       // bad input, bad content, a violated check: exit code 1
    interrupted,  // the user asked to stop: exit code 130
};

// message: one line that says what was wrong, where (file, byte, JSON pointer, topic) and what was expected.
struct Error {
    std::string message;
    ErrorCode code = ErrorCode::failed;
};

template <class T>
using Result = tl::expected<T, Error>;

[[nodiscard]] inline tl::unexpected<Error> fail(std::string message, ErrorCode code = ErrorCode::failed) {
    return tl::unexpected<Error>(Error{std::move(message), code});
}

}  // namespace camdir
