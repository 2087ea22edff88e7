#include "config/keys.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <type_traits>

namespace camdir::camera {

NLOHMANN_JSON_SERIALIZE_ENUM(Solver, {{Solver::paper, "paper"}, {Solver::planner, "planner"}})

}  // namespace camdir::camera

namespace camdir::direction {

NLOHMANN_JSON_SERIALIZE_ENUM(Trigger, {{Trigger::sight, "sight"},
                                       {Trigger::exchange, "exchange"},
                                       {Trigger::kill, "kill"},
                                       {Trigger::killer, "killer"},
                                       {Trigger::multi_kill, "multi_kill"},
                                       {Trigger::flag_taken, "flag_taken"},
                                       {Trigger::flag_captured, "flag_captured"},
                                       {Trigger::objective, "objective"},
                                       {Trigger::award, "award"},
                                       {Trigger::item, "item"},
                                       {Trigger::round_won, "round_won"},
                                       {Trigger::spawn, "spawn"},
                                       {Trigger::streak, "streak"},
                                       {Trigger::flag_run, "flag_run"},
                                       {Trigger::lead, "lead"},
                                       {Trigger::last_alive, "last_alive"}})

}  // namespace camdir::direction

namespace camdir::config {
namespace {

using nlohmann::json;

constexpr double largest_id = 9007199254740991.0;  // every JSON reader keeps it exactly

// The double whose shortest decimal form is the float's: 0.1F becomes 0.1.
double shortest(float value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    double result = 0.0;
    std::from_chars(text.data(), end.ptr, result);
    return result;
}

template <class Group, class T>
Slot<T> in(Group Config::*group, T Group::*member) {
    return [=](const Target& target) -> T& { return target.config->*group.*member; };
}

template <class T>
Slot<T> in_map(T Map::*member) {
    return [=](const Target& target) -> T& { return target.map->*member; };
}

template <class T>
Slot<T> in_profile(T camera::Profile::*member) {
    return [=](const Target& target) -> T& { return target.profile->*member; };
}

void add_dds(std::vector<Key>& table) {
    const std::string section = "/dds";
    const auto slot = [](auto member) { return in(&Config::dds, member); };
    table.push_back({section, "domain", slot(&Dds::domain), "DDS domain.", "", 0, 230});
    table.push_back({section, "interface", slot(&Dds::interface),
                     "Network interface, by name or address; empty: Cyclone DDS chooses.", "", 0, 255});
    table.push_back({section, "multicast", slot(&Dds::multicast),
                     "Uses multicast for discovery; without it only `peers` and processes that know this "
                     "director's address are found."});
    table.push_back(
        {section, "participant_index", slot(&Dds::participant_index),
         "Fixes the ports, so that others can name this director as their peer. Each process of a host "
         "and domain needs its own index; -1: any free ports.",
         "", -1, 119});
    table.push_back({section, "port", slot(&Dds::port), "Base port of the domain's ports.", "", 1024, 60000});
    table.push_back({section, "peers", slot(&Dds::peers),
                     "Addresses (`host` or `host:port`) that are contacted by unicast, for example other "
                     "directors: those that serve the same matches must know each other. A name that cannot "
                     "be resolved at start is an error.",
                     "", 0, 1024});
    table.push_back({section, "partitions", slot(&Dds::partitions),
                     "Patterns of the partitions in which matches are discovered.", "", 1, 64});
    table.push_back({section, "director_id", slot(&Dds::director_id),
                     "Sent with every camera frame; 0: chosen at random at start.", "", 0, largest_id});
    table.push_back({section, "strength", slot(&Dds::strength),
                     "Of several directors that begin a match together, the strongest leads it. One that "
                     "comes later stands "
                     "by, however strong it is.",
                     "", 0, 65535});
    table.push_back({section, "lease_ms", slot(&Dds::lease_ms),
                     "Time after which a director that hangs or has died is replaced by its standby.", "ms",
                     20, 60000});
    table.push_back({section,
                     "shards",
                     slot(&Dds::shards),
                     "Names of the shards over which the domain's matches are spread; empty: every director "
                     "serves every match.",
                     "",
                     0,
                     1024,
                     {},
                     false,
                     true});
    table.push_back({section,
                     "shard",
                     slot(&Dds::shard),
                     "This director's shard. One that is not among `shards` hands all its matches over.",
                     "",
                     0,
                     255,
                     {},
                     false,
                     true});
    table.push_back(
        {section, "security", slot(&Dds::security),
         "DDS Security: the folder of this director's identity, which `deploy/security/authority.sh` makes. "
         "Empty: plain DDS. Relative paths start at the configuration's folder.",
         "", 0, 4095});
    table.push_back({section, "insecure", slot(&Dds::insecure),
                     "Allows plain DDS to leave loopback, on a network that strangers do not reach: whoever "
                     "does can take matches and read every player's position."});
    table.push_back(
        {section, "xml", slot(&Dds::xml),
         "Cyclone DDS configuration (XML) that replaces interface, multicast, participant_index, port and "
         "peers; for tuning. Counts as leaving loopback.",
         "", 0, 65536});
}

void add_http(std::vector<Key>& table) {
    const std::string section = "/http";
    const auto slot = [](auto member) { return in(&Config::http, member); };
    table.push_back(
        {section, "enabled", slot(&Http::enabled),
         "Serves /-/healthy, /-/ready, /metrics, /status, /broadcast, /hand-over, and the page at /."});
    table.push_back({section, "address", slot(&Http::address),
                     "Address to listen on. One that other hosts reach needs a `token_file`.", "", 1, 255});
    table.push_back(
        {section, "port", slot(&Http::port), "Port; 0: any free one, which the log names.", "", 0, 65535});
    table.push_back(
        {section, "token_file", slot(&Http::token_file),
         "File with the token that requests carry as `Authorization: Bearer TOKEN`; not open to everyone. "
         "Its content is read again on SIGHUP. Relative paths start at the configuration's folder.",
         "", 0, 4095});
    table.push_back(
        {section, "hosts", slot(&Http::hosts),
         "Names by which proxies ask, where the address is a loopback one: requests for other hosts "
         "than this one's names are refused.",
         "", 0, 255});
    table.push_back({section, "match_metrics", slot(&Http::match_metrics),
                     "Matches that have metrics of their own, with the label `match`: as many of those that "
                     "began first. 0: none.",
                     "", 0, 4096});
    table.push_back(
        {section, "viewers", slot(&Http::viewers),
         "Viewers of the page at `/`, at most. One more sees the match's broadcast where it is recorded, "
         "else the page tries again.",
         "", 0, 4096});
    table.push_back(
        {section, "page", slot(&Http::page),
         "Folder of the page's files; empty: `../share/camera-director/page` from the program's folder. "
         "Relative paths start at the configuration's folder.",
         "", 0, 4095});
}

void add_recording(std::vector<Key>& table) {
    const std::string section = "/recording";
    const auto slot = [](auto member) { return in(&Config::recording, member); };
    table.push_back({section, "folder", slot(&Recording::folder),
                     "Folder for the recordings, each in a folder of its own; only one director may use it. "
                     "Empty: nothing is recorded. Relative paths start at the configuration's folder.",
                     "", 0, 4095});
    table.push_back({section, "disk_mib", slot(&Recording::disk_mib),
                     "Disk for all recordings. Beyond it the oldest that have ended are removed, then the "
                     "oldest parts of the others.",
                     "MiB", 16, 1'000'000'000});
    table.push_back({section, "match_mib", slot(&Recording::match_mib),
                     "Disk for each recording. Beyond it its oldest parts are removed.", "MiB", 1,
                     1'000'000'000});
}

void add_maps(std::vector<Key>& table) {
    const std::string section = "/maps/*";
    table.push_back({section,
                     "name",
                     in_map(&Map::name),
                     "The name that game servers send in MatchInfo.",
                     "",
                     1,
                     255,
                     {},
                     true,
                     true});
    table.push_back({section,
                     "file",
                     in_map(&Map::file),
                     "The baked map, MAP.vfs. Relative paths start at the configuration's folder.",
                     "",
                     1,
                     4095,
                     {},
                     true,
                     true});
    table.push_back(
        {section,
         "source",
         in_map(&Map::source),
         "The map's file, or `archive.pk3:maps/name.bsp`: a BSP, a mesh or a point cloud. When given, `file` "
         "is baked from it at start, or by `bake --config`, if it is missing, damaged, or was baked from "
         "other bytes or with other parameters.",
         "",
         0,
         4095,
         {},
         false,
         true});
    table.push_back({section,
                     "d0",
                     in_map(&Map::d0),
                     "Sampling distance of the bake: openings narrower than about one and a half times this "
                     "are closed. 0: 16, or the points' spacing for a point cloud.",
                     "0.0254 m",
                     min_d0,
                     max_d0,
                     {},
                     false,
                     true,
                     true});
    table.push_back({section,
                     "metres_per_unit",
                     in_map(&Map::metres_per_unit),
                     "Length of a unit of the source; 0: 0.0254 for a BSP, 1 for a mesh or a point cloud.",
                     "m",
                     min_metres_per_unit,
                     max_metres_per_unit,
                     {},
                     false,
                     true,
                     true});
    table.push_back({section,
                     "up",
                     in_map(&Map::up),
                     "Axis of a mesh or a point cloud that points up; empty: y for glTF, else z.",
                     "",
                     0,
                     1,
                     {"", "y", "z"},
                     false,
                     true});
    table.push_back({section,
                     "origin",
                     in_map(&Map::origin),
                     "`x,y,z` of a mesh or a point cloud, in its own axes, that becomes 0,0,0.",
                     "",
                     0,
                     255,
                     {},
                     false,
                     true});
    table.push_back({section,
                     "seeds",
                     in_map(&Map::seeds),
                     "Points `x,y,z` in the free space, in map units with z up, in addition to the source's "
                     "spawn points. Without seeds and spawn points the largest connected part is baked.",
                     "",
                     0,
                     256,
                     {},
                     false,
                     true});
    table.push_back({section,
                     "sampling",
                     in_map(&Map::sampling),
                     "Sampling of the bake: `adaptive`, sparse where the free space is wide, or `uniform`.",
                     "",
                     0,
                     255,
                     {"adaptive", "uniform"},
                     false,
                     true});
    table.push_back(
        {section,
         "loss",
         in_map(&Map::loss),
         "Mesh reduction of the bake: free distance that the centre of a ball may lose, in percent of "
         "the mean over the map, at most 3/2 d0; 0: no reduction.",
         "%",
         0,
         100,
         {},
         false,
         true});
    table.push_back({section,
                     "triangles",
                     in_map(&Map::triangles),
                     "The reduction ends at this many triangles; 0: at the allowed loss.",
                     "",
                     0,
                     1e9,
                     {},
                     false,
                     true});
    table.push_back({section,
                     "strict",
                     in_map(&Map::strict),
                     "Refuses matches whose map file differs from the baked one, instead of a warning.",
                     "",
                     0,
                     0,
                     {},
                     false,
                     true});
}

template <class T>
Slot<T> in_grammar(T direction::Grammar::*member) {
    return [=](const Target& target) -> T& { return target.config->direction.grammar.*member; };
}

template <class T>
Slot<T> in_rule(T direction::Rule::*member) {
    return [=](const Target& target) -> T& { return target.rule->*member; };
}

void add_direction(std::vector<Key>& table) {
    using direction::Grammar;
    const auto add = [&](const char* name, double Grammar::*member, const char* help, const char* unit,
                         double minimum, double maximum) {
        table.push_back(
            {"/direction", name, in_grammar(member), help, unit, minimum, maximum, {}, false, true});
    };
    add("minimum_shot_s", &Grammar::minimum_shot_s, "No shot is shorter.", "s", 0.4, 60);
    add("preferred_shot_s", &Grammar::preferred_shot_s,
        "The length of a piece that costs nothing: from a cut, or a jump of the camera, to the next.", "s",
        0.4, 600);
    add("maximum_shot_s", &Grammar::maximum_shot_s,
        "No shot is longer while another may follow; less than `minimum_shot_s` counts as that.", "s", 0.4,
        600);
    add("length", &Grammar::length, "Cost of a piece 2.7 times as long, or as short, as preferred.", "points",
        0, 1000);
    add("cut", &Grammar::cut, "Cost of a cut.", "points", 0, 1000);
    add("hidden", &Grammar::hidden, "Cost of a second in which a camera does not show its player.", "points",
        0, 1000);
    add("dead", &Grammar::dead, "Cost of a second on a dead player, after `beat_after_death_s`.", "points", 0,
        1000);
    add("idle", &Grammar::idle, "Cost of a second on a player who stands about.", "points", 0, 1000);
    add("inner_cut", &Grammar::inner_cut,
        "Cost of a jump of the camera within its shot, at a respawn, beside that of the pieces.", "points", 0,
        1000);
    add("beat_after_death_s", &Grammar::beat_after_death_s, "How long a death may be looked at.", "s", 0, 10);
    add("fresh", &Grammar::fresh,
        "Worth of a second, for each minute since its player was last on the air; at most two.", "points", 0,
        1000);
    add("half_life_s", &Grammar::half_life_s,
        "What is not known yet is worth what is there now, halved every so many seconds.", "s", 0.1, 60);
    add("foresight_s", &Grammar::foresight_s, "No plan goes further beyond what is known.", "s", 0, 10);
    table.push_back(
        {"/direction",
         "fixed_shots",
         in_grammar(&Grammar::fixed_shots),
         "Shows the match also through cameras of the map that stand still, where an observer leaves "
         "the choice among all players to the director.",
         "",
         0,
         0,
         {},
         false,
         true});
}

void add_moments(std::vector<Key>& table) {
    using direction::Rule;
    const std::string section = "/moments/*";
    table.push_back(
        {section,
         "trigger",
         in_rule(&Rule::trigger),
         "What begins a moment: enemies in mutual sight, wounds of two players each within `after_s` of "
         "the last, an event, a kill (`killer`: of the killer alone), one of several kills by one player, "
         "each within 3 s of the last, three kills in one life, a flag until it is captured or its carrier "
         "dies, more kills than anybody else, who lives, all others of a team dead for 5 s, while an enemy "
         "does.",
         "",
         0,
         16,
         {"sight", "exchange", "kill", "killer", "multi_kill", "flag_taken", "flag_captured", "objective",
          "award", "item", "round_won", "spawn", "streak", "flag_run", "lead", "last_alive"},
         false,
         true});
    const auto add = [&](const char* name, double Rule::*member, const char* help, const char* unit,
                         double maximum) {
        table.push_back({section, name, in_rule(member), help, unit, 0, maximum, {}, false, true});
    };
    add("before_s", &Rule::before_s, "How long before the event the moment begins.", "s", 10);
    add("after_s", &Rule::after_s, "How long after the event it ends.", "s", 10);
    add("worth", &Rule::worth,
        "Of every second in which one of its players is shown; of a `whole` moment, once.", "points", 1000);
    add("worth_both", &Rule::worth_both, "More, while both of its players are shown.", "points", 1000);
    table.push_back({section,
                     "whole",
                     in_rule(&Rule::whole),
                     "Counts only when it is shown from its begin to its end, with at most one cut, no "
                     "farther from either end than `minimum_shot_s`.",
                     "",
                     0,
                     0,
                     {},
                     false,
                     true});
    add("range", &Rule::range, "`sight`, and no other trigger: no farther apart; units of 0.0254 m.", "units",
        1e9);
    add("facing", &Rule::facing,
        "`sight`, and no other trigger: one of the two looks this near to the other.", "degrees", 180);
}

void add_profiles(std::vector<Key>& table) {
    for (const camera::ProfileKey& key : camera::profile_keys())
        table.push_back({"/profiles/*",
                         key.name,
                         in_profile(key.member),
                         key.help,
                         key.unit,
                         shortest(key.minimum),
                         shortest(key.maximum),
                         {},
                         false,
                         true});
    table.push_back(
        {"/profiles/*",
         "solver",
         in_profile(&camera::Profile::solver),
         "`paper`: the heuristic of the paper's section 5.3; `planner`: planning over the player's "
         "future, recorded or predicted.",
         "",
         0,
         16,
         {"paper", "planner"},
         false,
         true});
}

void add_matches(std::vector<Key>& table) {
    const std::string section = "/matches";
    const auto slot = [](auto member) { return in(&Config::matches, member); };
    table.push_back({section,
                     "default_profile",
                     slot(&Matches::default_profile),
                     "The profile of requests that do not name one.",
                     "",
                     1,
                     31,
                     {},
                     false,
                     true});
    table.push_back(
        {section,
         "silence_frames",
         slot(&Matches::silence_frames),
         "A match without poses for this many frames of its rate is silent: its cameras stand still.",
         "frames",
         1,
         100000,
         {},
         false,
         true});
    table.push_back({section,
                     "forget_s",
                     slot(&Matches::forget_s),
                     "A match whose game server disappeared ends after this time without poses.",
                     "s",
                     0,
                     86400,
                     {},
                     false,
                     true});
    table.push_back(
        {section,
         "minimum_delay_s",
         slot(&Matches::minimum_delay_s),
         "Delay of everything that observers receive, unless the match's own is longer. A match takes "
         "a longer one at once, a shorter one with its next epoch.",
         "s",
         0,
         120,
         {},
         false,
         true});
}

void add_limits(std::vector<Key>& table) {
    const std::string section = "/limits";
    const auto slot = [](auto member) { return in(&Config::limits, member); };
    table.push_back({section, "matches", slot(&Limits::matches), "Matches at once.", "", 1, 4096});
    table.push_back(
        {section, "players", slot(&Limits::players), "Players of a match that are tracked.", "", 1, 256});
    table.push_back({section, "observers", slot(&Limits::observers), "Observers of a match.", "", 1, 65536});
    table.push_back({section, "participant_matches", slot(&Limits::participant_matches),
                     "Matches of one DDS participant; 0: half of `matches`. Raise it where one process hosts "
                     "more of them.",
                     "", 0, 4096});
    table.push_back({section, "participant_match_rate", slot(&Limits::participant_match_rate),
                     "How fast a DDS participant may begin matches after its first `participant_matches`.",
                     "1/s", 0.01, 1000});
    table.push_back({section, "participant_observers", slot(&Limits::participant_observers),
                     "Observers of a match that are one DDS participant's; 0: half of `observers`. Lower it "
                     "where strangers can ask.",
                     "", 0, 65536});
    table.push_back({section, "shots", slot(&Limits::shots), "Cameras of a match.", "", 1, 256});
    table.push_back({section, "delay_mib", slot(&Limits::delay_mib),
                     "Memory for the delay of a match. A match that needs more is refused.", "MiB", 1,
                     65536});
    table.push_back(
        {section, "pose_rate_hz", slot(&Limits::pose_rate_hz),
         "Pose frames of a match that are looked at in a second, on average. Of a game server "
         "that sends more for seconds, some are left out evenly: other matches do not suffer from "
         "it.",
         "Hz", 20, 1000});
    table.push_back({section, "workers", slot(&Limits::workers),
                     "Threads that compute cameras; 0: one per core.", "", 0, 1024});
}

void add_log(std::vector<Key>& table) {
    const std::string section = "/log";
    const auto slot = [](auto member) { return in(&Config::log, member); };
    table.push_back({section,
                     "level",
                     slot(&Log::level),
                     "The least severe messages that are logged.",
                     "",
                     0,
                     16,
                     {"trace", "debug", "info", "warning", "error"},
                     false,
                     true});
    table.push_back({section,
                     "format",
                     slot(&Log::format),
                     "Plain text, or one JSON object per line.",
                     "",
                     0,
                     16,
                     {"text", "json"}});
}

bool in_range(const Key& key, double value) {
    return (value >= key.minimum && value <= key.maximum) || (key.zero_is_default && value == 0.0);
}

bool holds_string(const Key& key, const json& value) {
    if (!value.is_string()) return false;
    const auto& text = value.get_ref<const std::string&>();
    if (text.find('\0') != std::string::npos) return false;
    return key.choices.empty() ||
           std::find(key.choices.begin(), key.choices.end(), text) != key.choices.end();
}

template <class T>
bool fits(const Key& key, const json& value) {
    if constexpr (std::is_same_v<T, bool>) {
        return value.is_boolean();
    } else if constexpr (std::is_same_v<T, std::int64_t>) {
        return value.is_number_integer() && in_range(key, value.get<double>());
    } else if constexpr (std::is_floating_point_v<T>) {
        return value.is_number() && in_range(key, value.get<double>());
    } else if constexpr (std::is_enum_v<T>) {
        return holds_string(key, value);
    } else if constexpr (std::is_same_v<T, std::string>) {
        return holds_string(key, value) &&
               in_range(key, static_cast<double>(value.get_ref<const T&>().size()));
    } else {
        return value.is_array() && in_range(key, static_cast<double>(value.size())) &&
               std::all_of(value.begin(), value.end(), [&](const json& entry) {
                   return holds_string(key, entry) && !entry.get_ref<const std::string&>().empty();
               });
    }
}

std::string number(double value) {
    std::array<char, 32> text{};
    const auto end = std::to_chars(text.data(), text.data() + text.size(), value);
    return {text.data(), end.ptr};
}

std::string range(const Key& key) {
    return number(key.minimum) + " to " + number(key.maximum) + (key.zero_is_default ? ", or 0" : "");
}

// What each shipped profile is for.
std::string shipped() {
    std::string text = "Always there:";
    const auto profiles = camera::shipped_profiles();
    for (const camera::ShippedProfile& profile : profiles)
        text += std::string(" `") + profile.name + "`, " + profile.use +
                (&profile == &profiles.back() ? ". " : ";");
    return text;
}

}  // namespace

const std::vector<Section>& sections() {
    static const std::vector<Section> list = {
        {"/dds", "The network. Takes effect at a restart; `shards` and `shard` are reloaded by SIGHUP."},
        {"/http",
         "Health, readiness, metrics, status and the page to watch matches. Takes effect at a restart."},
        {"/recording", "Recordings of all matches, as observers see them. Takes effect at a restart."},
        {"/maps", "The list of maps that are served. Reloaded by SIGHUP."},
        {"/profiles",
         "Camera profiles by name; observers request a profile by its name and may override its keys. " +
             shipped() +
             "What a file says of these changes single keys of them; in other profiles, a key that is not "
             "given is `default`'s as it ships. Units are 0.0254 m on every map. Reloaded by SIGHUP."},
        {"/overrides",
         "How far observers may override a profile: by key `[min, max]`, of `solver` the choices. Keys that "
         "are not named cannot be overridden. Without this section, all can, within their ranges: "
         "`\"overrides\": {\"distance\": [80, 200], \"vertical_fov\": [40, 90]}`. Reloaded by SIGHUP."},
        {"/matches", "Lifetime and delay of matches. Reloaded by SIGHUP."},
        {"/direction",
         "How shots follow each other where the director chooses the target, in `serve` and in `direct "
         "--config`. Costs are counted in points, as a moment's `worth`: they mean nothing but beside each "
         "other, and are not the game's score. Reloaded by SIGHUP."},
        {"/moments",
         "What is worth seeing there: rules by name. What a file says of those that ship changes single keys "
         "of them; a rule of another name is a new one and needs a `trigger`: `\"moments\": {\"kill\": "
         "{\"worth\": 15}, \"late awards\": {\"trigger\": \"award\", \"after_s\": 2, \"worth\": 1}}`. What "
         "moments of several rules are worth adds up: two kills in quick succession have the worth of "
         "`kill` and that of `multi-kill` each. A `worth` and `worth_both` of 0 switch a rule off. A "
         "name has 1 to 31 bytes, no commas, quotation marks and control characters, and is not that of a "
         "reason without a moment: `opening`, `death`, `lost sight`, `length`. Reloaded by SIGHUP."},
        {"/limits",
         "Matches beyond `matches`, `participant_matches` and `participant_match_rate`, and observers beyond "
         "`observers`, wait for room, first come, first served: as many as may be served, and of one "
         "participant's matches a quarter of that. Pose frames beyond `pose_rate_hz` are left out evenly. "
         "Whatever else exceeds a limit is refused. By default a participant has at most half of the places, "
         "so that no stranger alone takes all of "
         "them; not less, because one process may host all matches of a small host, or hold most observers "
         "of a match. Takes effect at a restart."},
        {"/log", "Written to standard error. `level` is reloaded by SIGHUP."}};
    return list;
}

const std::vector<Key>& keys() {
    static const std::vector<Key> table = [] {
        std::vector<Key> all;
        add_dds(all);
        add_http(all);
        add_recording(all);
        add_maps(all);
        add_profiles(all);
        add_matches(all);
        add_direction(all);
        add_moments(all);
        add_limits(all);
        add_log(all);
        return all;
    }();
    return table;
}

json value_of(const Key& key, const Target& target) {
    return std::visit(
        [&](const auto& slot) {
            const auto& value = slot(target);
            if constexpr (std::is_same_v<std::decay_t<decltype(value)>, float>)
                return json(shortest(value));
            else
                return json(value);
        },
        key.slot);
}

json default_of(const Key& key) {
    Config config;
    Map map;
    camera::Profile profile;
    direction::Rule rule;
    return value_of(key, {&config, &map, &profile, &rule});
}

bool assign(const Key& key, const json& value, const Target& target) {
    return std::visit(
        [&](const auto& slot) {
            auto& out = slot(target);
            using Value = std::decay_t<decltype(out)>;
            if (!fits<Value>(key, value)) return false;
            out = value.get<Value>();
            return true;
        },
        key.slot);
}

std::string type_name(const Key& key) {
    static constexpr std::array names = {"boolean", "integer",         "number", "number",
                                         "string",  "list of strings", "string", "string"};
    return names[key.slot.index()];
}

std::string expected(const Key& key) {
    const std::string type = type_name(key);
    if (type == "boolean") return "true or false";
    if (!key.choices.empty()) {
        std::string list = "one of";
        for (const std::string& choice : key.choices)
            list += " \"" + choice + '"';
        return list;
    }
    if (type == "string") return "a string of " + range(key) + " bytes";
    if (type == "list of strings") return "a list of " + range(key) + " non-empty strings";
    return (type == "integer" ? "an integer from " : "a number from ") + range(key);
}

}  // namespace camdir::config
