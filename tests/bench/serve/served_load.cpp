#include "served_load.hpp"

#include <algorithm>
#include <chrono>
#include <ctime>
#include <deque>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <vector>

#include "support/child_process.hpp"
#include "support/eventually.hpp"
#include "support/http_client.hpp"
#include "support/temporary_folder.hpp"
#include "support/test_domain.hpp"

namespace camdir::bench {
namespace {

using test::ChildProcess;

constexpr const char* map_name = "map";
constexpr const char* prefix = "bench";
constexpr std::chrono::milliseconds sampling{100};

// What a server has used since it began, s.
struct Usage {
    double at;  // of a steady clock
    double processor;
    double waits;  // of its threads, for something to do: voluntary context switches
};

double seconds_of(clockid_t clock) {
    timespec time{};
    if (::clock_gettime(clock, &time) != 0) throw std::runtime_error("the server has ended");
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

// The number after `before`.
double number_after(const std::string& text, const std::string& before) {
    const std::size_t found = text.find(before);
    if (found == std::string::npos) throw std::runtime_error("no \"" + before + "\" in: " + text);
    return std::stod(text.substr(found + before.size()));
}

// Of the threads that run now.
double waits_of(pid_t process) {
    double waits = 0.0;
    for (const auto& thread :
         std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task")) {
        std::ifstream file(thread.path() / "status");
        const std::string status{std::istreambuf_iterator<char>(file), {}};
        if (!status.empty()) waits += number_after(status, "\nvoluntary_ctxt_switches:");
    }
    return waits;
}

class ServerProcess {
  public:
    ServerProcess(const Bench& bench, Server server, std::uint32_t domain,
                  const std::filesystem::path& folder)
        : process_(command(bench, server, domain, folder)) {
        if (const int failed = ::clock_getcpuclockid(process_.pid(), &clock_); failed != 0)
            throw std::system_error(failed, std::generic_category(), "the server's processor time");
        if (server == Server::raw) return;
        const std::string listening = "http: listening on 127.0.0.1 port ";
        if (!test::eventually([&] { return process_.errors().find(listening) != std::string::npos; }))
            throw std::runtime_error("camera-director does not listen: " + process_.errors());
        const int port = static_cast<int>(number_after(process_.errors(), listening));
        if (!test::eventually([&] { return test::HttpClient(port).ask("GET", "/-/ready").status == 200; }))
            throw std::runtime_error("camera-director is not ready: " + process_.errors());
    }

    [[nodiscard]] Usage usage() const {
        return {seconds_of(CLOCK_MONOTONIC), seconds_of(clock_), waits_of(process_.pid())};
    }

  private:
    static std::vector<std::string> command(const Bench& bench, Server server, std::uint32_t domain,
                                            const std::filesystem::path& folder) {
        if (server == Server::raw)
            return {bench.programs + "/raw-director", "--domain", std::to_string(domain)};
        const std::filesystem::path file = folder / "bench.json";
        // The configuration's paths are relative to its own folder.
        const std::string map_file = std::filesystem::absolute(bench.map_file);
        const std::string source = std::filesystem::absolute(bench.source);
        const nlohmann::json config = {
            {"dds", {{"domain", domain}}},
            {"http", {{"port", 0}}},
            {"limits", {{"participant_matches", 4096}, {"participant_observers", 256}}},
            {"maps", {{{"name", map_name}, {"file", map_file}, {"source", source}}}}};
        std::ofstream(file) << config;
        return {bench.programs + "/camera-director", "serve", "--config", file};
    }

    ChildProcess process_;
    clockid_t clock_{};
};

// Within the measured time: before it the observers come, after it they leave.
void set_cost(Served& served, const std::deque<Usage>& usages, double start, double end) {
    const auto first = std::ranges::find_if(usages, [&](const Usage& usage) { return usage.at >= start; });
    const auto after = std::ranges::find_if(usages, [&](const Usage& usage) { return usage.at > end; });
    if (after - first < 2) throw std::runtime_error("the server's processor time was read too rarely");
    const Usage& last = *std::prev(after);
    served.cores = (last.processor - first->processor) / (last.at - first->at);
    served.waits_per_s = (last.waits - first->waits) / (last.at - first->at);
}

}  // namespace

Served serve(const Bench& bench, Server server, const Load& load) {
    const test::TestDomain domain;
    const test::TemporaryFolder folder;
    const ServerProcess served_by(bench, server, domain.id(), folder.path());
    const std::vector<std::string> network = {"--domain",       std::to_string(domain.id()),
                                              "--match-prefix", prefix,
                                              "--matches",      std::to_string(load.matches)};
    const auto with_network = [&](std::vector<std::string> command) {
        command.insert(command.end(), network.begin(), network.end());
        return command;
    };
    const ChildProcess players(
        with_network({bench.programs + "/synthetic-players", bench.map_file, "--map-name", map_name,
                      "--players", std::to_string(load.shots), "--rate", std::to_string(load.rate_hz)}));
    const std::string findings = folder / "probe.json";
    ChildProcess observers(
        with_network({bench.programs + "/observer-probe", "--observers", std::to_string(load.shots),
                      "--seconds", std::to_string(bench.seconds), "--max-gaps", "1000000000",
                      "--max-violations", "1000000000", "--json", findings}));
    std::deque<Usage> usages;
    std::optional<int> ended;
    while (!ended) {
        usages.push_back(served_by.usage());
        ended = observers.wait_for(sampling);
    }
    if (*ended != 0) throw std::runtime_error("observer-probe: " + observers.output() + observers.errors());

    const auto probe = nlohmann::json::parse(std::ifstream(findings));
    Served served{.frames_per_s = probe.at("frames_per_second"),
                  .p50_ms = probe.at("latency_ms").at("p50"),
                  .p99_ms = probe.at("latency_ms").at("p99")};
    const double start = probe.at("start_s");
    set_cost(served, usages, start, start + probe.at("seconds").get<double>());
    return served;
}

}  // namespace camdir::bench
