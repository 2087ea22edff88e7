#include "served.hpp"

#include <sstream>
#include <stdexcept>

#include "base/file.hpp"
#include "support/eventually.hpp"
#include "support/freespace_meshes.hpp"
#include "support/http_client.hpp"
#include "support/test_domain.hpp"

namespace camdir::test {
namespace {

using nlohmann::json;

void check(const Result<void>& written) {
    if (!written) throw std::runtime_error(written.error().message);
}

}  // namespace

void Folder::write(const std::string& name, const std::string& content) const {
    check(write_file(folder_ / name, content));
}

void Folder::write_square(const std::string& name) const {
    check(write_file(folder_ / name, freespace::encode(square_contents())));
}

Ran run_director(const std::vector<std::string>& arguments) {
    std::vector<std::string> command = {CAMERA_DIRECTOR};
    command.insert(command.end(), arguments.begin(), arguments.end());
    ChildProcess process(command);
    const int exit_code = process.wait();
    return {exit_code, process.output(), process.errors()};
}

json quiet_config() {
    return {{"dds", {{"domain", quiet_domain}, {"participant_index", -1}}},
            {"http", {{"port", 0}}},
            {"log", {{"format", "json"}, {"level", "debug"}}}};
}

Served::Served(const Folder& folder, const json& config, const std::vector<std::string>& options) {
    folder.write("config.json", config.dump());
    std::vector<std::string> command = {CAMERA_DIRECTOR, "serve", "--config", folder / "config.json"};
    command.insert(command.end(), options.begin(), options.end());
    process_ = std::make_unique<ChildProcess>(command);
}

bool Served::logged(const std::string& text) const {
    return eventually([&] { return log().find(text) != std::string::npos; });
}

int Served::port() const {
    const std::string before = "http: listening on 127.0.0.1 port ";
    if (!logged(before)) throw std::runtime_error("no port in the log: " + log());
    std::istringstream lines(log());
    for (std::string line; std::getline(lines, line);) {
        const std::string message = json::parse(line)["message"];
        if (message.starts_with(before)) return std::stoi(message.substr(before.size()));
    }
    throw std::runtime_error("no port in the log: " + log());
}

std::string Served::get(const std::string& path, int status) {
    const HttpAnswer answer = HttpClient(port()).ask("GET", path);
    if (answer.status != status)
        throw std::runtime_error("GET " + path + ": " + std::to_string(answer.status) + " " + answer.body);
    return answer.body;
}

}  // namespace camdir::test
