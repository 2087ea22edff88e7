// What a client may use up: time, memory, connections, file descriptors.
#include <gtest/gtest.h>

#include <sys/resource.h>
#include <unistd.h>

#include <ctime>
#include <thread>

#include "support/eventually.hpp"
#include "test_server.hpp"

namespace camdir::http {
namespace {

using test::eventually;
using test::http_request;
using test::HttpClient;
using Clients = std::vector<std::unique_ptr<HttpClient>>;

// How often the server says that a bound was reached; -1 where whoever asks reaches it too.
int times_reached(const TestServer& server, const std::string& bound) {
    const std::string series = "camera_director_http_bounds_total{bound=\"" + bound + "\"} ";
    std::string text;
    try {
        text = server.ask("GET", "/metrics").body;
    } catch (const std::runtime_error&) {
        return -1;
    }
    const auto found = text.find(series);
    return found == std::string::npos ? -1 : std::stoi(text.substr(found + series.size()));
}

TEST(Bounds, AnswersWhatIsTooLargeAndCloses) {
    const TestServer server;
    const std::string large(100'000, 'x');
    for (const char* path : {"/-/healthy", "/metrics"}) {
        EXPECT_EQ(server.ask("GET", path, "Large: " + large + "\r\n").status, 431);
        EXPECT_EQ(server.ask("GET", "/" + large).status, 431);
        EXPECT_EQ(server.ask("POST", path, "", large).status, 413);
        HttpClient chunks(server.port());
        (void)chunks.send(http_request("POST", path, "Transfer-Encoding: chunked\r\n") + "186a0\r\n" + large);
        EXPECT_EQ(chunks.receive().status, 413);
        EXPECT_THROW((void)chunks.receive(), std::runtime_error);
    }
    EXPECT_EQ(server.ask("POST", "/-/healthy", "", std::string(4096, 'x')).status, 405);
    EXPECT_EQ(times_reached(server, "header_size"), 4);
    EXPECT_EQ(times_reached(server, "body_size"), 4);
}

TEST(Bounds, CutsOffAnEndlessRequest) {
    const TestServer server;
    const HttpClient endless(server.port());
    const std::string more(1 << 20U, 'x');
    int megabytes = 0;
    while (megabytes < 64 && endless.send(more))
        ++megabytes;
    EXPECT_LT(megabytes, 64);
}

// One that was answered before its connection was idle for too long; null when none is.
std::unique_ptr<HttpClient> client_in_time(const TestServer& server) {
    std::unique_ptr<HttpClient> client;
    const bool answered = eventually([&] {
        client = std::make_unique<HttpClient>(server.port());
        try {
            return client->ask("GET", "/-/healthy").status == 200;
        } catch (const std::runtime_error&) {
            return false;
        }
    });
    return answered ? std::move(client) : nullptr;
}

TEST(Bounds, ClosesIdleConnections) {
    Limits limits;
    limits.idle = std::chrono::milliseconds(50);
    const TestServer server({}, limits);
    const HttpClient silent(server.port());
    EXPECT_TRUE(eventually([&] { return silent.closed(); }));
    const auto finished = client_in_time(server);
    ASSERT_TRUE(finished);
    EXPECT_TRUE(eventually([&] { return finished->closed(); }));
    EXPECT_TRUE(eventually([&] { return times_reached(server, "idle_time") >= 2; }));
}

TEST(Bounds, ClosesConnectionsWhoseRequestTakesLong) {
    Limits limits;
    limits.request = std::chrono::milliseconds(100);
    const TestServer server({}, limits);
    const HttpClient slow(server.port());
    ASSERT_TRUE(slow.send("GET /-/healthy HTTP/1.1\r\nSlow: "));
    EXPECT_TRUE(eventually([&] { return !slow.send("x") || slow.closed(); }));
    EXPECT_TRUE(eventually([&] { return times_reached(server, "request_time") >= 1; }));
}

TEST(Bounds, PagesThatAreNotReadDoNotStay) {
    Limits limits;
    limits.slow_pages = 1;
    limits.answer = std::chrono::milliseconds(100);
    TestServer server({}, limits);
    server.hold_status();
    server.status_size = 64 << 20U;  // more than the system keeps for a client
    const HttpClient unread(server.port());
    ASSERT_TRUE(unread.send(http_request("GET", "/status")));
    ASSERT_TRUE(eventually([&] { return server.status_begun == 1; }));
    HttpClient refused(server.port());
    for (const char* method : {"GET", "HEAD", "GET"})
        EXPECT_EQ(refused.ask(method, "/metrics").status, 503);
    EXPECT_EQ(server.status_of("GET", "/-/healthy"), 200);
    server.let_status_go();
    EXPECT_TRUE(eventually([&] { return times_reached(server, "answer_time") == 1; }));
    EXPECT_GE(times_reached(server, "slow_pages"), 3);
}

TEST(Bounds, OneConnectionMoreClosesTheOldest) {
    Limits limits;
    limits.connections = 4;
    const TestServer server({}, limits);
    Clients clients;
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(
            clients.emplace_back(std::make_unique<HttpClient>(server.port()))->ask("GET", "/nothing").status,
            404);
    EXPECT_EQ(clients[0]->ask("GET", "/-/healthy").status, 200);
    EXPECT_EQ(server.status_of("GET", "/-/healthy"), 200);
    EXPECT_TRUE(eventually([&] { return clients[1]->closed(); }));
    for (const int i : {0, 2, 3})
        EXPECT_EQ(clients[i]->ask("GET", "/-/healthy").status, 200) << i;
    EXPECT_GE(times_reached(server, "connections"), 1);
}

// While it lives, the process may open this many files more.
class FilesLeft {
  public:
    explicit FilesLeft(int count) {
        ::getrlimit(RLIMIT_NOFILE, &before_);
        const int next = ::dup(STDERR_FILENO);
        ::close(next);
        rlimit few = before_;
        few.rlim_cur = static_cast<rlim_t>(next + count);
        ::setrlimit(RLIMIT_NOFILE, &few);
    }
    FilesLeft(const FilesLeft&) = delete;
    FilesLeft& operator=(const FilesLeft&) = delete;
    ~FilesLeft() { ::setrlimit(RLIMIT_NOFILE, &before_); }

  private:
    rlimit before_{};
};

TEST(Bounds, OldConnectionsMakeRoomWhenFilesRunOut) {
    const TestServer server;
    Clients clients(20);
    for (auto& client : clients)
        client = std::make_unique<HttpClient>();
    const FilesLeft few(4);
    for (const auto& client : clients) {
        client->connect(server.port());
        ASSERT_TRUE(client->send(http_request("GET", "/-/healthy")));
    }
    for (const auto& client : clients)
        EXPECT_EQ(client->receive().status, 200);
    clients.pop_back();  // whose file the next one needs
    EXPECT_GE(times_reached(server, "files"), 1);
}

TEST(Bounds, WaitsForFilesWithoutSpinning) {
    const TestServer server;
    HttpClient client;
    {
        const FilesLeft none(0);
        client.connect(server.port());
        ASSERT_TRUE(client.send(http_request("GET", "/-/healthy")));
        const std::clock_t before = std::clock();
        std::this_thread::sleep_for(std::chrono::milliseconds(500));
        EXPECT_LT(std::clock() - before, CLOCKS_PER_SEC / 4) << "of the processor's time";
    }
    EXPECT_EQ(client.receive().status, 200);
}

}  // namespace
}  // namespace camdir::http
