// How a QTV stream begins: what is asked of a QTV server, and its answer.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace camdir::qtv {

struct StreamRequest {
    std::string source;    // which of a proxy's streams; empty: the only one, as a game server has it
    std::string password;  // empty: none
};

// An error where a value holds a control character or a quotation mark, which the protocol cannot carry.
[[nodiscard]] Result<void> check(const StreamRequest& request);

// Version 1 of the protocol. Precondition: check() has nothing against it.
[[nodiscard]] std::string text_of(const StreamRequest& request);

struct Answer {
    enum class Kind {
        begin,    // the stream follows
        refused,  // for good, for example for a wrong password
        busy,     // perhaps not later
    };
    Kind kind = Kind::begin;
    std::string reason;    // of the server, printable; of a begin empty
    std::size_t size = 0;  // bytes of the answer, behind which the stream begins
};

// The answer at the front of what a server has sent; nothing while it is not complete. Errors name the byte
// and what was expected.
[[nodiscard]] Result<std::optional<Answer>> read_answer(std::span<const std::byte> sent);

}  // namespace camdir::qtv
