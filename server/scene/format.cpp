#include "scene/format.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <string_view>

#include "scene/cloud/las.hpp"
#include "scene/cloud/pcd.hpp"
#include "scene/mesh/gltf_buffers.hpp"
#include "scene/records/ply.hpp"
#include "scene/records/records.hpp"

namespace camdir::scene {
namespace {

// The part of a text in which its first line is looked for.
constexpr std::size_t sniffed_bytes = 65536;

bool is_binary_stl(std::span<const std::byte> bytes) {
    constexpr std::size_t header = 84;
    constexpr std::size_t facet = 50;
    if (bytes.size() < header) return false;
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    return bytes.size() == header + facet * std::size_t{count};
}

// Of the first line that is neither blank nor a comment.
std::vector<std::string_view> first_words(std::string_view text) {
    Lines lines(text.substr(0, sniffed_bytes));
    while (const auto line = lines.next()) {
        std::vector<std::string_view> words = words_of(*line);
        if (!words.empty() && !words[0].starts_with('#')) return words;
    }
    return {};
}

bool starts_obj(std::string_view word) {
    constexpr std::array<std::string_view, 10> keywords = {"v", "vn", "vt", "vp",     "f",
                                                           "g", "o",  "s",  "mtllib", "usemtl"};
    return std::find(keywords.begin(), keywords.end(), word) != keywords.end();
}

bool is_number(std::string_view word) {
    return number_of(word).has_value();
}

}  // namespace

Result<std::variant<std::monostate, MeshFormat, CloudFormat>> format_of(std::span<const std::byte> bytes,
                                                                        const std::string& extension) {
    if (is_ply(bytes)) {
        const auto faces = ply_face_count(bytes);
        if (!faces) return tl::unexpected(faces.error());
        if (*faces > 0) return MeshFormat::ply;
        return CloudFormat::ply;
    }
    if (is_las(bytes)) return CloudFormat::las;
    if (is_pcd(bytes)) return CloudFormat::pcd;
    if (is_glb(bytes)) return MeshFormat::glb;
    if (is_binary_stl(bytes)) return MeshFormat::stl;

    const std::vector<std::string_view> words = first_words(text_of(bytes));
    if (!words.empty()) {
        if (words[0].starts_with('{') || extension == ".gltf") return MeshFormat::gltf;
        if (words[0] == "solid" || extension == ".stl") return MeshFormat::stl;
        if (starts_obj(words[0]) || extension == ".obj") return MeshFormat::obj;
        if (words.size() >= 3 && std::all_of(words.begin(), words.begin() + 3, is_number))
            return CloudFormat::xyz;
    }
    return std::monostate{};
}

}  // namespace camdir::scene
