#include "app/writable.hpp"

#include <unistd.h>

#include <filesystem>

namespace camdir::app {

Result<void> check_writable(const std::string& file) {
    if (file.empty() || file == "-") return {};
    if (std::filesystem::is_directory(file)) return fail(file + ": is a folder, expected a file to write");
    if (std::filesystem::exists(file) && !std::filesystem::is_regular_file(file)) {
        if (::access(file.c_str(), W_OK) != 0) return fail(file + ": cannot be written into");
        return {};
    }
    std::filesystem::path folder = std::filesystem::path(file).parent_path();
    if (folder.empty()) folder = ".";
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return fail(file + ": cannot write into the folder " + folder.string());
    return {};
}

}  // namespace camdir::app
