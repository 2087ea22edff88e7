// A real camera-director process and the folder it works in.
#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/child_process.hpp"
#include "support/temporary_folder.hpp"

namespace camdir::test {

// A folder for the configuration and the maps of a director.
class Folder {
  public:
    [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }
    void write(const std::string& name, const std::string& content) const;
    // The baked square of support/freespace_meshes.hpp.
    void write_square(const std::string& name) const;

  private:
    TemporaryFolder folder_;
};

// Runs camera-director with these arguments to its end.
struct Ran {
    int exit_code;
    std::string output;
    std::string errors;
};
[[nodiscard]] Ran run_director(const std::vector<std::string>& arguments);

// A configuration without fixed ports, with a JSON log.
[[nodiscard]] nlohmann::json quiet_config();

// `camera-director serve` with the configuration written to `folder`/config.json, and more options.
class Served {
  public:
    Served(const Folder& folder, const nlohmann::json& config, const std::vector<std::string>& options = {});

    // Waits until the log contains the text; false after a generous timeout.
    [[nodiscard]] bool logged(const std::string& text) const;
    // The port of HTTP, when it listens on 127.0.0.1.
    [[nodiscard]] int port() const;
    // The body of a GET. Throws when the status differs.
    [[nodiscard]] std::string get(const std::string& path, int status = 200);
    [[nodiscard]] nlohmann::json status() { return nlohmann::json::parse(get("/status")); }

    void signal(int number) const { process_->send_signal(number); }
    // Waits until the process ends.
    [[nodiscard]] int exit_code() { return process_->wait(); }
    [[nodiscard]] std::string log() const { return process_->errors(); }

  private:
    std::unique_ptr<ChildProcess> process_;
};

}  // namespace camdir::test
