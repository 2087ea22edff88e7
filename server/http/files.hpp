// The files of the page, read once at the start: no path of a request reaches the file system.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "http/shared_text.hpp"

namespace camdir::http {

struct File {
    std::string type;
    Text text;
    Text gzip;
    std::string tag;
};

class Files {
  public:
    // The folder's HTML, CSS, JavaScript and SVG files, `index.html` also as "/", and three.js. Fails when
    // the folder has no `index.html`, or a file cannot be read or is larger than 4 MiB; without three.js only
    // `three_missing` says so.
    [[nodiscard]] static Result<Files> read(const std::filesystem::path& folder,
                                            const std::filesystem::path& three);

    // By a request's path; null: there is none.
    [[nodiscard]] const File* find(std::string_view path) const;
    [[nodiscard]] bool three_missing() const { return find("/three.js") == nullptr; }

  private:
    Result<void> add(const std::string& path, const std::filesystem::path& file);

    std::map<std::string, File, std::less<>> files_;
};

// Where the page's folder is without a configuration: beside the program, as it is built and as it is
// installed.
[[nodiscard]] std::filesystem::path default_page_folder();
// Of Debian's package libjs-three.
[[nodiscard]] std::filesystem::path three_of_debian();

}  // namespace camdir::http
