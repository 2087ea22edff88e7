// What the benchmarks' programs have in common.
#pragma once

#include <stdexcept>
#include <utility>

#include "base/error.hpp"
#include "support/program.hpp"

namespace camdir::bench {

using test::run_program;

// Throws std::runtime_error with the error's message.
template <class Value>
Value value_of(Result<Value> result) {
    if (!result) throw std::runtime_error(result.error().message);
    return std::move(*result);
}

}  // namespace camdir::bench
