#include "recording/sync.hpp"

#include <nlohmann/json.hpp>

#include "recording/resource.hpp"

namespace camdir::recording {
namespace {

bool is_number(const nlohmann::json& object, const char* key) {
    const auto found = object.find(key);
    return found != object.end() && found->is_number_unsigned() && found->get<std::uint64_t>() <= 0xffffffffU;
}

}  // namespace

std::string encode(const Sync& sync) {
    const nlohmann::json object = {
        {"version", major_version}, {"first_fragment", sync.first}, {"last_fragment", sync.last}};
    return object.dump() + "\n";
}

Result<Sync> decode_sync(std::span<const std::byte> bytes, const std::string& name) {
    // Bounds the nesting that the parser may meet.
    if (bytes.size() > max_sync)
        return fail(name + ": byte 4096: expected at most " + std::to_string(max_sync) + " bytes of JSON");
    const auto* text = reinterpret_cast<const char*>(bytes.data());
    const auto object = nlohmann::json::parse(text, text + bytes.size(), nullptr, false);
    if (!object.is_object() || !is_number(object, "version") || !is_number(object, "first_fragment") ||
        !is_number(object, "last_fragment"))
        return fail(name + ": byte 0: expected a JSON object with version, first_fragment, last_fragment");
    if (object["version"] != major_version)
        return fail(name + ": /version is " + object["version"].dump() + ", expected " +
                    std::to_string(major_version) + ": read it with the release that wrote it");
    const Sync sync{object["first_fragment"].get<std::uint32_t>(),
                    object["last_fragment"].get<std::uint32_t>()};
    if (sync.first > sync.last) return fail(name + ": /first_fragment: expected at most /last_fragment");
    return sync;
}

}  // namespace camdir::recording
