#include "connection.hpp"

#include <netdb.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstdint>
#include <memory>
#include <system_error>
#include <utility>

namespace camdir::qtv {
namespace {

std::string reason(int error) {
    return std::generic_category().message(error);
}

// Until the socket is ready.
Result<void> wait_for(int descriptor, short events, std::chrono::milliseconds patience,
                      const StopEvent& stop) {
    std::array<pollfd, 2> polled{{{descriptor, events, 0}, {stop.descriptor(), POLLIN, 0}}};
    const int ready = ::poll(polled.data(), polled.size(), static_cast<int>(patience.count()));
    if (polled[1].revents != 0) return fail("stopped", ErrorCode::interrupted);
    if (ready < 0) return fail("poll: " + reason(errno));
    if (ready == 0)
        return fail("nothing for " +
                    std::to_string(std::chrono::duration_cast<std::chrono::seconds>(patience).count()) +
                    " s");
    return {};
}

Result<void> connect(int descriptor, const addrinfo& to, std::chrono::milliseconds patience,
                     const StopEvent& stop) {
    if (::connect(descriptor, to.ai_addr, to.ai_addrlen) == 0) return {};
    if (errno != EINPROGRESS) return fail(reason(errno));
    if (auto waited = wait_for(descriptor, POLLOUT, patience, stop); !waited) return waited;
    int error = 0;
    socklen_t size = sizeof error;
    if (::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size) != 0) error = errno;
    if (error != 0) return fail(reason(error));
    return {};
}

}  // namespace

Result<Address> parse_address(const std::string& text) {
    const auto wrong = [&] { return fail("'" + text + "': expected HOST:PORT"); };
    const std::size_t colon = text.rfind(':');
    if (colon == std::string::npos || colon == 0) return wrong();
    Address address{text.substr(0, colon), text.substr(colon + 1)};
    if (address.host.front() == '[' && address.host.back() == ']')
        address.host = address.host.substr(1, address.host.size() - 2);
    else if (address.host.find(':') != std::string::npos)
        return wrong();
    std::uint16_t port = 0;
    const char* const end = address.port.data() + address.port.size();
    const auto parsed = std::from_chars(address.port.data(), end, port);
    if (parsed.ec != std::errc() || parsed.ptr != end || port == 0 || address.host.empty()) return wrong();
    return address;
}

std::string text_of(const Address& address) {
    const bool is_ipv6 = address.host.find(':') != std::string::npos;
    return (is_ipv6 ? "[" + address.host + "]" : address.host) + ":" + address.port;
}

StopEvent::StopEvent(const std::stop_token& stop) : descriptor_(::eventfd(0, EFD_CLOEXEC)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
    callback_.emplace(stop, Notify{descriptor_});
}

StopEvent::~StopEvent() {
    callback_.reset();
    ::close(descriptor_);
}

void StopEvent::Notify::operator()() const {
    [[maybe_unused]] const int written = ::eventfd_write(descriptor, 1);
}

bool StopEvent::wait(std::chrono::milliseconds time) const {
    pollfd polled{descriptor_, POLLIN, 0};
    return ::poll(&polled, 1, static_cast<int>(time.count())) > 0;
}

Result<Connection> Connection::open(const Address& address, std::chrono::milliseconds patience,
                                    const StopEvent& stop) {
    addrinfo hints{};
    hints.ai_socktype = SOCK_STREAM;
    addrinfo* found = nullptr;
    const int status = ::getaddrinfo(address.host.c_str(), address.port.c_str(), &hints, &found);
    if (status != 0) return fail(::gai_strerror(status));
    const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, ::freeaddrinfo);
    Result<void> connected = fail("no address");
    for (const addrinfo* to = addresses.get(); to != nullptr; to = to->ai_next) {
        const int descriptor = ::socket(to->ai_family, to->ai_socktype | SOCK_NONBLOCK | SOCK_CLOEXEC, 0);
        if (descriptor < 0) {
            connected = fail(reason(errno));
            continue;
        }
        Connection connection(descriptor, stop);
        connected = connect(descriptor, *to, patience, stop);
        if (connected) return connection;
        if (connected.error().code == ErrorCode::interrupted) break;
    }
    return tl::unexpected(connected.error());
}

Connection::Connection(Connection&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), stop_(other.stop_) {}

Connection::~Connection() {
    if (descriptor_ >= 0) ::close(descriptor_);
}

// A new connection takes this much at once.
Result<void> Connection::send(std::string_view text) {
    const ssize_t sent = ::send(descriptor_, text.data(), text.size(), MSG_NOSIGNAL);
    if (sent == static_cast<ssize_t>(text.size())) return {};
    return fail("the request cannot be sent" + (sent < 0 ? ": " + reason(errno) : std::string()));
}

Result<std::span<const std::byte>> Connection::receive(std::span<std::byte> buffer,
                                                       std::chrono::milliseconds patience) {
    if (const auto waited = wait_for(descriptor_, POLLIN, patience, stop_); !waited)
        return tl::unexpected(waited.error());
    const ssize_t received = ::recv(descriptor_, buffer.data(), buffer.size(), 0);
    if (received < 0) return fail(reason(errno));
    return std::span<const std::byte>(buffer).first(static_cast<std::size_t>(received));
}

}  // namespace camdir::qtv
