// The schema and the reference page, generated from the table of keys.
#include <charconv>

#include "camera/profile.hpp"
#include "config/keys.hpp"

namespace camdir::config {
namespace {

using ordered = nlohmann::ordered_json;

std::string described(const Key& key) {
    return key.unit.empty() ? key.help : key.help + " [" + key.unit + "]";
}

ordered key_schema(const Key& key) {
    const std::string type = type_name(key);
    ordered schema = {{"description", described(key)}};
    if (type == "integer" || type == "number") {
        schema["type"] = type;
        ordered range = {{"minimum", key.minimum}, {"maximum", key.maximum}};
        if (key.zero_is_default)
            schema["anyOf"] = {range, {{"const", 0}}};
        else
            schema.update(range);
    } else if (type == "string") {
        schema["type"] = "string";
        if (key.minimum > 0) schema["minLength"] = static_cast<std::int64_t>(key.minimum);
        if (!key.choices.empty()) schema["enum"] = key.choices;
    } else if (type == "list of strings") {
        schema["type"] = "array";
        schema["items"] = {{"type", "string"}, {"minLength", 1}};
        schema["minItems"] = static_cast<std::int64_t>(key.minimum);
        schema["maxItems"] = static_cast<std::int64_t>(key.maximum);
    } else {
        schema["type"] = type;
    }
    if (!key.required) schema["default"] = ordered::parse(default_of(key).dump());
    return schema;
}

ordered object_schema(const std::string& section) {
    ordered properties = ordered::object();
    ordered required = ordered::array();
    for (const Key& key : keys()) {
        if (key.section != section) continue;
        properties[key.name] = key_schema(key);
        if (key.required) required.push_back(key.name);
    }
    ordered schema = {{"type", "object"}, {"additionalProperties", false}, {"properties", properties}};
    if (!required.empty()) schema["required"] = required;
    return schema;
}

// How far a key of a profile may be overridden.
ordered override_schema(const Key& key) {
    if (!key.choices.empty()) return {{"type", "array"}, {"minItems", 1}, {"items", {{"enum", key.choices}}}};
    const ordered number = {{"type", "number"}, {"minimum", key.minimum}, {"maximum", key.maximum}};
    return {{"type", "array"}, {"minItems", 2}, {"maxItems", 2}, {"items", number}};
}

ordered section_schema(const Section& section) {
    ordered schema = {{"description", section.help}};
    if (section.pointer == "/maps") {
        schema["type"] = "array";
        schema["items"] = object_schema("/maps/*");
    } else if (section.pointer == "/profiles") {
        schema["type"] = "object";
        schema["propertyNames"] = {{"minLength", 1}, {"maxLength", 31}};
        schema["additionalProperties"] = object_schema("/profiles/*");
    } else if (section.pointer == "/moments") {
        schema["type"] = "object";
        schema["propertyNames"] = {
            {"minLength", 1}, {"maxLength", 31}, {"pattern", R"(^[^,"\x00-\x1f\x7f]*$)"}};
        schema["additionalProperties"] = object_schema("/moments/*");
    } else if (section.pointer == "/overrides") {
        schema["type"] = "object";
        schema["additionalProperties"] = false;
        for (const Key& key : keys())
            if (key.section == "/profiles/*") schema["properties"][key.name] = override_schema(key);
    } else {
        schema.update(object_schema(section.pointer));
    }
    return schema;
}

std::string range_cell(const Key& key) {
    const std::string type = type_name(key);
    if (!key.choices.empty()) {
        std::string cell;
        for (const std::string& choice : key.choices)
            cell += (cell.empty() ? "`" : ", `") + choice + "`";
        return cell;
    }
    if (type == "boolean") return "";
    const auto end = [](double value) { return nlohmann::json(value).dump(); };
    const bool whole = type != "number";
    const auto text = [&](double value) {
        return whole ? std::to_string(static_cast<std::int64_t>(value)) : end(value);
    };
    const std::string of = type == "string" ? " bytes" : type == "list of strings" ? " strings" : "";
    return (key.zero_is_default ? "0, " : "") + text(key.minimum) + " .. " + text(key.maximum) + of;
}

std::string row(const Key& key) {
    const std::string initial = key.required ? "required" : "`" + default_of(key).dump() + "`";
    return "| `" + key.name + "` | " + type_name(key) + " | " + initial + " | " + range_cell(key) + " | " +
           key.unit + " | " + key.help + " |\n";
}

// What the profiles that ship change of the default's values.
std::string shipped_changes() {
    std::string list;
    for (camera::ShippedProfile shipped : camera::shipped_profiles().subspan(1)) {
        Config config;
        Map map;
        std::string changes;
        for (const Key& key : keys()) {
            if (key.section != "/profiles/*") continue;
            const nlohmann::json value = value_of(key, {&config, &map, &shipped.profile});
            if (value == default_of(key)) continue;
            changes += (changes.empty() ? "`" : ", `") + key.name + "` " + value.dump();
        }
        list += "- `" + std::string(shipped.name) + "`: " + changes + "\n";
    }
    return "The profiles that ship differ from `default` in these values:\n\n" + list + "\n";
}

std::string shipped_rules() {
    std::string list;
    for (direction::Rule& rule : direction::default_rules().moments) {
        std::string values;
        for (const Key& key : keys()) {
            if (key.section != "/moments/*") continue;
            const nlohmann::json value = value_of(key, {nullptr, nullptr, nullptr, &rule});
            if (value == default_of(key) && key.name != "trigger") continue;
            values += (values.empty() ? "`" : ", `") + key.name + "` " + value.dump();
        }
        list += "- `" + rule.name + "`: " + values + "\n";
    }
    return "The rules that ship:\n\n" + list + "\n";
}

}  // namespace

std::string schema() {
    ordered properties = ordered::object();
    for (const Section& section : sections())
        properties[section.pointer.substr(1)] = section_schema(section);
    const ordered schema = {{"$schema", "https://json-schema.org/draft/2020-12/schema"},
                            {"title", "Configuration of camera-director serve"},
                            {"type", "object"},
                            {"additionalProperties", false},
                            {"properties", properties}};
    return schema.dump(2) + "\n";
}

std::string reference() {
    std::string page;
    for (const Section& section : sections()) {
        const bool list =
            section.pointer == "/maps" || section.pointer == "/profiles" || section.pointer == "/moments";
        page += "## `" + section.pointer.substr(1) + "`\n\n" + section.help + "\n\n";
        std::string rows;
        for (const Key& key : keys())
            if (key.section == section.pointer + (list ? "/*" : "")) rows += row(key);
        if (rows.empty()) continue;
        page +=
            "| key | type | default | range | unit | meaning |\n|---|---|---|---|---|---|\n" + rows + "\n";
        if (section.pointer == "/profiles") page += shipped_changes();
        if (section.pointer == "/moments") page += shipped_rules();
    }
    return page;
}

}  // namespace camdir::config
