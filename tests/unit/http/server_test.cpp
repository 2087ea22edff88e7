#include "http/server.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <thread>

#include "http/metrics.hpp"

// After Eigen, whose names collide with a macro of its <resolv.h>.
#include <httplib.h>

namespace camdir::http {
namespace {

using testing::HasSubstr;

class ServerTest : public testing::Test {
  protected:
    ServerTest() {
        config_.port = 0;
        Sources sources;
        sources.healthy = [this] { return healthy_.load(); };
        sources.missing = [this] {
            return ready_ ? std::vector<std::string>{}
                          : std::vector<std::string>{"map a: loading", "map b: baking: sample 3 %"};
        };
        sources.metrics = [] {
            auto family = counter_family("things_total", "Things.");
            add_metric(family, 3.0, {{"kind", "a \"quoted\" one"}});
            return std::vector{family};
        };
        sources.status = [] { return std::string("{}"); };
        auto server = Server::start(config_, sources);
        if (!server) throw std::runtime_error(server.error().message);
        server_ = std::move(*server);
    }

    [[nodiscard]] httplib::Client client() const {
        httplib::Client http("127.0.0.1", server_->port());
        http.set_connection_timeout(60);
        http.set_read_timeout(60);
        return http;
    }

    config::Http config_;
    std::atomic<bool> healthy_{true};
    std::atomic<bool> ready_{true};
    std::unique_ptr<Server> server_;
};

TEST_F(ServerTest, ReportsHealth) {
    auto http = client();
    EXPECT_EQ(http.Get("/healthz")->status, 200);
    healthy_ = false;
    EXPECT_EQ(http.Get("/healthz")->status, 503);
}

TEST_F(ServerTest, ReportsWhatReadinessWaitsFor) {
    auto http = client();
    EXPECT_EQ(http.Get("/readyz")->status, 200);
    ready_ = false;
    const auto answer = http.Get("/readyz");
    EXPECT_EQ(answer->status, 503);
    EXPECT_EQ(answer->body, "map a: loading\nmap b: baking: sample 3 %\n");
}

TEST_F(ServerTest, WritesMetricsAsPrometheusReadsThem) {
    const auto answer = client().Get("/metrics");
    ASSERT_EQ(answer->status, 200);
    EXPECT_THAT(answer->get_header_value("Content-Type"), HasSubstr("text/plain; version=0.0.4"));
    EXPECT_THAT(answer->body, HasSubstr("# TYPE camera_director_things_total counter\n"));
    EXPECT_THAT(answer->body, HasSubstr("camera_director_things_total{kind=\"a \\\"quoted\\\" one\"} 3\n"));
}

TEST_F(ServerTest, ServesNothingElse) {
    auto http = client();
    EXPECT_EQ(http.Get("/status")->get_header_value("Content-Type"), "application/json");
    EXPECT_EQ(http.Get("/")->status, 404);
    EXPECT_EQ(http.Get("/../../etc/passwd")->status, 404);
    EXPECT_EQ(http.Delete("/healthz")->status, 404);
    const auto posted = http.Post("/healthz", std::string(100'000, 'x'), "text/plain");
    EXPECT_TRUE(!posted || posted->status >= 400) << "answered with an error or cut off";
    EXPECT_EQ(client().Get("/healthz")->status, 200);
}

// A connection that sends bytes which httplib's client would not send.
class RawClient {
  public:
    explicit RawClient(std::uint16_t port) : socket_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
        sockaddr_in to{};
        to.sin_family = AF_INET;
        to.sin_port = htons(port);
        to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        if (::connect(socket_, reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0)
            throw std::runtime_error("cannot connect");
    }
    ~RawClient() { ::close(socket_); }
    RawClient(const RawClient&) = delete;
    RawClient& operator=(const RawClient&) = delete;

    // False when the server has closed the connection.
    [[nodiscard]] bool send(const std::string& bytes) const {
        return ::send(socket_, bytes.data(), bytes.size(), MSG_NOSIGNAL) >= 0;
    }

  private:
    int socket_;
};

TEST_F(ServerTest, CutsOffAnEndlessRequest) {
    const RawClient endless(server_->port());
    const std::string more(1 << 20U, 'x');
    int megabytes = 0;
    while (megabytes < 64 && endless.send(more))
        ++megabytes;
    EXPECT_LT(megabytes, 64);
}

TEST_F(ServerTest, SlowClientsDoNotBlockOthers) {
    std::vector<std::unique_ptr<RawClient>> slow;
    for (int i = 0; i < 5; ++i)
        slow.push_back(std::make_unique<RawClient>(server_->port()));
    std::atomic<bool> answered{false};
    std::thread sender([&] {
        while (!answered) {
            for (const auto& each : slow)
                (void)each->send("x");
            std::this_thread::sleep_for(std::chrono::milliseconds(100));
        }
    });
    const auto answer = client().Get("/healthz");
    answered = true;
    sender.join();
    EXPECT_TRUE(answer);
}

TEST_F(ServerTest, ServesManyClientsAtOnce) {
    std::vector<std::thread> threads;
    std::atomic<int> good{0};
    for (int i = 0; i < 40; ++i)
        threads.emplace_back([&] {
            const auto answer = client().Get("/metrics");
            if (answer && answer->status == 200) ++good;
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(good, 40);
}

TEST_F(ServerTest, FailsOnAPortInUse) {
    config::Http taken;
    taken.port = server_->port();
    const auto second = Server::start(taken, {});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message,
              "http: cannot listen on 127.0.0.1 port " + std::to_string(server_->port()));
}

TEST(Server, FailsOnAnInvalidAddress) {
    config::Http config;
    config.address = "no such address";
    EXPECT_FALSE(Server::start(config, {}));
}

}  // namespace
}  // namespace camdir::http
