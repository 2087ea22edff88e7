#include "hosts.hpp"

#include <fcntl.h>
#include <sched.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <future>
#include <sstream>
#include <stdexcept>

#include "support/child_process.hpp"

namespace camdir::soak {
namespace {

constexpr const char* bridge = "switch";

std::runtime_error failure(const std::string& what) {
    return std::runtime_error(what + ": " + std::strerror(errno));
}

std::string without_end_of_line(std::string text) {
    while (text.ends_with('\n'))
        text.pop_back();
    return text;
}

// `arguments` are separated by spaces.
void ip(const std::string& arguments) {
    std::vector<std::string> command{"/sbin/ip"};
    std::istringstream words(arguments);
    for (std::string word; words >> word;)
        command.push_back(word);
    test::ChildProcess process(command);
    if (process.wait() != 0)
        throw std::runtime_error("ip " + arguments + ": " + without_end_of_line(process.errors()));
}

void in_new_thread(const std::function<void()>& task) {
    std::async(std::launch::async, task).get();
}

int open_network() {
    const int network = ::open("/proc/thread-self/ns/net", O_RDONLY | O_CLOEXEC);
    if (network < 0) throw failure("cannot open the network namespace");
    return network;
}

// The namespace lives as long as its descriptor.
int new_network() {
    int network = -1;
    in_new_thread([&] {
        if (::unshare(CLONE_NEWNET) != 0) throw failure("cannot create a network namespace");
        network = open_network();
    });
    return network;
}

// Each rule takes a packet before the next: those that lose one come before that of local addresses.
void put_local_rule_last() {
    ip("rule add pref 100 lookup local");
    ip("rule del pref 0");
}

std::string loss_from(int host) {
    return " pref 1 from " + Hosts::address(host) + " blackhole";
}

}  // namespace

std::string enter_own_network() {
    test::ChildProcess trial(
        {"/usr/bin/unshare", "--map-root-user", "--net", "/sbin/ip", "link", "set", "lo", "up"});
    if (trial.wait() != 0)
        return "iproute2 and user and network namespaces: " + without_end_of_line(trial.errors());
    const uid_t user = ::getuid();
    const gid_t group = ::getgid();
    if (::unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) throw failure("cannot create namespaces");
    std::ofstream("/proc/self/setgroups") << "deny";
    std::ofstream("/proc/self/uid_map") << "0 " << user << " 1";
    std::ofstream("/proc/self/gid_map") << "0 " << group << " 1";
    ip("link set dev lo up");
    return "";
}

Hosts::Hosts(int count) : networks_{open_network()} {
    ip(std::string("link add name ") + bridge + " type bridge");
    ip(std::string("addr add ") + address(0) + "/24 dev " + bridge);
    ip(std::string("link set dev ") + bridge + " up");
    put_local_rule_last();
    for (int host = 1; host < count; ++host) {
        networks_.push_back(new_network());
        connect(host);
    }
}

Hosts::~Hosts() {
    for (const int network : networks_)
        ::close(network);
}

void Hosts::connect(int host) const {
    const std::string port = "to-host-" + std::to_string(host);
    ip("link add name " + port + " type veth peer name " + interface(host) + " netns " + network_of(host));
    ip("link set dev " + port + " master " + bridge + " up");
    run_on(host, [&] {
        ip("link set dev lo up");
        ip("addr add " + address(host) + "/24 dev " + interface(host));
        ip("link set dev " + interface(host) + " up");
        put_local_rule_last();
    });
}

std::string Hosts::address(int host) {
    return "10.0.0." + std::to_string(host + 1);
}

std::string Hosts::interface(int host) {
    return host == 0 ? bridge : "uplink";
}

std::string Hosts::network_of(int host) const {
    return "/proc/" + std::to_string(::getpid()) + "/fd/" +
           std::to_string(networks_.at(static_cast<std::size_t>(host)));
}

void Hosts::run_on(int host, const std::function<void()>& task) const {
    in_new_thread([&] {
        if (::setns(networks_.at(static_cast<std::size_t>(host)), CLONE_NEWNET) != 0)
            throw failure("cannot enter the network namespace of host " + std::to_string(host));
        task();
    });
}

void Hosts::cut(int from, int to) {
    run_on(to, [&] { ip("rule add" + loss_from(from)); });
    forget_link_address(from, to);
}

void Hosts::join(int from, int to) {
    run_on(to, [&] { ip("rule del" + loss_from(from)); });
    forget_link_address(from, to);
}

// The kernel believes for half a minute in what it has found, and looks each second for what it has not.
void Hosts::forget_link_address(int from, int to) const {
    run_on(from, [&] { ip("neigh flush to " + address(to) + " dev " + interface(from)); });
}

}  // namespace camdir::soak
