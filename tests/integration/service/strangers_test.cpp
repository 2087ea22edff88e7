// Clients that keep connections and send little or nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <csignal>
#include <vector>

#include "served.hpp"
#include "support/http_client.hpp"

namespace camdir::test {
namespace {

constexpr std::size_t strangers = 1000;

// For this process and the server, which inherits it.
void allow_open_files(rlim_t count) {
    rlimit limit{};
    ::getrlimit(RLIMIT_NOFILE, &limit);
    limit.rlim_cur = std::min(limit.rlim_max, std::max(limit.rlim_cur, count));
    ASSERT_GE(limit.rlim_cur, count);
    ASSERT_EQ(::setrlimit(RLIMIT_NOFILE, &limit), 0);
}

TEST(Strangers, DoNotKeepHealthFromAnswering) {
    ASSERT_NO_FATAL_FAILURE(allow_open_files(2 * strangers));
    const Folder folder;
    Served served(folder, quiet_config());
    const int port = served.port();
    std::vector<std::unique_ptr<HttpClient>> idle;
    std::vector<std::unique_ptr<HttpClient>> dribbling;
    while (idle.size() + dribbling.size() < strangers) {
        idle.push_back(std::make_unique<HttpClient>(port));
        dribbling.push_back(std::make_unique<HttpClient>(port));
        ASSERT_TRUE(dribbling.back()->send("GET /status HTTP/1.1\r\nSlow: "));
    }
    auto slowest = std::chrono::steady_clock::duration::zero();
    for (int round = 0; round < 50; ++round) {
        for (const auto& client : dribbling)
            ASSERT_TRUE(client->send("x"));
        const auto asked = std::chrono::steady_clock::now();
        EXPECT_EQ(HttpClient(port).ask("GET", "/-/healthy").status, 200);
        slowest = std::max(slowest, std::chrono::steady_clock::now() - asked);
    }
    RecordProperty("slowest_ms", std::to_string(std::chrono::duration<double, std::milli>(slowest).count()));
    for (const auto* clients : {&idle, &dribbling})
        EXPECT_TRUE(std::none_of(clients->begin(), clients->end(),
                                 [](const auto& client) { return client->closed(); }));
    served.signal(SIGTERM);
    EXPECT_EQ(served.exit_code(), 0) << served.log();
}

TEST(Strangers, FromOtherHostsNeedAToken) {
    const Folder folder;
    nlohmann::json config = quiet_config();
    config["http"]["address"] = "0.0.0.0";
    Served refused(folder, config);
    EXPECT_EQ(refused.exit_code(), 1);
    EXPECT_THAT(refused.log(), testing::HasSubstr("0.0.0.0 is not a loopback address"));
    const Ran checked = run_director({"serve", "--check", "--config", folder / "config.json"});
    EXPECT_EQ(checked.exit_code, 1);
    EXPECT_THAT(checked.errors, testing::HasSubstr("config.json: http: 0.0.0.0 is not a loopback address"));
}

TEST(Strangers, SighupReadsTheTokenAgain) {
    const Folder folder;
    const auto write_token = [&](const std::string& token) {
        folder.write("token", token);
        std::filesystem::permissions(folder / "token", std::filesystem::perms(0600));
    };
    write_token("before\n");
    nlohmann::json config = quiet_config();
    config["http"]["token_file"] = "token";
    Served served(folder, config);
    // 405 rather than 401: no page takes a POST.
    const auto status = [&](const std::string& token) {
        return HttpClient(served.port())
            .ask("POST", "/status", "Authorization: Bearer " + token + "\r\n")
            .status;
    };
    EXPECT_EQ(status("before"), 405);

    write_token("after\n");
    served.signal(SIGHUP);
    ASSERT_TRUE(served.logged("config.json: reloaded")) << served.log();
    EXPECT_EQ(status("after"), 405);
    EXPECT_EQ(status("before"), 401);

    write_token("");
    served.signal(SIGHUP);
    ASSERT_TRUE(served.logged("not reloaded")) << served.log();
    EXPECT_THAT(served.log(), testing::HasSubstr("expected one line with a token"));
    EXPECT_EQ(status("after"), 405);
}

}  // namespace
}  // namespace camdir::test
