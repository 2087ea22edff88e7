// The server's configuration: one JSON file. What each key means, its range and its default are in the one
// table of keys.cpp; validation, the schema and the reference page are made from it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "camera/profile.hpp"
#include "direction/rules.hpp"

namespace camdir::config {

struct Dds {
    std::int64_t domain = 0;
    std::string interface = "lo";  // name or address; empty = Cyclone chooses
    bool multicast = false;
    std::int64_t participant_index = 0;  // -1 = none
    std::int64_t port = 7400;            // the domain's base port
    std::vector<std::string> peers;      // addresses, contacted by unicast
    std::vector<std::string> partitions = {"match/*"};
    std::int64_t director_id = 0;     // 0 = chosen at random at start
    std::int64_t strength = 100;      // of directors that begin a match together, the strongest leads it
    std::int64_t lease_ms = 200;      // after which a hung director is replaced by its standby
    std::vector<std::string> shards;  // names; empty: every director serves every match
    std::string shard;                // this director's
    std::string security;             // folder of the identity for DDS Security; empty = plain
    bool insecure = false;            // plain DDS may leave loopback
    std::string xml;                  // Cyclone configuration that replaces the keys of the network
};

struct Http {
    bool enabled = true;
    std::string address = "127.0.0.1";
    std::int64_t port = 9464;        // 0 = any free one, which the log names
    std::string token_file;          // needed off loopback
    std::vector<std::string> hosts;  // names of proxies before a loopback address
    std::int64_t match_metrics = 0;
    std::int64_t viewers = 256;  // who watch matches in a browser, at most
    std::string page;            // folder of the page's files; empty: beside the program
};

struct Recording {
    std::string folder;  // empty: nothing is recorded
    std::int64_t disk_mib = 10'240;
    std::int64_t match_mib = 2'048;
};

// The ranges of these two keys of a map, besides 0 for their default, and of the options of `bake`.
inline constexpr double min_d0 = 2.0;
inline constexpr double max_d0 = 256.0;
inline constexpr double min_metres_per_unit = 1e-6;
inline constexpr double max_metres_per_unit = 1e6;

struct Map {
    std::string name;    // as in MatchInfo.map_name
    std::string file;    // MAP.vfs
    std::string source;  // when set, `file` is baked from it when missing or stale
    // Of bake::Parameters, by the same names.
    double d0 = 0.0;
    std::string sampling = "adaptive";
    double loss = 16.0;
    std::int64_t triangles = 0;
    // Of scene::ReadOptions, by the same names.
    double metres_per_unit = 0.0;
    std::string up;
    std::string origin;
    std::vector<std::string> seeds;
    bool strict = false;

    bool operator==(const Map&) const = default;
};

// How far observers may override a key of a profile.
struct OverrideRange {
    double min = 0.0;  // of a number
    double max = 0.0;
    std::vector<std::string> choices;  // of a string

    bool operator==(const OverrideRange&) const = default;
};

// By key of a profile; what is not in it cannot be overridden.
using OverrideRanges = std::map<std::string, OverrideRange>;

struct Matches {
    std::string default_profile = "default";
    std::int64_t silence_frames = 30;  // a match without poses for silence_frames / rate_hz is silent
    double forget_s = 300.0;           // a match whose server disappeared ends after this
    double minimum_delay_s = 0.0;      // observers see every match at least so late
};

struct Limits {
    std::int64_t matches = 64;
    std::int64_t players = 256;              // a match
    std::int64_t observers = 256;            // a match
    std::int64_t participant_matches = 0;    // 0 = half of `matches`
    double participant_match_rate = 8.0;     // that it may begin in a second, beyond as many at once
    std::int64_t participant_observers = 0;  // a match; 0 = half of `observers`
    std::int64_t shots = 256;                // a match
    std::int64_t delay_mib = 64;             // a match
    std::int64_t pose_rate_hz = 150;         // pose frames of a match that are looked at, a second
    std::int64_t workers = 0;                // threads; 0 = one per core
};

struct Log {
    std::string level = "info";
    std::string format = "text";
};

struct Config {
    Dds dds;
    Http http;
    Recording recording;
    std::vector<Map> maps;                            // names are distinct
    std::map<std::string, camera::Profile> profiles;  // always has those that ship (camera/profile.hpp)
    std::optional<OverrideRanges> overrides;          // none: every key, within its own range
    Matches matches;
    direction::Rules direction = direction::default_rules();
    Limits limits;
    Log log;
};

// Reads and validates a file. Relative paths in it are taken from its folder. A `shard` that is not empty
// takes the place of the file's. The error names every problem, one per line: JSON pointer, value,
// expectation.
[[nodiscard]] Result<Config> load(const std::filesystem::path& file, const std::string& shard = {});

// The same from text. `name` is the file's name in errors; relative paths are resolved from `folder`.
[[nodiscard]] Result<Config> parse(const std::string& text, const std::string& name,
                                   const std::filesystem::path& folder, const std::string& shard = {});

// An observer's overrides: a JSON object with keys of a profile, or empty. The error is one line.
[[nodiscard]] Result<camera::Profile> override_profile(const camera::Profile& base,
                                                       const std::string& overrides,
                                                       const std::optional<OverrideRanges>& ranges);

// JSON pointers of the keys that differ and need a restart to take effect.
[[nodiscard]] std::vector<std::string> changes_for_restart(const Config& running, const Config& loaded);

// Takes over what takes effect without a restart. Other threads may read the rest meanwhile.
void reload(Config& running, Config loaded);

// JSON Schema (2020-12) of the file.
[[nodiscard]] std::string schema();

// The reference of all keys, Markdown.
[[nodiscard]] std::string reference();

}  // namespace camdir::config
