#include "spectator.hpp"

#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstring>
#include <stdexcept>

namespace camdir::test {
namespace {

constexpr char string_command = 4;
constexpr char begin_level = 11;
constexpr std::uint32_t protocol = 28;
constexpr std::uint32_t reliable = 1U << 31U;
const std::string connectionless = "\xff\xff\xff\xff";
constexpr int tick_ms = 100;
constexpr int packets_between_steps = 40;  // about half a second of a server

void append(std::string& to, std::uint32_t value, int size) {
    for (int i = 0; i < size; ++i)
        to += static_cast<char>(value >> (8 * i));
}

std::uint32_t number_at(std::string_view bytes, std::size_t offset) {
    std::uint32_t value = 0;
    if (offset + sizeof value <= bytes.size()) std::memcpy(&value, bytes.data() + offset, sizeof value);
    return value;
}

// The next packet, which is empty when none comes within a tick.
std::string receive(int socket) {
    pollfd polled{socket, POLLIN, 0};
    std::array<char, 8192> buffer{};
    if (::poll(&polled, 1, tick_ms) <= 0) return {};
    const ssize_t size = ::recv(socket, buffer.data(), buffer.size(), 0);
    return {buffer.data(), size > 0 ? static_cast<std::size_t>(size) : 0};
}

}  // namespace

QuakeWorldSpectator::QuakeWorldSpectator(int port, int bots)
    : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)), bots_(bots) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
        throw std::runtime_error("no UDP socket");
    thread_ = std::jthread([this](const std::stop_token& stop) { run(stop); });
}

QuakeWorldSpectator::~QuakeWorldSpectator() {
    thread_.request_stop();
    thread_.join();
    ::close(socket_);
}

void QuakeWorldSpectator::run(const std::stop_token& stop) {
    if (!connect(stop)) return;
    send("new");
    for (int packets = 0; !stop.stop_requested();) {
        const std::string packet = receive(socket_);
        if (!packet.empty()) take(packet);
        if (!packet.empty() && ++packets % packets_between_steps == 0) take_step();
        send();
    }
    send("drop");
}

// Asks until the server, which is still starting perhaps, answers: for a number, then with it to be let in.
bool QuakeWorldSpectator::connect(const std::stop_token& stop) {
    std::string request = "getchallenge\n";
    while (!stop.stop_requested()) {
        const std::string bytes = connectionless + request;
        (void)::send(socket_, bytes.data(), bytes.size(), 0);
        const std::string answer = receive(socket_);
        if (answer.size() <= connectionless.size()) continue;
        const std::string said = answer.substr(connectionless.size());
        if (said.front() == 'j') return true;
        if (said.front() == 'c')
            request = "connect 28 4242 " + said.substr(1, said.find('\0') - 1) +
                      " \"\\name\\host\\rate\\25000\\spectator\\1\"\n";
    }
    return false;
}

void QuakeWorldSpectator::take(std::string_view packet) {
    const std::uint32_t number = number_at(packet, 0);
    if (packet.size() < 8 || (number & ~reliable) <= received_) return;
    received_ = number & ~reliable;
    if ((number & reliable) != 0) odd_ = !odd_;
    const std::string_view content = packet.substr(8);
    if (step_ == Step::greet && content.find("cmd pext") != std::string_view::npos) send("pext");
    if (step_ == Step::greet && content.find("cmd new") != std::string_view::npos) send("new");
    const std::size_t begun = content.find(begin_level);
    if (step_ == Step::greet && begun != std::string_view::npos &&
        content.find("fullserverinfo") != std::string_view::npos) {
        // Extensions, in pairs, stand before the protocol.
        std::size_t at = begun + 1;
        while (at < content.size() && number_at(content, at) != protocol)
            at += 8;
        level_ = std::to_string(number_at(content, at + 4));
        step_ = Step::spawn;
    }
}

void QuakeWorldSpectator::take_step() {
    switch (step_) {
        case Step::spawn:
            send("spawn " + level_ + " 0");
            step_ = Step::begin;
            break;
        case Step::begin:
            send("begin " + level_);
            step_ = Step::add_bots;
            break;
        case Step::add_bots:
            if (bots_-- > 0) send("botcmd addbot");
            break;
        case Step::greet:
            break;
    }
}

void QuakeWorldSpectator::send(const std::string& command) {
    std::string packet;
    append(packet, ++sent_, 4);
    append(packet, received_ | (odd_ ? reliable : 0U), 4);
    append(packet, 4242, 2);
    if (!command.empty()) packet += string_command + command + '\0';
    (void)::send(socket_, packet.data(), packet.size(), 0);
}

}  // namespace camdir::test
