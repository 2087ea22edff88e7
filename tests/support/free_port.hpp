// Ports for programs that cannot choose one themselves.
#pragma once

namespace camdir::test {

// Of the loopback address; free now. `type`: SOCK_STREAM for TCP, SOCK_DGRAM for UDP. Throws
// std::runtime_error when there is none.
[[nodiscard]] int free_port(int type);

}  // namespace camdir::test
