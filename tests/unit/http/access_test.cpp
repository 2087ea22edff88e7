#include "http/access.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

#include "base/file.hpp"
#include "support/eventually.hpp"
#include "support/temporary_folder.hpp"
#include "test_server.hpp"

namespace camdir::http {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class AccessTest : public testing::Test {
  protected:
    AccessTest() { config_.token_file = (folder_ / "token").string(); }

    void write_token(const std::string& content, fs::perms permissions = fs::perms(0640)) const {
        ASSERT_TRUE(write_file(config_.token_file, content));
        fs::permissions(config_.token_file, permissions);
    }
    [[nodiscard]] std::string problem() const {
        const auto access = Access::load(config_, true);
        return access ? "no problem" : access.error().message;
    }

    const test::TemporaryFolder folder_;
    config::Http config_;
};

TEST_F(AccessTest, DemandsATokenFileOffLoopback) {
    config_.token_file.clear();
    config_.address = "0.0.0.0";
    const auto refused = Server::check(config_);
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().message,
              "http: 0.0.0.0 is not a loopback address: expected /http/token_file to name a file with the "
              "token that requests from other hosts must carry");
    EXPECT_FALSE(Server::start(config_, {}));
    for (const char* address : {"127.0.0.1", "127.8.9.10"}) {
        config_.address = address;
        EXPECT_TRUE(Server::check(config_)) << address;
    }
}

TEST_F(AccessTest, RefusesBadTokenFiles) {
    EXPECT_THAT(problem(), HasSubstr("http: /http/token_file: " + config_.token_file + ": cannot read"));
    for (const char* content : {"", "\n", "two words\n", "two\nlines\n", "\x80\n"}) {
        write_token(content);
        EXPECT_THAT(problem(), HasSubstr("expected one line with a token of letters, digits and"));
    }
    write_token(std::string(5000, 'x'));
    EXPECT_THAT(problem(), HasSubstr("5000 bytes: expected a token, at most 4096 bytes"));
    write_token("secret", fs::perms(0644));
    EXPECT_THAT(problem(), HasSubstr("chmod o-rwx"));
    write_token("secret", fs::perms(0640));
    EXPECT_EQ(problem(), "no problem");
    config_.token_file = folder_.path().string();
    EXPECT_THAT(problem(), HasSubstr(config_.token_file + ": cannot read the token: Is a directory"));
}

TEST_F(AccessTest, AllowsTheTokenAlone) {
    write_token("aB9-._~+/=\r\n");
    const auto access = Access::load(config_, true);
    ASSERT_TRUE(access) << access.error().message;
    for (const char* right : {"Bearer aB9-._~+/=", "bearer aB9-._~+/=", "BEARER aB9-._~+/="})
        EXPECT_TRUE(access->allows(false, false, right)) << right;
    for (const char* wrong : {"", "Bearer", "Bearer ", "Bearer aB9-._~+/", "Bearer aB9-._~+/==", "aB9-._~+/=",
                              "Basic aB9-._~+/=", "Bearer AB9-._~+/=", "Bearer aB9-._~+/=aB9-._~+/="})
        EXPECT_FALSE(access->allows(false, false, wrong)) << wrong;
}

TEST_F(AccessTest, OnLoopbackOnlyChangesNeedTheToken) {
    write_token("secret");
    const TestServer server(config_);
    for (const char* path : {"/-/healthy", "/-/ready", "/metrics", "/status"})
        EXPECT_EQ(server.status_of("GET", path), 200) << path;
    const auto refused = server.ask("POST", "/status", "Authorization: Bearer guess\r\n");
    EXPECT_EQ(refused.status, 401);
    EXPECT_EQ(refused.header.at("www-authenticate"), "Bearer");
    EXPECT_EQ(server.status_of("POST", "/status", "Authorization: Bearer secret\r\n"), 405);
}

