#include "support/game/director.hpp"

#include <csignal>
#include <fstream>
#include <stdexcept>

#include "support/eventually.hpp"
#include "support/openarena.hpp"

namespace camdir::test {

GameDirector::GameDirector(std::uint32_t domain, const std::vector<std::string>& maps) {
    std::filesystem::create_directories(CAMDIR_TEST_MAPS);
    std::string list;
    for (const std::string& map : maps) {
        const auto source = openarena_map(map);
        if (!source) throw std::runtime_error("no map " + map);
        list += (list.empty() ? "" : ", ");
        list += R"({"name": ")" + map + R"(", "file": ")" CAMDIR_TEST_MAPS "/" + map +
                R"(.vfs", "source": ")" + *source + "\"}";
    }
    std::ofstream(folder_ / "config.json") << R"({"dds": {"domain": )" << domain
                                           << R"(}, "http": {"enabled": false}, "maps": [)" << list << "]}\n";
    ChildProcess bake({CAMDIR_TEST_DIRECTOR, "bake", "--config", (folder_ / "config.json").string()});
    if (bake.wait() != 0) throw std::runtime_error("bake: " + bake.errors());
    start();
}

void GameDirector::start() {
    process_ = std::make_unique<ChildProcess>(std::vector<std::string>{
        CAMDIR_TEST_DIRECTOR, "serve", "--config", (folder_ / "config.json").string()});
}

void GameDirector::kill() {
    process_->send_signal(SIGKILL);
    process_->wait();
}

bool GameDirector::ready() const {
    return eventually([&] { return log().find("ready") != std::string::npos; });
}

}  // namespace camdir::test
