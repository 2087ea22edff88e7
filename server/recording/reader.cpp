#include "recording/reader.hpp"

#include <algorithm>
#include <charconv>
#include <optional>
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

// A damaged `sync` may name any number: what is there counts.
std::vector<std::uint32_t> fragments_in(const fs::path& folder, const Sync& sync) {
    std::vector<std::uint32_t> fragments;
    std::error_code error;
    for (fs::directory_iterator it(folder, error), end; !error && it != end; it.increment(error)) {
        const std::string name = it->path().filename().string();
        std::uint32_t number = 0;
        const auto [stop, wrong] = std::from_chars(name.data(), name.data() + name.size(), number);
        const bool is_number = wrong == std::errc() && std::to_string(number) == name;
        if (is_number && number >= sync.first && number <= sync.last) fragments.push_back(number);
    }
    std::ranges::sort(fragments);
    return fragments;
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
    auto fragments = fragments_in(folder, *sync);
    if (fragments.empty())
        return fail(folder.string() + ": none of the fragments " + std::to_string(sync->first) + " to " +
                    std::to_string(sync->last) + " that its sync names is there");
    return Reader(folder, std::move(*start), std::move(fragments));
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
    std::size_t found = 0;
    // All up to `low` are looked at, and all from `end` on.
    std::size_t low = 0;
    for (std::size_t end = fragments_.size(); low + 1 < end;) {
        const std::size_t middle = low + (end - low) / 2;
        std::size_t probe = middle;
        auto begin = begin_time(fragments_[probe]);
        while (!begin && probe > low + 1)
            begin = begin_time(fragments_[--probe]);
        if (begin && *begin > time) {
            end = probe;
        } else {
            low = middle;
            if (begin) found = probe;
        }
    }
    return fragments_[found];
}

std::vector<Error> Reader::replay(std::int64_t time, const std::function<void(const Record&)>& visit) const {
    std::vector<Error> left_out;
    std::optional<std::uint32_t> before;  // the last that was read
    auto next = std::ranges::lower_bound(fragments_, fragment_at(time));
    for (std::uint32_t expected = *next; next != fragments_.end(); expected = *next++ + 1) {
        if (*next != expected) left_out.push_back(missing(expected, *next));
        if (const auto read = replay_one(*next, before && *before + 1 == *next, visit); read)
            before = *next;
        else
            left_out.push_back(read.error());
    }
    return left_out;
}

Error Reader::missing(std::uint32_t first, std::uint32_t end) const {
    const std::string last = end - first > 1 ? " to " + std::to_string(end - 1) : "";
    return {folder_.string() + ": " + std::to_string(first) + last + ": missing"};
}

Result<void> Reader::replay_one(std::uint32_t fragment, bool goes_on,
                                const std::function<void(const Record&)>& visit) const {
    const auto state = goes_on ? Result<std::vector<Record>>() : records(fragment, ResourceKind::full);
    if (!state) return tl::unexpected(state.error());
    const auto all = delta(fragment);
    if (!all) return tl::unexpected(all.error());
    std::ranges::for_each(*state, visit);
    std::ranges::for_each(*all, visit);
    return {};
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
