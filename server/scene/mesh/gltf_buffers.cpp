#include "scene/mesh/gltf_buffers.hpp"

#include <algorithm>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "scene/records/records.hpp"

namespace camdir::scene {
namespace {

// glTF itself nests less than ten deep, extensions not much deeper; Assimp's parser recurses.
constexpr int max_depth = 64;

Result<std::string_view> json_of(std::span<const std::byte> bytes) {
    if (!is_glb(bytes)) return text_of(bytes);
    constexpr std::size_t begin = 20;  // after the file's header and the first chunk's
    if (bytes.size() < begin) return fail("ends within the header of glTF binary");
    std::uint32_t length = 0;
    std::memcpy(&length, bytes.data() + 12, sizeof length);
    if (length > bytes.size() - begin)
        return fail("ends after " + std::to_string(bytes.size()) + " bytes; the JSON chunk has " +
                    std::to_string(length));
    return text_of(bytes.subspan(begin, length));
}

// Decodes %20 and the like; nothing for broken escapes.
std::optional<std::string> decoded(std::string_view uri) {
    std::string text;
    for (std::size_t i = 0; i < uri.size(); ++i) {
        if (uri[i] != '%') {
            text += uri[i];
            continue;
        }
        unsigned value = 0;
        if (uri.size() - i < 3) return std::nullopt;
        const auto [end, error] = std::from_chars(uri.data() + i + 1, uri.data() + i + 3, value, 16);
        if (error != std::errc() || end != uri.data() + i + 3 || value == 0) return std::nullopt;
        text += static_cast<char>(value);
        i += 2;
    }
    return text;
}

bool is_inside(const std::filesystem::path& path) {
    return path.is_relative() && !path.empty() &&
           std::none_of(path.begin(), path.end(), [](const auto& part) { return part == ".."; });
}

}  // namespace

bool is_glb(std::span<const std::byte> bytes) {
    return text_of(bytes).starts_with("glTF");
}

Result<std::vector<GltfBuffer>> gltf_buffers(std::span<const std::byte> bytes) {
    using nlohmann::json;
    const auto text = json_of(bytes);
    if (!text) return tl::unexpected(text.error());
    int deepest = 0;
    const auto measure = [&](int depth, json::parse_event_t, json&) {
        deepest = std::max(deepest, depth);
        return depth <= max_depth;
    };
    const json root = json::parse(*text, measure, false);
    if (deepest > max_depth) return fail("JSON nested deeper than " + std::to_string(max_depth));
    if (root.is_discarded() || !root.is_object()) return fail("expected a JSON object");

    std::vector<GltfBuffer> buffers;
    const auto list = root.find("buffers");
    if (list == root.end() || !list->is_array()) return buffers;
    for (std::size_t i = 0; i < list->size(); ++i) {
        const json& buffer = (*list)[i];
        const std::string pointer = "/buffers/" + std::to_string(i);
        if (!buffer.is_object() || !buffer.contains("uri")) continue;
        if (!buffer["uri"].is_string() || !buffer.contains("byteLength") ||
            !buffer["byteLength"].is_number_unsigned())
            return fail(pointer + ": expected a string uri and a whole number byteLength");
        const auto& uri = buffer["uri"].get_ref<const std::string&>();
        if (uri.starts_with("data:")) continue;
        const auto path = decoded(uri);
        if (!path || !is_inside(*path) || uri.find("://") != std::string::npos)
            return fail(pointer + "/uri: '" + uri.substr(0, 80) + "': expected a path within the folder");
        buffers.push_back({uri, *path, buffer["byteLength"].get<std::uint64_t>()});
    }
    return buffers;
}

}  // namespace camdir::scene
