#include "http/files.hpp"

#include <xxhash.h>

#include <array>
#include <cstdio>

#include "base/file.hpp"
#include "live/gzip.hpp"

namespace camdir::http {
namespace {

namespace fs = std::filesystem;

constexpr std::uintmax_t max_size = 4U << 20U;
constexpr std::array<std::pair<std::string_view, std::string_view>, 4> types = {
    {{".html", "text/html; charset=utf-8"},
     {".css", "text/css; charset=utf-8"},
     {".js", "text/javascript; charset=utf-8"},
     {".svg", "image/svg+xml"}}};

std::string_view type_of(const fs::path& file) {
    for (const auto& [extension, type] : types)
        if (file.extension() == extension) return type;
    return {};
}

std::string tag_of(const std::string& text) {
    std::array<char, 20> tag{};
    std::snprintf(tag.data(), tag.size(), "%016llx",
                  static_cast<unsigned long long>(XXH3_64bits(text.data(), text.size())));
    return tag.data();
}

}  // namespace

Result<Files> Files::read(const fs::path& folder, const fs::path& three) {
    Files files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
        if (type_of(entry.path()).empty()) continue;
        if (auto added = files.add("/" + entry.path().filename().string(), entry.path()); !added)
            return tl::unexpected(added.error());
    }
    const auto index = files.files_.find("/index.html");
    if (error || index == files.files_.end())
        return fail(folder.string() + ": expected a folder with index.html, the page's files" +
                    (error ? ": " + error.message() : ""));
    files.files_["/"] = index->second;
    if (fs::exists(three, error))
        if (auto added = files.add("/three.js", three); !added) return tl::unexpected(added.error());
    return files;
}

Result<void> Files::add(const std::string& path, const fs::path& file) {
    std::error_code error;
    if (const std::uintmax_t size = fs::file_size(file, error); error || size > max_size)
        return fail(file.string() + ": expected a file of at most " + std::to_string(max_size) + " bytes");
    const auto bytes = read_file(file);
    if (!bytes) return tl::unexpected(bytes.error());
    const std::string text(reinterpret_cast<const char*>(bytes->data()), bytes->size());
    files_[path] = {std::string(type_of(file)), share(text), share(live::gzip(*bytes)), tag_of(text)};
    return {};
}

const File* Files::find(std::string_view path) const {
    const auto found = files_.find(path);
    return found == files_.end() ? nullptr : &found->second;
}

fs::path default_page_folder() {
    std::error_code error;
    return fs::read_symlink("/proc/self/exe", error).parent_path().parent_path() /
           "share/camera-director/page";
}

fs::path three_of_debian() {
    return "/usr/share/javascript/three/three.module.js";
}

}  // namespace camdir::http
