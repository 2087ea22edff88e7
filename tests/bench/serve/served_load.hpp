// One load on one director: what its observers see and what it costs.
#pragma once

#include <cstdint>
#include <string>

namespace camdir::bench {

struct Load {
    std::uint32_t matches, shots;  // shots a match, each of a player of its own with an observer
    double rate_hz;
};

struct Bench {
    std::string programs;          // folder
    std::string map_file, source;  // baked, and what it was baked from
    double seconds;                // measured, of each load
};

enum class Server { director, raw };

struct Served {
    double frames_per_s = 0.0;          // that an observer receives
    double p50_ms = 0.0, p99_ms = 0.0;  // from the poses' sending to the cameras' arrival
    double cores = 0.0;                 // of the server
    double waits_per_s = 0.0;           // of its threads

    [[nodiscard]] double microseconds_a_frame(const Load& load) const {
        return 1e6 * cores / (load.matches * load.rate_hz);
    }
    [[nodiscard]] double waits_a_frame(const Load& load) const {
        return waits_per_s / (load.matches * load.rate_hz);
    }
    [[nodiscard]] double cameras_a_core(const Load& load) const {
        return load.matches * load.shots * frames_per_s / cores;
    }
    // Nobody misses more than a frame in a hundred, and nobody is served later than after two.
    [[nodiscard]] bool holds(const Load& load) const {
        return frames_per_s >= 0.99 * load.rate_hz && p99_ms <= 2000.0 / load.rate_hz;
    }
};

// Runs the server, players and observers, all on this machine, in a domain of their own. Throws when a
// program fails or not all observers are served.
[[nodiscard]] Served serve(const Bench& bench, Server server, const Load& load);

}  // namespace camdir::bench
