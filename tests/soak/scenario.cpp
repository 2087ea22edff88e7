#include "scenario.hpp"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <utility>
#include <variant>

#include "base/file.hpp"
#include "config/json_text.hpp"
#include "config/spelling.hpp"

namespace camdir::soak {
namespace {

using nlohmann::json;

constexpr std::array<std::pair<const char*, ActKind>, 16> act_names{{
    {"kill", ActKind::kill},
    {"terminate", ActKind::terminate},
    {"pause", ActKind::pause},
    {"hand_over", ActKind::hand_over},
    {"reload", ActKind::reload},
    {"slow_observer", ActKind::slow_observer},
    {"flapping_match", ActKind::flapping_match},
    {"unknown_map", ActKind::unknown_map},
    {"wrong_hash", ActKind::wrong_hash},
    {"garbage_poses", ActKind::garbage_poses},
    {"backward_time", ActKind::backward_time},
    {"usurper", ActKind::usurper},
    {"flood_observers", ActKind::flood_observers},
    {"flood_matches", ActKind::flood_matches},
    {"passing_matches", ActKind::passing_matches},
    {"crowd", ActKind::crowd},
}};
constexpr std::array<std::pair<const char*, Role>, 2> role_names{
    {{"leader", Role::leader}, {"standby", Role::standby}}};

struct Key {
    const char* name;
    std::variant<double*, std::int64_t*, ActKind*, Role*> value;
    double minimum = 0.0, maximum = 0.0;  // of a number
    bool required = false;
};

template <class Names>
std::string listed(const Names& names) {
    std::string list;
    for (const auto& [name, value] : names)
        list += (list.empty() ? "one of \"" : ", \"") + std::string(name) + '"';
    return list;
}

std::string expected(const Key& key) {
    if (std::holds_alternative<ActKind*>(key.value)) return listed(act_names);
    if (std::holds_alternative<Role*>(key.value)) return listed(role_names);
    const bool whole = std::holds_alternative<std::int64_t*>(key.value);
    return (whole ? "an integer from " : "a number from ") + json(key.minimum).dump() + " to " +
           json(key.maximum).dump();
}

template <class T>
bool assign_number(const Key& key, const json& value, T& to) {
    const bool is_type = std::is_integral_v<T> ? value.is_number_integer() : value.is_number();
    if (!is_type || value < key.minimum || value > key.maximum) return false;
    to = value.get<T>();
    return true;
}

template <class Names, class T>
bool assign_name(const Names& names, const json& value, T& to) {
    const auto found = std::ranges::find_if(names, [&](const auto& name) { return value == name.first; });
    if (found == names.end()) return false;
    to = found->second;
    return true;
}

bool assign(const Key& key, const json& value) {
    struct Assignment {
        const Key& key;
        const json& value;
        bool operator()(double* to) const { return assign_number(key, value, *to); }
        bool operator()(std::int64_t* to) const { return assign_number(key, value, *to); }
        bool operator()(ActKind* to) const { return assign_name(act_names, value, *to); }
        bool operator()(Role* to) const { return assign_name(role_names, value, *to); }
    };
    return std::visit(Assignment{key, value}, key.value);
}

std::vector<Key> keys_of(Scenario& to) {
    return {{"seed", &to.seed, 0, 4294967295},  {"seconds", &to.seconds, 1, 1e7},
            {"settle_s", &to.settle_s, 2, 1e4}, {"warm_up_s", &to.warm_up_s, 0, 1e6},
            {"directors", &to.directors, 1, 2}, {"matches", &to.matches, 1, 64},
            {"players", &to.players, 1, 64},    {"observers", &to.observers, 1, 64},
            {"rate_hz", &to.rate_hz, 1, 240},   {"delay_s", &to.delay_s, 0, 120}};
}

std::vector<Key> keys_of(Act& to) {
    return {{"act", &to.kind, 0, 0, true},    {"at_s", &to.at_s, 0, 1e7, true},
            {"every_s", &to.every_s, 0, 1e7}, {"for_s", &to.for_s, 0.1, 1e7},
            {"director", &to.director},       {"count", &to.count, 1, 1e9},
            {"batch", &to.batch, 1, 256}};
}

class Errors {
  public:
    void add(const std::string& pointer, const std::string& problem) {
        text_ += (text_.empty() ? "" : "\n") + pointer + ": " + problem;
    }
    [[nodiscard]] const std::string& text() const { return text_; }

  private:
    std::string text_;
};

std::string unknown(const std::string& name, const std::vector<Key>& keys) {
    std::vector<std::string> names;
    for (const Key& key : keys)
        names.emplace_back(key.name);
    const std::string near = config::nearest_spelling(name, names);
    return "unknown key" + (near.empty() ? std::string() : ", did you mean \"" + near + "\"?");
}

// All keys of `object` but `other`.
void read_object(const std::string& pointer, const json& object, const std::vector<Key>& keys,
                 const std::string& other, Errors& errors) {
    for (const auto& [name, value] : object.items()) {
        if (name == other) continue;
        const auto key = std::ranges::find_if(keys, [&](const Key& k) { return name == k.name; });
        const std::string place = pointer + "/" + name;
        if (key == keys.end())
            errors.add(place, unknown(name, keys));
        else if (!assign(*key, value))
            errors.add(place, value.dump(-1, ' ', true, json::error_handler_t::replace) + ": expected " +
                                  expected(*key));
    }
    for (const Key& key : keys)
        if (key.required && !object.contains(key.name))
            errors.add(pointer + "/" + key.name, "missing: expected " + expected(key));
}

void read_acts(const json& list, Scenario& scenario, Errors& errors) {
    if (!list.is_array()) return errors.add("/acts", "expected a list of objects");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const std::string pointer = "/acts/" + std::to_string(i);
        Act& act = scenario.acts.emplace_back();
        if (!list[i].is_object()) {
            errors.add(pointer, "expected an object");
            continue;
        }
        read_object(pointer, list[i], keys_of(act), "", errors);
        if (act.director == Role::standby && scenario.directors < 2)
            errors.add(pointer + "/director", "\"standby\": expected \"leader\", the only director");
        if (act.kind == ActKind::hand_over && scenario.directors < 2)
            errors.add(pointer + "/act", "\"hand_over\": expected two directors");
    }
}

}  // namespace

std::string name_of(ActKind kind) {
    return std::ranges::find(act_names, kind, &std::pair<const char*, ActKind>::second)->first;
}

bool is_done_to_director(ActKind kind) {
    return kind <= ActKind::reload;
}

Result<Scenario> parse_scenario(const std::string& text) {
    const auto parsed = config::parse_json(text);
    if (!parsed) return tl::unexpected(parsed.error());
    if (!parsed->is_object()) return fail("expected an object");
    Scenario scenario;
    Errors errors;
    read_object("", *parsed, keys_of(scenario), "acts", errors);
    if (parsed->contains("acts")) read_acts((*parsed)["acts"], scenario, errors);
    if (!errors.text().empty()) return fail(errors.text());
    return scenario;
}

Result<Scenario> read_scenario(const std::filesystem::path& file) {
    const auto content = read_file(file);
    if (!content) return tl::unexpected(content.error());
    auto scenario =
        parse_scenario(std::string(reinterpret_cast<const char*>(content->data()), content->size()));
    if (!scenario) return fail(file.string() + ": " + scenario.error().message);
    return scenario;
}

}  // namespace camdir::soak
