// Viewers of a match, with Beast's own WebSocket client.
#include <gtest/gtest.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core/buffers_to_string.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/websocket/stream.hpp>
#include <nlohmann/json.hpp>

#include "base/file.hpp"
#include "support/eventually.hpp"
#include "support/temporary_folder.hpp"
#include "test_server.hpp"

namespace camdir::http {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace websocket = beast::websocket;
using asio::ip::tcp;
using test::eventually;

// Blocks in each call.
class WatchingClient {
  public:
    WatchingClient(int port, const std::string& path, const std::map<std::string, std::string>& header = {}) {
        stream_.next_layer().connect({asio::ip::address_v4::loopback(), static_cast<std::uint16_t>(port)});
        stream_.set_option(websocket::stream_base::decorator([header](websocket::request_type& request) {
            for (const auto& [name, value] : header)
                request.set(name, value);
        }));
        beast::error_code error;
        stream_.handshake(response_, "localhost:" + std::to_string(port), path, error);
    }

    // Of the handshake.
    [[nodiscard]] bool watches() const { return stream_.is_open(); }
    [[nodiscard]] std::string header(const std::string& name) const {
        const auto value = response_[name];
        return {value.data(), value.size()};
    }
    // The next message; empty: the connection is closed.
    std::string read() {
        beast::flat_buffer buffer;
        beast::error_code error;
        stream_.read(buffer, error);
        return error ? "" : beast::buffers_to_string(buffer.data());
    }
    [[nodiscard]] bool binary() const { return stream_.got_binary(); }
    [[nodiscard]] int close_code() const { return stream_.reason().code; }
    void write(const std::string& text) { stream_.write(asio::buffer(text)); }
    void write_raw(const std::string& bytes) { asio::write(stream_.next_layer(), asio::buffer(bytes)); }

