// The one table of the configuration's keys.
#pragma once

#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <variant>
#include <vector>

#include "config/config.hpp"

namespace camdir::config {

// Where a key's value is stored: the configuration, a map of its list, a profile, or a rule.
struct Target {
    Config* config = nullptr;
    Map* map = nullptr;
    camera::Profile* profile = nullptr;
    direction::Rule* rule = nullptr;
};

template <class T>
using Slot = std::function<T&(const Target&)>;

struct Key {
    std::string section;  // JSON pointer, "*" stands for any index or name: "/dds", "/maps/*", "/profiles/*",
                          // "/moments/*"
    std::string name;
    std::variant<Slot<bool>, Slot<std::int64_t>, Slot<double>, Slot<float>, Slot<std::string>,
                 Slot<std::vector<std::string>>, Slot<camera::Solver>, Slot<direction::Trigger>>
        slot;
    std::string help;
    std::string unit = {};
    // Range of a number's value, of a string's size in bytes, of a list's number of entries.
    double minimum = std::numeric_limits<double>::lowest();
    double maximum = std::numeric_limits<double>::max();
    std::vector<std::string> choices = {};  // of a string; empty: any
    bool required = false;
    bool reloads = false;          // takes effect on SIGHUP
    bool zero_is_default = false;  // of a number: 0, below the minimum, is accepted and is the default
};

// In the order of the documentation, grouped by section.
[[nodiscard]] const std::vector<Key>& keys();

struct Section {
    std::string pointer;
    std::string help;
};
[[nodiscard]] const std::vector<Section>& sections();

// The value in `target` as JSON.
[[nodiscard]] nlohmann::json value_of(const Key& key, const Target& target);

// The value of a key that is not given.
[[nodiscard]] nlohmann::json default_of(const Key& key);

// Stores a JSON value in the target. False when it is not of the key's type or range; nothing is stored then.
[[nodiscard]] bool assign(const Key& key, const nlohmann::json& value, const Target& target);

// "an integer from 0 to 230"
[[nodiscard]] std::string expected(const Key& key);

// "boolean", "integer", "number", "string", "list of strings"
[[nodiscard]] std::string type_name(const Key& key);

}  // namespace camdir::config
