#include "support/http_client.hpp"

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <sstream>
#include <stdexcept>

#include "support/eventually.hpp"

namespace camdir::test {
namespace {

std::string lower(std::string text) {
    std::transform(text.begin(), text.end(), text.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return text;
}

// Up to the empty line.
HttpAnswer parse_header(const std::string& text) {
    std::istringstream lines(text);
    HttpAnswer answer;
    std::string version;
    if (!(lines >> version >> answer.status) || !version.starts_with("HTTP/1."))
        throw std::runtime_error("no answer of HTTP: " + text);
    std::string line;
    std::getline(lines, line);
    while (std::getline(lines, line) && line != "\r") {
        const std::size_t colon = line.find(": ");
        if (colon == std::string::npos) throw std::runtime_error("no line of a header: " + line);
        answer.header[lower(line.substr(0, colon))] = line.substr(colon + 2, line.size() - colon - 3);
    }
    return answer;
}

}  // namespace

HttpClient::HttpClient() : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    if (socket_ < 0) throw std::runtime_error("cannot open a socket");
    const timeval limit{patience.count(), 0};
    ::setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
}

HttpClient::~HttpClient() {
    ::close(socket_);
}

void HttpClient::connect(int port) const {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_port = htons(static_cast<std::uint16_t>(port));
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
        throw std::runtime_error("cannot connect to port " + std::to_string(port));
}

bool HttpClient::send(const std::string& bytes) const {
    std::size_t sent = 0;
    while (sent < bytes.size()) {
        const ssize_t more = ::send(socket_, bytes.data() + sent, bytes.size() - sent, MSG_NOSIGNAL);
        if (more < 0) return false;
        sent += static_cast<std::size_t>(more);
    }
    return true;
}

void HttpClient::read_more() {
    std::array<char, 16384> bytes{};
    const ssize_t more = ::recv(socket_, bytes.data(), bytes.size(), 0);
    if (more == 0) throw std::runtime_error("the server closed the connection");
    if (more < 0) throw std::runtime_error("no answer of the server");
    received_.append(bytes.data(), static_cast<std::size_t>(more));
}

HttpAnswer HttpClient::receive(bool to_head) {
    std::size_t end = 0;
    while ((end = received_.find("\r\n\r\n")) == std::string::npos)
        read_more();
    HttpAnswer answer = parse_header(received_.substr(0, end + 4));
    received_.erase(0, end + 4);
    if (to_head || answer.status == 304) return answer;
    const std::size_t size = std::stoul(answer.header.at("content-length"));
    while (received_.size() < size)
        read_more();
    answer.body = received_.substr(0, size);
    received_.erase(0, size);
    return answer;
}

HttpAnswer HttpClient::ask(const std::string& method, const std::string& path, const std::string& header,
                           const std::string& body) {
    (void)send(http_request(method, path, header, body));  // an early answer may be there all the same
    return receive(method == "HEAD");
}

bool HttpClient::closed() const {
    char byte = 0;
    const ssize_t more = ::recv(socket_, &byte, 1, MSG_PEEK | MSG_DONTWAIT);
    return more == 0 || (more < 0 && errno != EAGAIN);
}

std::string http_request(const std::string& method, const std::string& path, const std::string& header,
                         const std::string& body) {
    std::string request = method + " " + path + " HTTP/1.1\r\nHost: localhost\r\n" + header;
    if (!body.empty()) request += "Content-Length: " + std::to_string(body.size()) + "\r\n";
    return request + "\r\n" + body;
}

}  // namespace camdir::test