  private:
    asio::io_context io_;
    websocket::stream<tcp::socket> stream_{io_};
    websocket::response_type response_;
};

// Of the answer to a WebSocket's request with these lines in its header: 101 is a handshake.
int handshake_status(const TestServer& server, const std::string& path, const std::string& header = "") {
    test::HttpClient client(server.port());
    EXPECT_TRUE(client.send(test::http_request("GET", path,
                                               "Connection: Upgrade\r\nUpgrade: websocket\r\n"
                                               "Sec-WebSocket-Version: 13\r\n"
                                               "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n" +
                                                   header)));
    return client.receive(true).status;
}

director::MatchInfo match(const std::string& match_id) {
    director::MatchInfo info;
    info.match_id = match_id;
    info.map_name = "hall";
    return info;
}

director::PoseFrame poses(std::uint32_t number) {
    director::PoseFrame frame;
    frame.frame_number = number;
    frame.poses.emplace_back();
    return frame;
}

TEST(Live, SendsAMatchToItsViewers) {
    TestServer server;
    server.relay.show(match("the cup/1"));
    WatchingClient client(server.port(), "/live/the%20cup%2F1",
                          {{"Sec-WebSocket-Protocol", "camera-director.v1"}});
    ASSERT_TRUE(client.watches());
    EXPECT_EQ(client.header("Sec-WebSocket-Protocol"), "camera-director.v1");
    EXPECT_EQ(nlohmann::json::parse(client.read()).at("match_id"), "the cup/1");
    EXPECT_EQ(nlohmann::json::parse(client.read()).at("kind"), "history");
    EXPECT_FALSE(client.binary());
    server.relay.show("the cup/1", poses(1), {});
    EXPECT_EQ(nlohmann::json::parse(client.read()).at("kind"), "match") << "a player who is not listed";
    EXPECT_EQ(client.read().size(), 28U + 14U);
    EXPECT_TRUE(client.binary());
    server.relay.end("the cup/1");
    EXPECT_EQ(nlohmann::json::parse(client.read()).at("kind"), "end");
    EXPECT_EQ(client.read(), "");
    EXPECT_EQ(client.close_code(), 1000);
}

TEST(Live, AnswersWhatIsNoStream) {
    TestServer server;
    server.relay.show(match("cup"));
    EXPECT_EQ(server.status_of("GET", "/live"), 200);
    EXPECT_EQ(server.status_of("GET", "/live/cup"), 426);
    EXPECT_EQ(server.status_of("POST", "/live/cup"), 405);
    for (const char* path : {"/live/other", "/live/", "/live/%", "/live/%zz", "/live/cup/"})
        EXPECT_EQ(handshake_status(server, path), 404) << path;
}

TEST(Live, IsNotForThePagesOfOtherSites) {
    TestServer server;
    server.relay.show(match("cup"));
    for (const std::string origin : {"http://localhost", "https://LOCALHOST"})
        EXPECT_EQ(handshake_status(server, "/live/cup", "Origin: " + origin + "\r\n"), 101) << origin;
    for (const std::string origin : {"http://evil.example", "null", "", "http://localhost:81", "localhost"})
        EXPECT_EQ(handshake_status(server, "/live/cup", "Origin: " + origin + "\r\n"), 403) << origin;
}

TEST(Live, ClosesAViewerWhoSaysSomething) {
    TestServer server;
    server.relay.show(match("cup"));
    for (const std::size_t size : {std::size_t{1}, std::size_t{1} << 20U}) {
        WatchingClient client(server.port(), "/live/cup");
        ASSERT_TRUE(client.watches());
        try {
            client.write(std::string(size, 'x'));
        } catch (const boost::system::system_error&) {
            // It was closed on the way.
        }
        while (!client.read().empty()) {
        }
        EXPECT_TRUE(eventually([&] { return server.relay.statistics().viewers == 0; }));
    }
    EXPECT_NE(server.ask("GET", "/metrics")
                  .body.find("camera_director_http_bounds_total{bound=\"viewer_messages\"} 2\n"),
              std::string::npos);
}

TEST(Live, ClosesAViewerWhoDoesNotSpeakTheProtocol) {
    TestServer server;
    server.relay.show(match("cup"));
    WatchingClient client(server.port(), "/live/cup");
    client.write_raw(std::string(64, '\xff'));
    EXPECT_TRUE(eventually([&] { return server.relay.statistics().viewers == 0; }));
    EXPECT_EQ(server.status_of("GET", "/-/healthy"), 200);
}

TEST(Live, HasSoManyViewersAndNoMore) {
    TestServer server;
    server.relay.show(match("cup"));
    auto first = std::make_unique<WatchingClient>(server.port(), "/live/cup");
    const WatchingClient second(server.port(), "/live/cup");
    EXPECT_EQ(handshake_status(server, "/live/cup"), 503);
    first.reset();
    EXPECT_TRUE(eventually([&] { return handshake_status(server, "/live/cup") == 101; }));
}

TEST(Live, ClosesAViewerWhoTakesNothing) {
    TestServer server({}, {.answer = std::chrono::milliseconds(500)});
    server.relay.show(match("cup"));
    const WatchingClient client(server.port(), "/live/cup");
    ASSERT_TRUE(client.watches());
    // More than any buffer on the way takes; it answers no ping either.
    std::uint32_t number = 0;
    EXPECT_TRUE(eventually([&] {
        for (int i = 0; i < 1000; ++i)
            server.relay.show("cup", poses(++number), {});
        return server.relay.statistics().viewers == 0;
    }));
    EXPECT_GT(server.relay.statistics().dropped_frames, 0U);
}

TEST(Live, TakesTheTokenAsASubprotocol) {
    const test::TemporaryFolder folder;
    config::Http config;
    config.address = "0.0.0.0";
    config.token_file = (folder / "token").string();
    ASSERT_TRUE(write_file(config.token_file, std::string("se/cr+et==\n")));
    std::filesystem::permissions(config.token_file, std::filesystem::perms::owner_read);
    TestServer server(config);
    server.relay.show(match("cup"));
    const auto status = [&](const std::string& protocols) {
        return handshake_status(server, "/live/cup", "Sec-WebSocket-Protocol: " + protocols + "\r\n");
    };
    EXPECT_EQ(status("camera-director.v1"), 401);
    EXPECT_EQ(status("camera-director.v1, bearer.wrong"), 401);
    EXPECT_EQ(status("camera-director.v1, bearer.se%2Fcr%2Bet%3D%3D"), 101);
    EXPECT_EQ(server.status_of("GET", "/"), 200) << "the page itself has no secrets";
    EXPECT_EQ(server.status_of("GET", "/live"), 401);
    EXPECT_EQ(server.status_of("GET", "/live", "Sec-WebSocket-Protocol: bearer.se%2Fcr%2Bet%3D%3D\r\n"), 401)
        << "only of WebSockets";
}

TEST(Models, AreServedByTheNameOfTheirMap) {
    const TestServer server;
    EXPECT_EQ(server.ask("GET", "/map/a%20map%2F2/mesh.glb").body, "mesh");
    const auto obstacles = server.ask("GET", "/map/a%20map%2F2/obstacles.glb");
    EXPECT_EQ(obstacles.body, "obstacles");
    EXPECT_EQ(obstacles.header.at("content-type"), "model/gltf-binary");
    EXPECT_EQ(obstacles.header.at("content-encoding"), "gzip");
    EXPECT_EQ(obstacles.header.at("etag"), "\"1\"");
    const auto contents = server.ask("GET", "/map/a%20map%2F2/contents.json");
    EXPECT_EQ(contents.body, "contents");
    EXPECT_EQ(contents.header.at("content-type"), "application/json");
    EXPECT_EQ(server.status_of("GET", "/map/no%20source/obstacles.glb"), 404);
    EXPECT_EQ(server.status_of("GET", "/map/busy/obstacles.glb"), 503);
    for (const char* path : {"/map", "/map/", "/map/a", "/map/%/mesh.glb", "/mapping", "/map/other/mesh.glb",
                             "/map/a%20map%2F2/mesh", "/map//mesh.glb"})
        EXPECT_EQ(server.status_of("GET", path), 404) << path;
}

}  // namespace
}  // namespace camdir::http
