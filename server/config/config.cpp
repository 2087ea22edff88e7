#include "config/config.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

#include "base/file.hpp"
#include "base/utf8.hpp"
#include "config/json_text.hpp"
#include "config/keys.hpp"
#include "config/spelling.hpp"
#include "direction/editor.hpp"

namespace camdir::config {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

constexpr std::size_t max_profile_name = 31;  // ObserverRequest.profile
constexpr std::size_t max_rules = 64;

// The validation errors of a file, in its order.
class ValidationErrors {
  public:
    void add(const std::string& pointer, const json& value, const std::string& expected) {
        std::string shown = value.dump(-1, ' ', true, json::error_handler_t::replace);
        if (shown.size() > max_shown) shown = shown.substr(0, max_shown) + "...";
        add(pointer + ": " + shown + ": expected " + expected);
    }
    void add(std::string line) {
        if (lines_.size() < max_lines)
            lines_.push_back(std::move(line));
        else
            ++left_out_;
    }

    [[nodiscard]] bool none() const { return lines_.empty(); }
    [[nodiscard]] std::size_t count() const { return lines_.size() + left_out_; }
    // Each line begins with `prefix`.
    [[nodiscard]] std::string joined(const std::string& prefix, const std::string& separator) const {
        std::string all;
        for (const std::string& line : lines_)
            all += (all.empty() ? "" : separator) + prefix + line;
        if (left_out_ > 0) all += separator + prefix + "errors left out: " + std::to_string(left_out_);
        return all;
    }

  private:
    static constexpr std::size_t max_shown = 60;
    static constexpr std::size_t max_lines = 40;
    std::vector<std::string> lines_;
    std::size_t left_out_ = 0;
};

// RFC 6901, but that a terminal cannot be commanded by it, and that it is not longer than people read.
std::string escaped(const std::string& token) {
    constexpr std::size_t longest = 60;
    const std::string shown = printable(token);
    std::string result;
    for (const char c : shown.substr(0, utf8_prefix(shown, longest))) {
        if (c == '~')
            result += "~0";
        else if (c == '/')
            result += "~1";
        else
            result += c;
    }
    return shown.size() > longest ? result + "..." : result;
}

std::vector<std::string> names_in(const std::string& section) {
    std::vector<std::string> names;
    for (const Key& key : keys())
        if (key.section == section) names.push_back(key.name);
    return names;
}

const Key* find_key(const std::string& section, const std::string& name) {
    const auto found = std::find_if(keys().begin(), keys().end(), [&](const Key& key) {
        return key.section == section && key.name == name;
    });
    return found == keys().end() ? nullptr : &*found;
}

std::string suggestion(const std::string& name, const std::vector<std::string>& known) {
    const std::string near = nearest_spelling(name, known);
    return near.empty() ? std::string() : ", did you mean \"" + printable(near) + "\"?";
}

std::string unknown_key(const std::string& name, const std::vector<std::string>& known) {
    if (const std::string near = suggestion(name, known); !near.empty()) return "unknown key" + near;
    std::string text = "unknown key";
    for (const std::string& one : known)
        text += (&one == &known.front() ? ", expected one of " : ", ") + one;
    return text;
}

// What took the place of a key of earlier versions; empty where there was none.
std::string successor(const std::string& place) {
    static const std::map<std::string, std::string> successors = {
        {"/matches/automatic_hold_s", "/direction/minimum_shot_s"},
        {"/matches/automatic_lead", "/direction/cut"},
        {"/matches/automatic_half_life_s", "/direction/half_life_s"},
    };
    const auto found = successors.find(place);
    return found == successors.end() ? "" : found->second;
}

void read_object(const std::string& section, const std::string& pointer, const json& object,
                 const Target& target, ValidationErrors& errors) {
    if (!object.is_object()) return errors.add(pointer, object, "an object");
    for (const auto& [name, value] : object.items()) {
        const std::string place = pointer + "/" + escaped(name);
        const Key* key = find_key(section, name);
        if (const std::string use = successor(place); !use.empty())
            errors.add(place + ": no longer a key: use " + use);
        else if (key == nullptr)
            errors.add(place + ": " + unknown_key(name, names_in(section)));
        else if (!assign(*key, value, target))
            errors.add(place, value, expected(*key));
    }
    for (const Key& key : keys())
        if (key.section == section && key.required && !object.contains(key.name))
            errors.add(pointer + "/" + key.name + ": missing: expected " + expected(key));
}

// An absolute form of a path in a configuration in `folder`, the same for every spelling.
std::string normal(const fs::path& folder, const std::string& path) {
    const fs::path named = folder / path;
    // A working directory may be gone: then it is asked for only where it matters.
    return (named.is_absolute() ? named : fs::current_path() / named).lexically_normal().string();
}

// The files of the maps' sources, and the archives that may hold them: `archive.pk3` of
// `archive.pk3:maps/name.bsp`.
std::set<std::string> source_files(const std::vector<Map>& maps, const fs::path& folder) {
    std::set<std::string> files;
    for (const Map& map : maps) {
        if (map.source.empty()) continue;
        files.insert(normal(folder, map.source));
        for (std::size_t colon = map.source.find(':'); colon != std::string::npos;
             colon = map.source.find(':', colon + 1))
            files.insert(normal(folder, map.source.substr(0, colon)));
    }
    return files;
}

void read_maps(const json& list, Config& config, ValidationErrors& errors) {
    if (!list.is_array()) return errors.add("/maps", list, "a list of objects");
    std::set<std::string> names;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string pointer = "/maps/" + std::to_string(i);
        Map map;
        read_object("/maps/*", pointer, list[i], {nullptr, &map, nullptr}, errors);
        if (!map.name.empty() && !names.insert(map.name).second)
            errors.add(pointer + "/name", map.name, "a name that no other map has");
        config.maps.push_back(std::move(map));
    }
}

