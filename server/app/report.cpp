#include <iostream>

#include "app/commands.hpp"

namespace camdir::app {

int report(const Error& error) {
    std::cerr << "camera-director: " << error.message << '\n';
    return error.code == ErrorCode::interrupted ? exit_interrupted : exit_failed;
}

}  // namespace camdir::app
