#include "http/server.hpp"

#include <httplib.h>
#include <prometheus/text_serializer.h>

#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <condition_variable>
#include <mutex>
#include <thread>
#include <utility>

#include "http/connection.hpp"

namespace camdir::http {
namespace {

constexpr std::size_t threads = 4;
constexpr std::ptrdiff_t max_connections = 16;      // served or waiting for a thread
constexpr std::chrono::seconds request_timeout{3};  // with its answer
constexpr std::chrono::seconds idle_timeout{5};     // until the next request of a connection
constexpr std::chrono::milliseconds stop_period{100};
constexpr int max_requests_per_connection = 100;

// httplib's own pool has an unbounded queue; this one makes the accepting thread wait.
class BoundedPool final : public httplib::TaskQueue {
  public:
    void enqueue(std::function<void()> serve) override {
        std::unique_lock lock(mutex_);
        slot_free_.wait(lock, [this] { return connections_ < max_connections; });
        ++connections_;
        lock.unlock();
        pool_.enqueue([this, serve = std::move(serve)] {
            serve();
            const std::lock_guard done(mutex_);
            --connections_;
            slot_free_.notify_one();
        });
    }
    void shutdown() override { pool_.shutdown(); }

  private:
    std::mutex mutex_;
    std::condition_variable slot_free_;
    std::ptrdiff_t connections_ = 0;
    httplib::ThreadPool pool_{threads};
};

// Serves each connection through a Connection.
class BoundedServer final : public httplib::Server {
  private:
    bool process_and_close_socket(socket_t socket) override {
        for (int left = max_requests_per_connection; left > 0 && next_request(socket); --left) {
            Connection connection(socket, Connection::Clock::now() + request_timeout);
            bool closed = false;
            if (!process_request(connection, left == 1, closed, nullptr) || closed) break;
        }
        ::shutdown(socket, SHUT_RDWR);
        return ::close(socket) == 0;
    }

    // Waits for the first byte of a request; false when none comes or the server stops.
    [[nodiscard]] bool next_request(socket_t socket) const {
        const auto end = Connection::Clock::now() + idle_timeout;
        while (svr_sock_ != INVALID_SOCKET && Connection::Clock::now() < end) {
            pollfd readable{socket, POLLIN, 0};
            const int count = ::poll(&readable, 1, static_cast<int>(stop_period.count()));
            if (count != 0) return count > 0;
        }
        return false;
    }
};

void answer_text(httplib::Response& response, int status, const std::string& text) {
    response.status = status;
    response.set_content(text, "text/plain; charset=utf-8");
}

void show_health(const Sources& sources, httplib::Response& response) {
    if (sources.healthy())
        answer_text(response, 200, "ok\n");
    else
        answer_text(response, 503, "a worker does not respond\n");
}

void show_readiness(const Sources& sources, httplib::Response& response) {
    const auto missing = sources.missing();
    if (missing.empty()) return answer_text(response, 200, "ready\n");
    std::string text;
    for (const std::string& what : missing)
        text += what + "\n";
    answer_text(response, 503, text);
}

void show_metrics(const Sources& sources, httplib::Response& response) {
    response.set_content(prometheus::TextSerializer().Serialize(sources.metrics()),
                         "text/plain; version=0.0.4; charset=utf-8");
}

}  // namespace

struct Server::Listener {
    explicit Listener(Sources shown) : sources(std::move(shown)) {
        server.new_task_queue = [] { return new BoundedPool; };  // httplib deletes it
        server.set_payload_max_length(0);
        // httplib's default shares a port that is in use instead of failing.
        server.set_socket_options([](socket_t socket) {
            const int on = 1;
            ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
        });
        server.set_default_headers({{"Cache-Control", "no-store"}, {"X-Content-Type-Options", "nosniff"}});
        serve("/healthz", show_health);
        serve("/readyz", show_readiness);
        serve("/metrics", show_metrics);
        serve("/status", [](const Sources& from, httplib::Response& response) {
            response.set_content(from.status(), "application/json");
        });
    }

    template <class Page>
    void serve(const char* path, Page page) {
        server.Get(path, [this, page](const httplib::Request&, httplib::Response& response) {
            page(sources, response);
        });
    }

    const Sources sources;
    BoundedServer server;
    int port = 0;
    std::thread thread;
};

Result<std::unique_ptr<Server>> Server::start(const config::Http& config, Sources sources) {
    auto listener = std::make_unique<Listener>(std::move(sources));
    httplib::Server& server = listener->server;
    listener->port = config.port == 0 ? server.bind_to_any_port(config.address)
                     : server.bind_to_port(config.address, static_cast<int>(config.port))
                         ? static_cast<int>(config.port)
                         : -1;
    if (listener->port < 0)
        return fail("http: cannot listen on " + config.address + " port " + std::to_string(config.port));
    listener->thread = std::thread([&server] { server.listen_after_bind(); });
    while (!server.is_running())
        std::this_thread::yield();
    return std::unique_ptr<Server>(new Server(std::move(listener)));
}

Server::Server(std::unique_ptr<Listener> listener) : listener_(std::move(listener)) {}

Server::~Server() {
    listener_->server.stop();
    listener_->thread.join();
}

std::uint16_t Server::port() const {
    return static_cast<std::uint16_t>(listener_->port);
}

}  // namespace camdir::http