// A bake overwrites `file`, which therefore must not be a source.
void check_files(const Config& config, const fs::path& folder, ValidationErrors& errors) {
    const std::set<std::string> sources = source_files(config.maps, folder);
    std::set<std::string> files;
    for (std::size_t i = 0; i < config.maps.size(); ++i) {
        const std::string& file = config.maps[i].file;
        const std::string pointer = "/maps/" + std::to_string(i) + "/file";
        if (file.empty()) continue;
        if (!files.insert(normal(folder, file)).second)
            errors.add(pointer, file, "a file that no other map has");
        if (sources.contains(normal(folder, file)))
            errors.add(pointer, file, "a file that is not a map's source");
    }
}

void read_profiles(const json& object, Config& config, ValidationErrors& errors) {
    if (!object.is_object()) return errors.add("/profiles", object, "an object of profiles by name");
    for (const auto& [name, value] : object.items()) {
        const std::string pointer = "/profiles/" + escaped(name);
        if (name.empty() || name.size() > max_profile_name)
            errors.add(pointer, name, "a name of 1 to " + std::to_string(max_profile_name) + " bytes");
        read_object("/profiles/*", pointer, value, {nullptr, nullptr, &config.profiles[name]}, errors);
    }
}

// Such a name is a field of a table of shots.
bool is_rule_name(const std::string& name) {
    const auto breaks_a_table = [](char c) {
        return c == ',' || c == '"' || static_cast<unsigned char>(c) < ' ' || c == '\x7f';
    };
    return !name.empty() && name.size() <= max_profile_name && std::ranges::none_of(name, breaks_a_table);
}

std::vector<std::string> names_of(const std::vector<direction::Rule>& rules) {
    std::vector<std::string> names;
    std::ranges::transform(rules, std::back_inserter(names), &direction::Rule::name);
    return names;
}

// Limits of sight that would be ignored.
void check_rule(const direction::Rule& rule, const std::string& pointer, const json& value,
                ValidationErrors& errors) {
    if (rule.trigger == direction::Trigger::sight) return;
    for (const char* key : {"range", "facing"})
        if (value.contains(key))
            errors.add(pointer + "/" + key, value[key],
                       "nothing, for the trigger of the rule is not \"sight\"");
}

