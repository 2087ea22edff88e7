#include "director_process.hpp"

#include <fstream>
#include <stdexcept>

#include "support/http_client.hpp"
#include "support/test_domain.hpp"

namespace camdir::soak {
namespace {

constexpr const char* token = "hand-over";

}  // namespace

DirectorProcess::DirectorProcess(Setting setting)
    : setting_(std::move(setting)),
      file_(setting_.folder / ("director-" + std::to_string(setting_.index) + ".json")),
      token_file_(setting_.folder / "token") {}

void DirectorProcess::start(const std::string& map_file, const std::string& source) {
    std::ofstream(token_file_) << token << '\n';
    std::filesystem::permissions(token_file_, std::filesystem::perms(0600));
    std::ofstream(file_) << R"({"dds": {"domain": )" << setting_.domain << R"(, "participant_index": )"
                         << setting_.index << R"(, "peers": [")"
                         << test::director_address(setting_.domain, 1 - setting_.index)
                         << R"("], "strength": )" << (setting_.index == 0 ? 200 : 100)
                         << R"(, "director_id": )" << id_of(setting_.index)
                         << R"(}, "http": {"port": 0, "token_file": ")" << token_file_.string()
                         << R"("}, "maps": [{"name": "map", "file": ")" << map_file << R"(", "source": ")"
                         << source << R"("}]})";
    process_ = std::make_unique<test::ChildProcess>(
        std::vector<std::string>{setting_.program, "serve", "--config", file_.string()});
}

bool DirectorProcess::hand_over() const {
    const auto answer =
        test::HttpClient(http_port())
            .ask("POST", "/hand-over", "Authorization: Bearer " + std::string(token) + "\r\n");
    if (answer.status != 200 && answer.status != 409)
        throw std::runtime_error("POST /hand-over: " + answer.body);
    return answer.status == 200;
}

bool DirectorProcess::is_ready() const {
    const int port = http_port();
    return port != 0 && test::HttpClient(port).ask("GET", "/-/ready").status == 200;
}

int DirectorProcess::http_port() const {
    const std::string before = "http: listening on 127.0.0.1 port ";
    const std::string lines = log();
    const std::size_t found = lines.find(before);
    return found == std::string::npos ? 0 : std::stoi(lines.substr(found + before.size()));
}

}  // namespace camdir::soak
