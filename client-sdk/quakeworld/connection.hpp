// A TCP connection that a stop request ends at once.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <span>
#include <stop_token>
#include <string>
#include <string_view>

#include "base/error.hpp"

namespace camdir::qtv {

struct Address {
    std::string host;  // name or address
    std::string port;  // 1 .. 65535
};

// HOST:PORT, of an IPv6 address [HOST]:PORT.
[[nodiscard]] Result<Address> parse_address(const std::string& text);
[[nodiscard]] std::string text_of(const Address& address);

// A descriptor that is readable from the stop request on.
class StopEvent {
  public:
    // Throws std::system_error when the process has no descriptor left.
    explicit StopEvent(const std::stop_token& stop);
    StopEvent(const StopEvent&) = delete;
    StopEvent& operator=(const StopEvent&) = delete;
    ~StopEvent();

    [[nodiscard]] int descriptor() const { return descriptor_; }
    // Returns true when a stop was requested before `time` has passed.
    [[nodiscard]] bool wait(std::chrono::milliseconds time) const;

  private:
    struct Notify {
        int descriptor;
        void operator()() const;
    };

    int descriptor_;
    std::optional<std::stop_callback<Notify>> callback_;
};

// Errors have ErrorCode::interrupted where the stop request was the reason. `stop` must outlive it.
class Connection {
  public:
    // Waits for the name server, which no stop request ends, and at most `patience` for each of the host's
    // addresses.
    [[nodiscard]] static Result<Connection> open(const Address& address, std::chrono::milliseconds patience,
                                                 const StopEvent& stop);
    Connection(Connection&& other) noexcept;
    Connection& operator=(Connection&&) = delete;
    ~Connection();

    // A few hundred bytes.
    [[nodiscard]] Result<void> send(std::string_view text);
    // Waits for bytes, at most `patience`. Returns those that have arrived, in `buffer`; none: the peer has
    // closed the connection.
    [[nodiscard]] Result<std::span<const std::byte>> receive(std::span<std::byte> buffer,
                                                             std::chrono::milliseconds patience);

  private:
    Connection(int descriptor, const StopEvent& stop) : descriptor_(descriptor), stop_(stop) {}

    int descriptor_;  // -1: moved from
    const StopEvent& stop_;
};

}  // namespace camdir::qtv
