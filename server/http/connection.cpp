#include "http/connection.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <cerrno>

namespace camdir::http {

bool Connection::ready(short event) const {
    for (;;) {
        const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline_ - Clock::now()).count();
        if (left <= 0) return false;
        pollfd polled{socket_, event, 0};
        const int count = ::poll(&polled, 1, static_cast<int>(left));
        if (count >= 0 || errno != EINTR) return count > 0;
    }
}

ssize_t Connection::read(char* to, std::size_t size) {
    if (readable_ == 0 || !is_readable()) return -1;
    const ssize_t got = ::recv(socket_, to, std::min(size, readable_), 0);
    if (got > 0) readable_ -= static_cast<std::size_t>(got);
    return got;
}

ssize_t Connection::write(const char* from, std::size_t size) {
    return is_writable() ? ::send(socket_, from, size, MSG_NOSIGNAL | MSG_DONTWAIT) : -1;
}

}  // namespace camdir::http