void read_moments(const json& object, direction::Rules& rules, ValidationErrors& errors) {
    if (!object.is_object()) return errors.add("/moments", object, "an object of rules by name");
    for (const auto& [name, value] : object.items()) {
        const std::string pointer = "/moments/" + escaped(name);
        const std::size_t errors_before = errors.count();
        if (!is_rule_name(name))
            errors.add(pointer, name,
                       "a name of 1 to " + std::to_string(max_profile_name) +
                           " bytes without commas, quotation marks and control characters");
        if (direction::is_reason_without_moment(name))
            errors.add(pointer, name, "another name: the director's own reasons have this one");
        auto rule = std::ranges::find(rules.moments, name, &direction::Rule::name);
        if (rule == rules.moments.end()) {
            if (value.is_object() && !value.contains("trigger"))
                errors.add(pointer + "/trigger: missing: expected " +
                           expected(*find_key("/moments/*", "trigger")) + ", for no such rule ships" +
                           suggestion(name, names_of(rules.moments)));
            rule = rules.moments.insert(rule, direction::Rule{.name = name});
        }
        read_object("/moments/*", pointer, value, {nullptr, nullptr, nullptr, &*rule}, errors);
        if (errors.count() == errors_before) check_rule(*rule, pointer, value, errors);
    }
    if (rules.moments.size() > max_rules)
        errors.add("/moments: " + std::to_string(rules.moments.size()) +
                   " rules with those that ship, expected at most " + std::to_string(max_rules));
}

// [min, max] of a number, a list of its choices of a string; errors are added, and nothing is stored then.
void read_override(const Key& key, const std::string& pointer, const json& value, OverrideRanges& ranges,
                   ValidationErrors& errors) {
    const auto numbers = [&] {
        return value.size() == 2 && value[0].is_number() && value[1].is_number() && key.minimum <= value[0] &&
               value[0] <= value[1] && value[1] <= key.maximum;
    };
    const auto choices = [&] {
        return !value.empty() && std::all_of(value.begin(), value.end(), [&](const json& choice) {
            return std::find(key.choices.begin(), key.choices.end(), choice) != key.choices.end();
        });
    };
    const bool of_numbers = key.choices.empty();
    if (!value.is_array() || !(of_numbers ? numbers() : choices()))
        errors.add(pointer, value,
                   of_numbers ? "[min, max], each " + expected(key) : "a list, each " + expected(key));
    else if (of_numbers)
        ranges[key.name] = {value[0].get<double>(), value[1].get<double>(), {}};
    else
        ranges[key.name] = {0.0, 0.0, value.get<std::vector<std::string>>()};
}

void read_overrides(const json& object, Config& config, ValidationErrors& errors) {
    if (!object.is_object()) return errors.add("/overrides", object, "an object of ranges by key");
    OverrideRanges& ranges = config.overrides.emplace();
    for (const auto& [name, value] : object.items()) {
        const std::string pointer = "/overrides/" + escaped(name);
        if (const Key* key = find_key("/profiles/*", name))
            read_override(*key, pointer, value, ranges, errors);
        else
            errors.add(pointer + ": " + unknown_key(name, names_in("/profiles/*")));
    }
}

// Whether a key's valid value lies within what may be overridden.
void check_override(const std::string& name, const json& value, const OverrideRanges& ranges,
                    ValidationErrors& errors) {
    const auto range = ranges.find(name);
    if (range == ranges.end()) {
        std::string known;
        for (const auto& [key, allowed] : ranges)
            known += (known.empty() ? "" : ", ") + key;
        return errors.add("/" + name +
                          ": may not be overridden here; may be: " + (known.empty() ? "nothing" : known));
    }
    const auto& [min, max, choices] = range->second;
    if (!value.is_number()) {
        if (std::find(choices.begin(), choices.end(), value) != choices.end()) return;
        return errors.add("/" + name, value, "one of " + json(choices).dump() + ", the choice here");
    }
    if (value < min || max < value)
        errors.add("/" + name, value,
                   "a number from " + json(min).dump() + " to " + json(max).dump() + ", the range here");
}

void read_section(const std::string& name, const json& value, Config& config, ValidationErrors& errors) {
    const std::string pointer = "/" + name;
    if (pointer == "/maps") return read_maps(value, config, errors);
    if (pointer == "/profiles") return read_profiles(value, config, errors);
    if (pointer == "/moments") return read_moments(value, config.direction, errors);
    if (pointer == "/overrides") return read_overrides(value, config, errors);
    read_object(pointer, pointer, value, {&config, nullptr, nullptr}, errors);
}

