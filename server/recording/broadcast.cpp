#include "recording/broadcast.hpp"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "base/file.hpp"
#include "recording/percent.hpp"
#include "recording/resource.hpp"

namespace camdir::recording {
namespace {

using json = nlohmann::ordered_json;

constexpr std::chrono::minutes unwanted_for{10};

std::string dump(const json& object) {
    return object.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

// "/a/b" has the parts a and b.
std::vector<std::string_view> parts_of(std::string_view path) {
    std::vector<std::string_view> parts;
    while (path.starts_with('/')) {
        path.remove_prefix(1);
        parts.push_back(path.substr(0, path.find('/')));
        path.remove_prefix(parts.back().size());
    }
    return parts;
}

// In the one way in which it is written: caches keep each resource once.
std::optional<std::uint32_t> fragment_number(std::string_view text) {
    std::uint32_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || std::to_string(number) != text) return std::nullopt;
    return number;
}

// As it is written, or as proxies write it who leave what need not be encoded: caches keep each resource
// once.
bool is_spelling_of(const std::string& match_id, std::string_view name) {
    std::string plain = percent_encoded(match_id);
    if (name == plain) return true;
    for (const auto& [encoded, sign] : {std::pair("%2D", "-"), std::pair("%2E", "."), std::pair("%7E", "~")})
        for (std::size_t at = plain.find(encoded); at != std::string::npos; at = plain.find(encoded, at))
            plain.replace(at, 3, sign);
    return name == plain;
}

std::string sync_of(const Channel& channel) {
    const std::chrono::duration<double> age = Channel::Clock::now() - channel.complete_at;
    return dump({{"version", major_version},
                 {"recording", channel.recording_id},
                 {"first_fragment", channel.sync.first},
                 {"last_fragment", channel.sync.last},
                 {"fragment_duration_s", channel.fragment_duration_s},
                 {"age_s", age.count()},
                 {"delay_s", channel.delay_s},
                 {"live", channel.is_live}});
}

struct Part {
    std::string file;  // below the recording's folder
    ResourceKind kind;
    std::uint32_t fragment;
};

// Of the parts that follow the recording's id: start, or a number and the name of a file.
std::optional<Part> part_of(const Channel& channel, const std::vector<std::string_view>& parts) {
    if (parts.size() == 3 && parts[2] == "start") return Part{"start", ResourceKind::start, 0};
    if (parts.size() != 4 || (parts[3] != "full" && parts[3] != "delta")) return std::nullopt;
    const auto number = fragment_number(parts[2]);
    // Those before the first are there as long as a viewer may just have been told of them.
    if (!number || *number > channel.sync.last) return std::nullopt;
    return Part{std::to_string(*number) + "/" + std::string(parts[3]),
                parts[3] == "full" ? ResourceKind::full : ResourceKind::delta, *number};
}

// A recording may come from elsewhere, and its files from anywhere: what is no such resource is not shown.
std::optional<Bytes> read_part(const Channel& channel, const Part& part) {
    auto bytes = read_file(channel.folder / part.file, max_resource);
    if (!bytes || !has_header(*bytes, part.kind, part.fragment)) return std::nullopt;
    return std::move(*bytes);
}

}  // namespace

void Broadcast::set(const std::string& match_id, Channel channel) {
    const std::lock_guard lock(mutex_);
    wanted_at_.erase(match_id);
    channels_[match_id] = std::move(channel);
}

void Broadcast::end(const std::string& match_id, Time now) {
    const std::lock_guard lock(mutex_);
    if (const auto channel = channels_.find(match_id); channel != channels_.end()) {
        channel->second.is_live = false;
        wanted_at_[match_id] = now;
    }
}

void Broadcast::drop_unwanted(Time now) {
    const std::lock_guard lock(mutex_);
    std::erase_if(wanted_at_, [&](const auto& ended) {
        return now - ended.second > unwanted_for && channels_.erase(ended.first) > 0;
    });
}

void Broadcast::remove(const std::filesystem::path& folder) {
    const std::lock_guard lock(mutex_);
    std::erase_if(wanted_at_, [&](const auto& ended) {
        const auto channel = channels_.find(ended.first);
        if (channel == channels_.end() || channel->second.folder != folder) return false;
        channels_.erase(channel);
        return true;
    });
}

std::optional<Broadcast::Answer> Broadcast::get(std::string_view path, Time now) const {
    if (path.empty()) return Answer{true, "", list()};
    const auto parts = parts_of(path);
    const auto match_id = parts.empty() ? std::nullopt : percent_decoded(parts[0]);
    const auto channel = match_id && is_spelling_of(*match_id, parts[0]) ? find(*match_id) : std::nullopt;
    if (!channel || parts.size() < 2) return std::nullopt;
    if (parts.size() == 2 && parts[1] == "sync") {
        keep_for_longer(*match_id, now);
        return Answer{true, "", sync_of(*channel)};
    }
    const auto part = parts[1] == channel->recording_id ? part_of(*channel, parts) : std::nullopt;
    const auto bytes = part ? read_part(*channel, *part) : std::nullopt;
    if (!bytes) return std::nullopt;
    keep_for_longer(*match_id, now);
    return Answer{false, channel->recording_id + "/" + part->file,
                  std::string(reinterpret_cast<const char*>(bytes->data()), bytes->size())};
}

std::optional<Channel> Broadcast::find(const std::string& match_id) const {
    const std::lock_guard lock(mutex_);
    const auto found = channels_.find(match_id);
    return found == channels_.end() ? std::nullopt : std::optional(found->second);
}

void Broadcast::keep_for_longer(const std::string& match_id, Time now) const {
    const std::lock_guard lock(mutex_);
    if (const auto ended = wanted_at_.find(match_id); ended != wanted_at_.end())
        ended->second = std::max(ended->second, now);
}

std::string Broadcast::list() const {
    const std::lock_guard lock(mutex_);
    json matches = json::array();
    for (const auto& [match_id, channel] : channels_)
        matches.push_back({{"match", match_id},
                           {"map", channel.map_name},
                           {"live", channel.is_live},
                           {"sync", "/broadcast/" + percent_encoded(match_id) + "/sync"}});
    return dump({{"matches", std::move(matches)}});
}

}  // namespace camdir::recording
