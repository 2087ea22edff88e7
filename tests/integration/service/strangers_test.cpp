// Clients that keep connections and send little or nothing.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
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

// A connection that sends nothing, or the beginning of a request.
class Stranger {
  public:
    // `limit`: the server's, on how long it waits for the rest.
    Stranger(int port, const std::string& beginning, std::chrono::seconds limit)
        : keeps_until_(Clock::now() + limit), client_(port) {
        EXPECT_TRUE(client_.send(beginning));
    }
    void dribble() const { (void)client_.send("x"); }
    // Not closed before its time.
    [[nodiscard]] bool is_borne() const { return !client_.closed() || Clock::now() >= keeps_until_; }

  private:
    using Clock = std::chrono::steady_clock;
    const Clock::time_point keeps_until_;
    const HttpClient client_;
};

TEST(Strangers, DoNotKeepHealthFromAnswering) {
    ASSERT_NO_FATAL_FAILURE(allow_open_files(2 * strangers));
    const Folder folder;
    Served served(folder, quiet_config());
    const int port = served.port();
    std::vector<std::unique_ptr<Stranger>> idle;
    std::vector<std::unique_ptr<Stranger>> dribbling;
    while (idle.size() + dribbling.size() < strangers) {
        idle.push_back(std::make_unique<Stranger>(port, "", std::chrono::seconds(60)));
        dribbling.push_back(
            std::make_unique<Stranger>(port, "GET /status HTTP/1.1\r\nSlow: ", std::chrono::seconds(20)));
    }
    auto slowest = std::chrono::steady_clock::duration::zero();
    for (int round = 0; round < 50; ++round) {
        for (const auto& stranger : dribbling)
            stranger->dribble();
        const auto asked = std::chrono::steady_clock::now();
        EXPECT_EQ(HttpClient(port).ask("GET", "/-/healthy").status, 200);
        slowest = std::max(slowest, std::chrono::steady_clock::now() - asked);
    }
    RecordProperty("slowest_ms", std::to_string(std::chrono::duration<double, std::milli>(slowest).count()));
    for (const auto* all : {&idle, &dribbling})
        EXPECT_TRUE(
            std::all_of(all->begin(), all->end(), [](const auto& stranger) { return stranger->is_borne(); }));
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
    ASSERT_TRUE(served.logged("expected one line with a token")) << served.log();
    EXPECT_THAT(served.log(), testing::HasSubstr("not reloaded"));
    EXPECT_EQ(status("after"), 405);

    std::filesystem::rename(folder / "token", folder / "moved");
    config["http"]["token_file"] = "moved";
    folder.write("config.json", config.dump());
    served.signal(SIGHUP);
    ASSERT_TRUE(served.logged("/http/token_file takes effect after a restart")) << served.log();
    EXPECT_EQ(status("after"), 405);
}

}  // namespace
}  // namespace camdir::test
