#include "recording/reader.hpp"

#include <algorithm>
#include <string>
#include <system_error>
#include <vector>

namespace camdir::recording {
namespace {

namespace fs = std::filesystem;

// The recordings in a folder, of which the last one by name began last.
std::vector<std::string> recordings_in(const fs::path& folder) {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        std::error_code ignored;
        if (fs::exists(it->path() / "start", ignored)) names.push_back(it->path().filename().string());
    }
    std::ranges::sort(names);
    return names;
}

Result<void> check_is_recording(const fs::path& folder) {
    static const std::string expected =
        ": expected the folder of a recording, one of those that a director makes in its recording.folder";
    std::error_code error;
    if (!fs::is_directory(folder, error)) return fail(folder.string() + ": is no folder" + expected);
    if (fs::exists(folder / "start", error)) {
        if (fs::exists(folder / "sync", error)) return {};
        return fail(folder.string() + ": has no sync: the recording ended before its first fragment did");
    }
    const auto names = recordings_in(folder);
    if (names.empty()) return fail(folder.string() + ": has no start" + expected);
    return fail(folder.string() + ": holds recordings and is none: name one of these " +
                std::to_string(names.size()) + ", the last is " + (folder / names.back()).string());
}

}  // namespace

Result<Reader> Reader::open(const std::filesystem::path& folder) {
    if (auto is = check_is_recording(folder); !is) return tl::unexpected(is.error());
    const auto start_bytes = read_file(folder / "start", max_resource);
    if (!start_bytes) return tl::unexpected(start_bytes.error());
    auto start = decode_start(*start_bytes, (folder / "start").string());
    if (!start) return tl::unexpected(start.error());
    const auto sync_bytes = read_file(folder / "sync", max_sync);
    if (!sync_bytes) return tl::unexpected(sync_bytes.error());
    const auto sync = decode_sync(*sync_bytes, (folder / "sync").string());
    if (!sync) return tl::unexpected(sync.error());
    return Reader(folder, std::move(*start), *sync);
}

Result<State> Reader::full(std::uint32_t fragment) const {
    const auto all = records(fragment, ResourceKind::full);
    if (!all) return tl::unexpected(all.error());
    State state;
    for (const Record& record : *all)
        state.apply(record.message);
    return state;
}

Result<std::vector<Record>> Reader::delta(std::uint32_t fragment) const {
    return records(fragment, ResourceKind::delta);
}

Result<std::int64_t> Reader::begin_time(std::uint32_t fragment) const {
    const auto full = resource(fragment, ResourceKind::full);
    if (!full) return tl::unexpected(full.error());
    return full->begin_time;
}

std::uint32_t Reader::fragment_at(std::int64_t time) const {
    std::uint32_t found = sync_.first;
    // All up to `low` are looked at, and all from `end` on.
    std::uint64_t low = found;
    for (std::uint64_t end = std::uint64_t{sync_.last} + 1; low + 1 < end;) {
        const std::uint64_t middle = low + (end - low) / 2;
        std::uint64_t probe = middle;
        auto begin = begin_time(static_cast<std::uint32_t>(probe));
        while (!begin && probe > low + 1)
            begin = begin_time(static_cast<std::uint32_t>(--probe));
        if (begin && *begin > time) {
            end = probe;
        } else {
            low = middle;
            if (begin) found = static_cast<std::uint32_t>(probe);
        }
    }
    return found;
}

std::vector<Error> Reader::replay(std::int64_t time, const std::function<void(const Record&)>& visit) const {
    std::vector<Error> left_out;
    bool goes_on = false;
    for (std::uint64_t n = fragment_at(time); n <= sync_.last; ++n) {
        const auto fragment = static_cast<std::uint32_t>(n);
        const auto before = goes_on ? Result<std::vector<Record>>() : records(fragment, ResourceKind::full);
        const auto all = before ? delta(fragment) : before;
        goes_on = all.has_value();
        if (!goes_on) {
            left_out.push_back(all.error());
            continue;
        }
        for (const auto& part : {*before, *all})
            std::ranges::for_each(part, visit);
    }
    return left_out;
}

std::filesystem::path Reader::path_of(std::uint32_t fragment, ResourceKind kind) const {
    return folder_ / std::to_string(fragment) / (kind == ResourceKind::full ? "full" : "delta");
}

Result<Resource> Reader::resource(std::uint32_t fragment, ResourceKind kind) const {
    const std::filesystem::path path = path_of(fragment, kind);
    const auto bytes = read_file(path, max_resource);
    if (!bytes) return tl::unexpected(bytes.error());
    auto resource = decode_resource(*bytes, path.string());
    if (resource && (resource->kind != kind || resource->fragment != fragment))
        return fail(path.string() +
                    ": byte 6: another resource's kind or fragment, expected those of its name");
    return resource;
}

Result<std::vector<Record>> Reader::records(std::uint32_t fragment, ResourceKind kind) const {
    auto file = resource(fragment, kind);
    if (!file) return tl::unexpected(file.error());
    return decode_records(*file, path_of(fragment, kind).string());
}

}  // namespace camdir::recording
