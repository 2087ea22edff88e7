// Where the doors and lifts of a recorded match were.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "evaluation/trace.hpp"
#include "oracle/mover.hpp"

namespace camdir::evaluation {

inline constexpr std::size_t max_mover_rows = 20'000'000;

// A mover has moved, and is here now.
struct MoverRow {
    std::int64_t time = 0;    // ns, the trace's clock
    std::uint32_t model = 0;  // number of the map's brush model: 3 for "*3"
    oracle::Placement placement;
};

// 3 for "*3".
[[nodiscard]] std::optional<std::uint32_t> model_of(std::string_view name);

// The place in a list of movers of each model that one of them has by its name.
template <class Mover>
[[nodiscard]] std::map<std::uint32_t, std::uint32_t> places_by_model(std::span<const Mover> movers) {
    std::map<std::uint32_t, std::uint32_t> places;
    for (std::uint32_t i = 0; i < movers.size(); ++i)
        if (const auto model = model_of(movers[i].name)) places.emplace(*model, i);
    return places;
}

// Reads movers in Quake units and axes, CSV or CSV.gz, with at least the columns t_ms, mover, x, y, z, pitch,
// yaw, roll: degrees, positive pitch looks down. Rows are ordered by t_ms. Errors name the file, the line,
// the column and what was expected; more than max_mover_rows rows are an error. Thread-safe.
[[nodiscard]] Result<std::vector<MoverRow>> read_movers(const std::filesystem::path& path);

// The same from bytes in memory; `name` stands for the path in errors.
[[nodiscard]] Result<std::vector<MoverRow>> parse_movers(std::span<const std::byte> bytes,
                                                         const std::string& name);

// The rows by mover, between which it is interpolated. Const members are thread-safe.
class MoverTracks {
  public:
    // Of these movers of the scene; rows of other models are left out. `poses` is the trace beside which the
    // rows were recorded: in its frames without a row a mover stood still.
    MoverTracks(std::span<const MoverRow> rows, std::span<const scene::Mover> movers, const Trace& poses);

    // Nothing before its first row. `mover` is a place in the scene's list.
    [[nodiscard]] std::optional<oracle::Placement> at(std::size_t mover, std::int64_t time) const;

  private:
    struct Sample {
        std::int64_t time;
        oracle::Placement placement;
    };
    std::vector<std::vector<Sample>> samples_;  // by mover, ascending
};

}  // namespace camdir::evaluation