void read_root(const json& root, Config& config, ValidationErrors& errors) {
    if (!root.is_object()) return errors.add("", root, "an object");
    std::vector<std::string> known;
    for (const Section& section : sections())
        known.push_back(section.pointer.substr(1));
    for (const auto& [name, value] : root.items()) {
        if (std::find(known.begin(), known.end(), name) != known.end())
            read_section(name, value, config, errors);
        else
            errors.add("/" + escaped(name) + ": " + unknown_key(name, known));
    }
}

void check_shards(const Dds& dds, ValidationErrors& errors) {
    if (dds.shards.empty() != dds.shard.empty())
        errors.add("/dds/shard", dds.shard,
                   dds.shards.empty() ? "an empty string where there are no shards"
                                      : "the name of this director's shard");
    std::vector<std::string> names = dds.shards;
    std::ranges::sort(names);
    if (std::ranges::adjacent_find(names) != names.end())
        errors.add("/dds/shards", dds.shards, "names that differ");
}

void check_references(const Config& config, ValidationErrors& errors) {
    if (errors.none()) check_shards(config.dds, errors);
    if (!config.profiles.contains(config.matches.default_profile))
        errors.add("/matches/default_profile", config.matches.default_profile, "the name of a profile");
}

void resolve_paths(Config& config, const fs::path& folder) {
    if (!config.dds.security.empty()) config.dds.security = (folder / config.dds.security).string();
    if (!config.http.token_file.empty()) config.http.token_file = (folder / config.http.token_file).string();
    if (!config.http.page.empty()) config.http.page = (folder / config.http.page).string();
    if (!config.recording.folder.empty())
        config.recording.folder = (folder / config.recording.folder).string();
    for (Map& map : config.maps) {
        map.file = (folder / map.file).string();
        if (!map.source.empty()) map.source = (folder / map.source).string();
    }
}

}  // namespace

Result<Config> parse(const std::string& text, const std::string& name, const fs::path& folder,
                     const std::string& shard) {
    const auto root = parse_json(text);
    if (!root) return fail(name + ": " + root.error().message);
    Config config;
    for (const auto& [profile_name, use, profile] : camera::shipped_profiles())
        config.profiles.emplace(profile_name, profile);
    ValidationErrors errors;
    read_root(*root, config, errors);
    if (!shard.empty()) config.dds.shard = shard;
    check_references(config, errors);
    check_files(config, folder, errors);
    if (!errors.none()) return fail(errors.joined(name + ": ", "\n"));
    resolve_paths(config, folder);
    return config;
}

Result<Config> load(const fs::path& file, const std::string& shard) {
    const auto bytes = read_file(file);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse({reinterpret_cast<const char*>(bytes->data()), bytes->size()}, file.string(),
                 file.parent_path(), shard);
}

Result<camera::Profile> override_profile(const camera::Profile& base, const std::string& overrides,
                                         const std::optional<OverrideRanges>& ranges) {
    camera::Profile profile = base;
    if (overrides.empty()) return profile;
    const auto object = parse_json(overrides);
    if (!object) return fail(object.error().message);
    ValidationErrors errors;
    read_object("/profiles/*", "", *object, {nullptr, nullptr, &profile}, errors);
    if (ranges && errors.none())
        for (const auto& [name, value] : object->items())
            check_override(name, value, *ranges, errors);
    if (!errors.none()) return fail(errors.joined("", "; "));
    return profile;
}

std::vector<std::string> changes_for_restart(const Config& running, const Config& loaded) {
    Config before = running;
    Config after = loaded;
    std::vector<std::string> changed;
    for (const Key& key : keys()) {
        if (key.reloads) continue;
        if (value_of(key, {&before, nullptr, nullptr}) != value_of(key, {&after, nullptr, nullptr}))
            changed.push_back(key.section + "/" + key.name);
    }
    return changed;
}

void reload(Config& running, Config loaded) {
    running.dds.shard = std::move(loaded.dds.shard);
    running.dds.shards = std::move(loaded.dds.shards);
    running.maps = std::move(loaded.maps);
    running.profiles = std::move(loaded.profiles);
    running.overrides = std::move(loaded.overrides);
    running.matches = loaded.matches;
    running.direction = std::move(loaded.direction);
    running.log.level = std::move(loaded.log.level);
}

}  // namespace camdir::config
