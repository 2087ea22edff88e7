// Hosts of a network of their own on this machine, whose packets can be lost.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace camdir::soak {

// Puts this process and its children into a network of their own with the loopback interface alone, without
// privileges where the kernel allows that. To be called while the process has one thread. Returns what it
// lacks, and the process is as before; empty when it was done.
[[nodiscard]] std::string enter_own_network();

// Hosts 0, 1, ... on one link, each of which reaches all the others. Host 0 is this process's network, which
// must be its own (enter_own_network()); the others are nameless network namespaces, which end with this
// object and the processes in them. All throw a std::runtime_error with what `ip` (iproute2) says where it
// fails. One thread at a time, and one object per process.
class Hosts {
  public:
    explicit Hosts(int count);
    ~Hosts();
    Hosts(const Hosts&) = delete;
    Hosts& operator=(const Hosts&) = delete;

    [[nodiscard]] static std::string address(int host);
    [[nodiscard]] static std::string interface(int host);

    // Sockets that `task` opens and processes that it starts are of this host.
    void run_on(int host, const std::function<void()>& task) const;

    // Until join(), what `from` sends to `to` is lost, and neither is told: `from` looks in vain for its link
    // address, unless `to` looks for that of `from`. The other way is not affected.
    void cut(int from, int to);
    void join(int from, int to);

  private:
    [[nodiscard]] std::string network_of(int host) const;  // file of the namespace
    void connect(int host) const;
    void forget_link_address(int from, int to) const;

    std::vector<int> networks_;  // descriptors of the namespaces, by host
};

}  // namespace camdir::soak
