// Directors behind an address that outlives them and only forwards, as a cluster gives it.
#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <stdexcept>
#include <string>
#include <thread>

#include "hall.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using camera_director::Context;
using camera_director::Observer;

sockaddr_in loopback(int port) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    return address;
}

int port_of(const std::string& address) {
    return std::stoi(address.substr(address.find(':') + 1));
}

// Sends on what it receives, from a port of its own. Nothing comes back through it.
class Forwarder {
  public:
    explicit Forwarder(const std::string& to) : port_to_(port_of(to)) {
        const sockaddr_in any_port = loopback(0);
        const timeval patience{.tv_sec = 0, .tv_usec = 50'000};
        if (socket_ < 0 || ::bind(socket_, generic(any_port), sizeof any_port) != 0 ||
            ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience) != 0)
            throw std::runtime_error("no socket for forwarding");
        thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
    }
    ~Forwarder() {
        thread_.request_stop();
        thread_.join();
        ::close(socket_);
    }
    Forwarder(const Forwarder&) = delete;
    Forwarder& operator=(const Forwarder&) = delete;

    void send_on_to(const std::string& address) { port_to_ = port_of(address); }

    [[nodiscard]] std::string address() const {
        sockaddr_in address{};
        socklen_t size = sizeof address;
        ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
        return "127.0.0.1:" + std::to_string(ntohs(address.sin_port));
    }

  private:
    static const sockaddr* generic(const sockaddr_in& address) {
        return reinterpret_cast<const sockaddr*>(&address);
    }

    void run(const std::stop_token& stop) {
        std::array<char, 65536> datagram{};
        while (!stop.stop_requested()) {
            const ssize_t size = ::recv(socket_, datagram.data(), datagram.size(), 0);
            if (size <= 0) continue;
            const sockaddr_in to = loopback(port_to_);
            ::sendto(socket_, datagram.data(), static_cast<std::size_t>(size), 0, generic(to), sizeof to);
        }
    }

    const int socket_ = ::socket(AF_INET, SOCK_DGRAM, 0);
    std::atomic<int> port_to_;
    std::jthread thread_;
};

TEST(Address, AGameServerFindsTheDirectorThatComesBackElsewhere) {
    const TestDomain domain;
    Forwarder service(director_address(domain.id(), 0));
    const Context context = Context::open({.domain = domain.id(), .directors = service.address()}).value();
    const Game game(context, "cup", "hall");
    Observer observer = Observer::open(context, "cup", "anna").value();
    observer.request({.target = 1}).value();

    Server first(domain.id(), {.participant_index = 0, .director_id = 10});
    ASSERT_TRUE(sees_own_camera(observer)) << first.log();
    EXPECT_TRUE(serves_on(observer, 10, 30)) << first.log();
    first.process().send_signal(SIGKILL);
    (void)first.process().wait();

    service.send_on_to(director_address(domain.id(), 1));
    const Server second(domain.id(), {.participant_index = 1, .director_id = 20});
    EXPECT_TRUE(sees(observer, [](const auto& frame, auto) { return frame.director_id == 20; }))
        << second.log();
    EXPECT_TRUE(serves_on(observer, 20, 30)) << second.log();
}

}  // namespace
}  // namespace camdir::test
