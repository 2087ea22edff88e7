#include "app/commands.hpp"

#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <iostream>

namespace camdir::app {
namespace {

namespace fs = std::filesystem;

Result<void> check_output(const std::string& file) {
    if (file.empty() || file == "-") return {};
    if (fs::is_directory(file)) return fail(file + ": is a folder, expected a file to write");
    if (fs::exists(file) && !fs::is_regular_file(file)) {
        if (::access(file.c_str(), W_OK) != 0) return fail(file + ": cannot be written");
        return {};
    }
    fs::path folder = fs::path(file).parent_path();
    if (folder.empty()) folder = ".";
    if (::access(folder.c_str(), W_OK | X_OK) != 0)
        return fail(file + ": cannot write into the folder " + folder.string());
    return {};
}

// Whether `file` is the input, or the archive that holds it.
bool is_input(const std::string& file, const std::string& input) {
    std::error_code error;
    for (std::size_t colon = input.find(':'); colon != std::string::npos; colon = input.find(':', colon + 1))
        if (fs::equivalent(file, input.substr(0, colon), error)) return true;
    return fs::equivalent(file, input, error);
}

// Devices may be named twice.
bool is_same_file(const std::string& a, const std::string& b) {
    if (a.empty() || b.empty() || a == "-" || b == "-") return false;
    if (fs::exists(a) && !fs::is_regular_file(a)) return false;
    return fs::weakly_canonical(fs::absolute(a)) == fs::weakly_canonical(fs::absolute(b));
}

}  // namespace

int report(const Error& error) {
    std::cerr << "camera-director: " << error.message << '\n';
    return error.code == ErrorCode::interrupted ? exit_interrupted : exit_failed;
}

void ExitWhenInterrupted::leave() {
    if (::isatty(STDERR_FILENO) == 1) std::cerr << '\n';  // below the progress line
    ::_exit(report(Error{"interrupted", ErrorCode::interrupted}));
}

int exit_code_of(const Result<void>& done) {
    return done ? exit_done : report(done.error());
}

Result<void> check_outputs(std::initializer_list<std::string> files,
                           std::initializer_list<std::string> inputs) {
    for (const std::string* file = files.begin(); file != files.end(); ++file) {
        if (auto writable = check_output(*file); !writable) return writable;
        if (std::any_of(files.begin(), file, [&](const auto& other) { return is_same_file(other, *file); }))
            return fail(*file + ": is named for two outputs; expected a file for each");
        if (std::any_of(inputs.begin(), inputs.end(),
                        [&](const auto& input) { return is_input(*file, input); }))
            return fail(*file + ": is read, too; expected another file to write");
    }
    return {};
}

void check_one_standard_output(std::initializer_list<std::pair<const char*, std::string>> outputs) {
    const auto count = std::count_if(outputs.begin(), outputs.end(),
                                     [](const auto& output) { return output.second == "-"; });
    if (count <= 1) return;
    std::string names;
    for (const auto& [option, file] : outputs)
        names += (names.empty() ? "" : ", ") + std::string(option);
    throw CLI::ValidationError("only one of " + names + " can be standard output");
}

}  // namespace camdir::app
