#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <thread>

#include "support/eventually.hpp"
#include "test_server.hpp"

namespace camdir::http {
namespace {

using test::http_request;
using test::HttpAnswer;
using test::HttpClient;
using testing::HasSubstr;

TEST(Server, ReportsHealth) {
    TestServer server;
    HttpClient client(server.port());
    EXPECT_EQ(client.ask("GET", "/-/healthy").status, 200);
    server.healthy = false;
    EXPECT_EQ(client.ask("GET", "/-/healthy").status, 503);
}

TEST(Server, ReportsWhatReadinessWaitsFor) {
    TestServer server;
    HttpClient client(server.port());
    EXPECT_EQ(client.ask("GET", "/-/ready").status, 200);
    server.ready = false;
    const HttpAnswer answer = client.ask("GET", "/-/ready");
    EXPECT_EQ(answer.status, 503);
    EXPECT_EQ(answer.body, "map a: loading\nmap b: baking: sample 3 %\n");
}

TEST(Server, WritesMetricsAsPrometheusReadsThem) {
    const TestServer server;
    const HttpAnswer answer = server.ask("GET", "/metrics");
    ASSERT_EQ(answer.status, 200);
    EXPECT_THAT(answer.header.at("content-type"), HasSubstr("text/plain; version=0.0.4"));
    EXPECT_THAT(answer.body, HasSubstr("# TYPE camera_director_things_total counter\n"));
    EXPECT_THAT(answer.body, HasSubstr("camera_director_things_total{kind=\"a \\\"quoted\\\" one\"} 3\n"));
}

TEST(Server, ServesNothingElse) {
    const TestServer server;
    const HttpAnswer status = server.ask("GET", "/status?of=all");
    EXPECT_EQ(status.status, 200);
    EXPECT_EQ(status.header.at("content-type"), "application/json");
    EXPECT_EQ(status.header.at("cache-control"), "no-store");
    EXPECT_EQ(server.ask("GET", "http://localhost/status?of=all").body, status.body) << "as of a proxy";
    EXPECT_EQ(server.ask("GET", "HTTP://localhost/status").body, status.body);
    for (const char* root : {"http://localhost", "http://localhost?/status"})
        EXPECT_EQ(server.ask("GET", root).body, server.ask("GET", "/").body) << root;
    for (const char* path :
         {"/nothing", "/index", "/-/healthy/", "/../../etc/passwd", "/%2e%2e/etc/passwd", "*"})
        EXPECT_EQ(server.status_of("GET", path), 404) << path;
    for (const char* method : {"POST", "PUT", "DELETE", "OPTIONS", "BREW"}) {
        const HttpAnswer answer = server.ask(method, "/-/healthy");
        EXPECT_EQ(answer.status, 405) << method;
        EXPECT_EQ(answer.header.at("allow"), "GET, HEAD");
    }
}

TEST(Server, PassesOnThePathBelowBroadcast) {
    const TestServer server;
    const HttpAnswer list = server.ask("GET", "/broadcast");
    EXPECT_EQ(list.body, "");
    EXPECT_EQ(list.header.at("cache-control"), "public, max-age=1");
    EXPECT_FALSE(list.header.contains("etag"));
    EXPECT_EQ(server.ask("GET", "/broadcast/a%2Fb/c?x=/y").body, "/a%2Fb/c");
    EXPECT_EQ(server.ask("GET", "/broadcast/../../x").body, "/../../x") << "of the source, no file's";
    EXPECT_EQ(server.status_of("GET", "/broadcast/gone"), 404);
    EXPECT_EQ(server.ask("GET", "/broadcast/gone").header.at("cache-control"), "public, max-age=1");
    EXPECT_EQ(server.status_of("GET", "/broadcasts"), 404);
    EXPECT_EQ(server.status_of("GET", "/metrics/x"), 404);
    EXPECT_EQ(server.status_of("POST", "/broadcast/x"), 405);
}

TEST(Server, LetsCachesKeepWhatNeverChanges) {
    const TestServer server;
    HttpClient client(server.port());
    const HttpAnswer answer = client.ask("GET", "/broadcast/x");
    EXPECT_EQ(answer.header.at("content-type"), "text/x-path");
    EXPECT_EQ(answer.header.at("cache-control"), "public, max-age=31536000, immutable");
    EXPECT_EQ(answer.header.at("etag"), "\"r/x\"");
    for (const char* tags : {"\"r/x\"", "\"other\", W/\"r/x\"", "*"}) {
        const HttpAnswer known =
            client.ask("GET", "/broadcast/x", "If-None-Match: " + std::string(tags) + "\r\n");
        EXPECT_EQ(known.status, 304) << tags;
        EXPECT_FALSE(known.header.contains("content-length")) << "which would be that of the whole answer";
        EXPECT_EQ(known.header.at("etag"), "\"r/x\"");
    }
    EXPECT_EQ(client.ask("GET", "/broadcast/x", "If-None-Match: \"r/xx\"\r\n").body, "/x");
}

TEST(Server, AnswersHeadWithTheHeaderAlone) {
    const TestServer server;
    HttpClient client(server.port());
    for (const char* path : {"/-/healthy", "/metrics", "/broadcast/x", "/nothing"}) {
        const HttpAnswer head = client.ask("HEAD", path);
        const HttpAnswer whole = client.ask("GET", path);
        EXPECT_EQ(head.status, whole.status) << path;
        EXPECT_EQ(head.header, whole.header) << path;
    }
}

TEST(Server, AnswersEveryRequestOfAConnectionInOrder) {
    const TestServer server;
    HttpClient client(server.port());
    ASSERT_TRUE(client.send(http_request("GET", "/metrics") + http_request("GET", "/-/healthy") +
                            http_request("POST", "/-/ready", "", "ignored") +
                            http_request("GET", "/nothing") +
                            http_request("GET", "/status", "Connection: close\r\n")));
    for (const int status : {200, 200, 405, 404, 200})
        EXPECT_EQ(client.receive().status, status);
    EXPECT_THROW((void)client.receive(), std::runtime_error) << "closed, as asked for";
}

TEST(Server, AnswersHttp10) {
    const TestServer server;
    HttpClient client(server.port());
    ASSERT_TRUE(client.send("GET /-/healthy HTTP/1.0\r\n\r\n"));
    EXPECT_EQ(client.receive().body, "ok\n");
    EXPECT_THROW((void)client.receive(), std::runtime_error);
}

TEST(Server, RefusesWhatIsNoRequest) {
    const TestServer server;
    for (const char* bytes :
         {"\x16\x03\x01 hello\r\n\r\n", "GET\r\n\r\n", "GET / HTTP/3.0\r\n\r\n", "GET / HTTP/1.1\r\n\r\n",
          "GET / HTTP/1.1\r\nHost: a\r\nHost: b\r\n\r\n", "GET / HTTP/1.0\r\nHost: a\r\nHost: b\r\n\r\n",
          "GET / HTTP/1.1\r\nHost\r\n\r\n", "GET / HTTP/1.1\r\nHost: localhost\r\nContent-Length: x\r\n\r\n",
          "GET / HTTP/1.1\r\nHost: localhost\r\nTransfer-Encoding: chunked\r\n\r\nx\r\n"}) {
        HttpClient client(server.port());
        ASSERT_TRUE(client.send(bytes));
        EXPECT_EQ(client.receive().status, 400) << bytes;
    }
    EXPECT_EQ(server.status_of("GET", "/-/healthy"), 200);
}

TEST(Server, PromptPagesDoNotWaitForOthers) {
    TestServer server;
    server.hold_status();
    std::vector<std::unique_ptr<HttpClient>> waiting;
    for (int i = 0; i < 10; ++i)
        ASSERT_TRUE(waiting.emplace_back(std::make_unique<HttpClient>(server.port()))
                        ->send(http_request("GET", "/status")));
    EXPECT_EQ(server.status_of("GET", "/-/healthy"), 200);
    EXPECT_EQ(server.status_of("GET", "/-/ready"), 200);
    server.let_status_go();
    for (const auto& client : waiting)
        EXPECT_EQ(client->receive().status, 200);
}

TEST(Server, IsNotResponsiveWhileItsThreadHangs) {
    TestServer server;
    EXPECT_TRUE(server.responsive(test::patience));
    server.hold_health();
    const test::HttpClient client(server.port());
    ASSERT_TRUE(client.send(test::http_request("GET", "/-/healthy")));
    EXPECT_TRUE(test::eventually([&] { return !server.responsive(std::chrono::milliseconds(300)); }));
    server.let_health_go();
    EXPECT_TRUE(test::eventually([&] { return server.responsive(std::chrono::milliseconds(300)); }));
}

TEST(Server, ServesManyClientsAtOnce) {
    const TestServer server;
    std::vector<std::thread> threads;
    std::atomic<int> good{0};
    for (int i = 0; i < 40; ++i)
        threads.emplace_back([&] {
            if (server.status_of("GET", "/metrics") == 200) ++good;
        });
    for (std::thread& thread : threads)
        thread.join();
    EXPECT_EQ(good, 40);
}

TEST(Server, FailsOnAPortInUse) {
    const TestServer server;
    config::Http taken;
    taken.port = server.port();
    const auto second = Server::start(taken, {});
    ASSERT_FALSE(second);
    EXPECT_EQ(second.error().message, "http: cannot listen on 127.0.0.1 port " +
                                          std::to_string(server.port()) + ": Address already in use");
}

TEST(Server, FailsOnAnInvalidAddress) {
    config::Http config;
    config.address = "no such address";
    const auto server = Server::start(config, {});
    ASSERT_FALSE(server);
    EXPECT_THAT(server.error().message, HasSubstr("http: /http/address: \"no such address\": "));
    EXPECT_FALSE(Server::check(config));
}

}  // namespace
}  // namespace camdir::http