// A page of any site can let its own name resolve to this host.
TEST_F(AccessTest, OnLoopbackOnlyNamesOfThisHostAreServed) {
    config_.token_file.clear();
    config_.hosts = {"match.example"};
    const TestServer server(config_);
    const auto status_for = [&](const std::string& host) {
        test::HttpClient client(server.port());
        EXPECT_TRUE(client.send("GET /status HTTP/1.1\r\nHost: " + host + "\r\n\r\n"));
        return client.receive();
    };
    for (const char* known : {"localhost", "LocalHost:9464", "a.localhost", "127.0.0.1", "127.9.9.9:80",
                              "[::1]", "[::1]:9464", "match.example", "MATCH.example:8080"})
        EXPECT_EQ(status_for(known).status, 200) << known;
    for (const char* strange : {"evil.example", "localhost.evil.example", "notlocalhost", ".localhost", "",
                                "127.0.0.1.evil.example", "10.0.0.1", "[::2]", "[::1].evil", "[", "0",
                                "0.0.0.0:80", "match.example.evil", "2130706433"}) {
        const auto refused = status_for(strange);
        EXPECT_EQ(refused.status, 421) << strange;
        EXPECT_THAT(refused.body, HasSubstr("/http/hosts of the configuration")) << strange;
    }
    EXPECT_EQ(server.status_of("GET", "/-/healthy"), 200);
}

TEST_F(AccessTest, OnOtherAddressesTheTokenDecides) {
    config_.address = "0.0.0.0";
    write_token("secret");
    const TestServer server(config_);
    test::HttpClient client(server.port());
    ASSERT_TRUE(
        client.send("GET /status HTTP/1.1\r\nHost: camera.example\r\nAuthorization: Bearer secret\r\n\r\n"));
    EXPECT_EQ(client.receive().status, 200);
}

TEST_F(AccessTest, NothingChangesTheServerWithoutAToken) {
    config::Http without_file = config_;
    without_file.token_file.clear();
    const TestServer open(without_file);
    const auto forbidden = open.ask("POST", "/hand-over");
    EXPECT_EQ(forbidden.status, 403);
    EXPECT_THAT(forbidden.body, HasSubstr("/http/token_file"));
    write_token("secret");
    TestServer server(config_);
    const std::string token = "Authorization: Bearer secret\r\n";
    const auto refused = server.ask("POST", "/hand-over");
    EXPECT_EQ(refused.status, 401);
    EXPECT_THAT(refused.body, AllOf(HasSubstr("Authorization: Bearer TOKEN"), HasSubstr("/http/token_file"),
                                    Not(HasSubstr("secret"))));
    EXPECT_EQ(server.ask("GET", "/hand-over", token).header.at("allow"), "POST");
    const auto done = server.ask("POST", "/hand-over", token);
    EXPECT_EQ(done.status, 200);
    EXPECT_THAT(done.body, HasSubstr("3 of 3"));
    server.kept = 2;
    const auto kept = server.ask("POST", "/hand-over", token);
    EXPECT_EQ(kept.status, 409);
    EXPECT_THAT(kept.body, HasSubstr("1 of 3"));
}

TEST_F(AccessTest, OffLoopbackAllButHealthAndReadinessNeedsTheToken) {
    config_.address = "0.0.0.0";
    write_token("secret");
    const TestServer server(config_);
    for (const char* path : {"/-/healthy", "/-/ready"})
        EXPECT_EQ(server.status_of("GET", path), 200) << path;
    for (const char* path : {"/metrics", "/status", "/live", "/live/a", "/map/a/mesh.glb", "/nothing"}) {
        EXPECT_EQ(server.status_of("GET", path), 401) << path;
        EXPECT_EQ(server.status_of("HEAD", path), 401) << path;
    }
    EXPECT_EQ(server.status_of("POST", "/-/healthy"), 401);
    EXPECT_EQ(server.status_of("GET", "/metrics", "Authorization: Bearer secret\r\n"), 200);
    EXPECT_EQ(server.status_of("GET", "/status", "Authorization: Bearer secret\r\n"), 200);
    EXPECT_EQ(server.status_of("GET", "/nothing", "Authorization: Bearer secret\r\n"), 404);
}

TEST_F(AccessTest, ReadsTheTokenAgain) {
    config_.address = "0.0.0.0";
    write_token("before");
    TestServer server(config_);
    const auto status = [&](const std::string& token) {
        return server.status_of("GET", "/status", "Authorization: Bearer " + token + "\r\n");
    };
    EXPECT_EQ(status("before"), 200);

    write_token("after");
    ASSERT_TRUE(server.reload());
    EXPECT_TRUE(test::eventually([&] { return status("after") == 200; }));
    EXPECT_EQ(status("before"), 401);

    write_token("");
    EXPECT_FALSE(server.reload());
    EXPECT_EQ(status("after"), 200);
}

}  // namespace
}  // namespace camdir::http
