// A server of these tests with pages that they change.
#pragma once

#include <atomic>
#include <memory>
#include <stdexcept>
#include <vector>

#include "http/metrics.hpp"
#include "http/server.hpp"
#include "support/http_client.hpp"

namespace camdir::http {

class TestServer {
  public:
    explicit TestServer(config::Http config = {}, const Limits& limits = {}) {
        config.port = 0;
        auto started = Server::start(config, sources(), limits);
        if (!started) throw std::runtime_error(started.error().message);
        server_ = std::move(*started);
    }

    TestServer(const TestServer&) = delete;
    TestServer& operator=(const TestServer&) = delete;
    ~TestServer() {
        let_status_go();
        let_health_go();
    }

    [[nodiscard]] int port() const { return server_->port(); }
    [[nodiscard]] bool responsive(std::chrono::nanoseconds limit) const { return server_->responsive(limit); }
    [[nodiscard]] Result<void> reload() { return server_->reload(); }
    // Of a connection of its own.
    [[nodiscard]] test::HttpAnswer ask(const std::string& method, const std::string& path,
                                       const std::string& header = "", const std::string& body = "") const {
        return test::HttpClient(port()).ask(method, path, header, body);
    }
    [[nodiscard]] int status_of(const std::string& method, const std::string& path,
                                const std::string& header = "") const {
        return ask(method, path, header).status;
    }

    std::atomic<bool> healthy{true};
    std::atomic<bool> ready{true};
    std::atomic<std::size_t> kept{0};  // of three matches
    std::atomic<int> status_begun{0};  // how often
    // /status is not finished between these.
    void hold_status() { status_held_ = true; }
    void let_status_go() {
        status_held_ = false;
        status_held_.notify_all();
    }
    // The same of /-/healthy, which holds the thread of the connections.
    void hold_health() { health_held_ = true; }
    void let_health_go() {
        health_held_ = false;
        health_held_.notify_all();
    }
    std::atomic<std::size_t> status_size{2};  // in bytes

    live::Relay relay{2};  // two viewers at most

  private:
    Sources sources() {
        Sources sources;
        sources.healthy = [this] {
            health_held_.wait(true);
            return healthy.load();
        };
        sources.missing = [this] {
            return ready ? std::vector<std::string>{}
                         : std::vector<std::string>{"map a: loading", "map b: baking: sample 3 %"};
        };
        sources.metrics = [] {
            auto family = counter_family("things_total", "Things.");
            add_metric(family, 3.0, {{"kind", "a \"quoted\" one"}});
            return std::vector{family};
        };
        sources.hand_over = [this] { return HandOver{3, kept.load()}; };
        sources.broadcast = [](std::string_view path) -> std::optional<Resource> {
            if (path == "/gone") return std::nullopt;
            const bool changes = path.empty();
            return Resource{"text/x-path", changes ? "" : "r" + std::string(path), std::string(path)};
        };
        sources.status = [this] {
            ++status_begun;
            status_held_.wait(true);
            return "{" + std::string(status_size - 2, ' ') + "}";
        };
        sources.live = [] { return "{}"; };
        sources.model = [](const std::string& map, live::ModelKind kind) -> live::Models::Answer {
            if (map == "no source") return {nullptr, live::Models::Failure::no_source, "no source"};
            if (map == "busy") return {nullptr, live::Models::Failure::busy, ""};
            if (map != "a map/2") return {};
            const char* content = kind == live::ModelKind::mesh        ? "mesh"
                                  : kind == live::ModelKind::obstacles ? "obstacles"
                                                                       : "contents";
            return {std::make_shared<live::Model>(live::Model{content, "1"}), {}, ""};
        };
        sources.join = [this](const std::string& match_id, const std::shared_ptr<live::Viewer>& viewer) {
            return relay.join(match_id, viewer);
        };
        return sources;
    }

    std::atomic<bool> status_held_{false}, health_held_{false};
    std::unique_ptr<Server> server_;
};

}  // namespace camdir::http
