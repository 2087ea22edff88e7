#include "qtv_server.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <stdexcept>

#include "support/eventually.hpp"

namespace camdir::test {
namespace {

bool readable(int descriptor) {
    pollfd polled{descriptor, POLLIN, 0};
    const auto limit = std::chrono::milliseconds(patience).count();
    return ::poll(&polled, 1, static_cast<int>(limit)) > 0;
}

}  // namespace

QtvServer::QtvServer() : listener_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    if (::bind(listener_, generic, size) != 0 || ::listen(listener_, 1) != 0 ||
        ::getsockname(listener_, generic, &size) != 0)
        throw std::runtime_error("no free TCP port");
    port_ = ntohs(address.sin_port);
}

QtvServer::~QtvServer() {
    close();
    ::close(listener_);
}

std::optional<std::string> QtvServer::accept() {
    close();
    if (!readable(listener_)) return std::nullopt;
    connection_ = ::accept4(listener_, nullptr, nullptr, SOCK_CLOEXEC);
    std::string request;
    while (connection_ >= 0 && !request.ends_with("\n\n") && readable(connection_)) {
        std::array<char, 1024> buffer{};
        const ssize_t size = ::recv(connection_, buffer.data(), buffer.size(), 0);
        if (size <= 0) break;
        request.append(buffer.data(), static_cast<std::size_t>(size));
    }
    return request;
}

void QtvServer::send(const std::string& text) {
    send(std::as_bytes(std::span(text)));
}

void QtvServer::send(std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t sent = ::send(connection_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
        if (sent <= 0) throw std::runtime_error("the publisher has closed the connection");
        bytes = bytes.subspan(static_cast<std::size_t>(sent));
    }
}

void QtvServer::close() {
    if (connection_ >= 0) ::close(connection_);
    connection_ = -1;
}

}  // namespace camdir::test
