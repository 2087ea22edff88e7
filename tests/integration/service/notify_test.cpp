// What the server tells systemd, by systemd's own protocol: datagrams to the socket that it names.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>

#include "served.hpp"
#include "support/eventually.hpp"

namespace camdir::test {
namespace {

// Stands in for systemd to the processes that are started while it lives.
class Systemd {
  public:
    explicit Systemd(const std::string& path) {
        sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
        path.copy(address.sun_path, sizeof address.sun_path - 1);
        if (path.size() >= sizeof address.sun_path ||
            ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0)
            throw std::runtime_error("cannot listen on " + path);
        ::setenv("NOTIFY_SOCKET", path.c_str(), 1);
    }
    Systemd(const Systemd&) = delete;
    Systemd& operator=(const Systemd&) = delete;
    ~Systemd() {
        ::unsetenv("NOTIFY_SOCKET");
        ::close(socket_);
    }

    // Forgets what it was told until something contains the text; false when nothing does.
    [[nodiscard]] bool told(const std::string& text) {
        return eventually([&] {
            std::array<char, 4096> message{};
            const ssize_t size = ::recv(socket_, message.data(), message.size(), MSG_DONTWAIT);
            return size > 0 && std::string(message.data(), static_cast<std::size_t>(size)).find(text) !=
                                   std::string::npos;
        });
    }

  private:
    const int socket_ = ::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0);
};

TEST(Notifications, TellThatItIsReadyAliveReloadingAndStopping) {
    const Folder folder;
    Systemd systemd(folder / "notify");
    Served served(folder, quiet_config());
    EXPECT_TRUE(systemd.told("READY=1")) << served.log();
    EXPECT_TRUE(systemd.told("WATCHDOG=1"));
    EXPECT_TRUE(systemd.told("WATCHDOG=1"));
    served.signal(SIGHUP);
    EXPECT_TRUE(systemd.told("RELOADING=1\nMONOTONIC_USEC="));
    EXPECT_TRUE(systemd.told("READY=1"));
    folder.write("config.json", "no JSON");
    served.signal(SIGHUP);
    EXPECT_TRUE(systemd.told("RELOADING=1"));
    EXPECT_TRUE(systemd.told("READY=1\nSTATUS=the configuration file was refused"))
        << "the configuration before stays in effect";
    served.signal(SIGTERM);
    EXPECT_TRUE(systemd.told("STOPPING=1"));
    EXPECT_EQ(served.exit_code(), 0);
}

}  // namespace
}  // namespace camdir::test
