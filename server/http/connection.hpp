// A connection with limits on time and bytes.
#pragma once

#include <httplib.h>
#include <poll.h>

#include <chrono>

namespace camdir::http {

// httplib's stream over a socket, for one request and its answer: reads and writes fail after `deadline`, and
// reads fail beyond a few kilobytes. httplib's own stream restarts its timeout at every byte and reads lines
// of any length.
class Connection final : public httplib::Stream {
  public:
    using Clock = std::chrono::steady_clock;

    // The socket must outlive it and stays open.
    Connection(socket_t socket, Clock::time_point deadline) : socket_(socket), deadline_(deadline) {}

    [[nodiscard]] bool is_readable() const override { return ready(POLLIN); }
    [[nodiscard]] bool is_writable() const override { return ready(POLLOUT); }
    ssize_t read(char* to, std::size_t size) override;
    ssize_t write(const char* from, std::size_t size) override;
    void get_remote_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
    void get_local_ip_and_port(std::string& /*ip*/, int& /*port*/) const override {}
    [[nodiscard]] socket_t socket() const override { return socket_; }

  private:
    // Waits for the event, until the deadline.
    [[nodiscard]] bool ready(short event) const;

    socket_t socket_;
    Clock::time_point deadline_;
    std::size_t readable_ = 16 * 1024;  // bytes left to read; enough for a browser's headers
};

}  // namespace camdir::http
