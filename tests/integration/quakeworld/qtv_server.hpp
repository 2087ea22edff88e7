// A QTV server that streams what a test gives it.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>

#include "base/file.hpp"

namespace camdir::test {

// Listens on a free port of this machine, for one connection at a time. Throws where it cannot.
class QtvServer {
  public:
    QtvServer();
    ~QtvServer();
    QtvServer(const QtvServer&) = delete;
    QtvServer& operator=(const QtvServer&) = delete;

    [[nodiscard]] int port() const { return port_; }
    // Waits for a connection and its request, which it returns; nothing when none came.
    [[nodiscard]] std::optional<std::string> accept();
    void send(const std::string& text);
    void send(std::span<const std::byte> bytes);
    void close();

  private:
    int listener_ = -1;
    int connection_ = -1;
    int port_ = 0;
};

}  // namespace camdir::test
