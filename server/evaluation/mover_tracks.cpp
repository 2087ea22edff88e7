#include "evaluation/mover_tracks.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>

#include "base/file.hpp"
#include "evaluation/csv.hpp"

namespace camdir::evaluation {
namespace {

enum MoverField { mover_time, mover_model, mover_x, mover_y, mover_z, mover_pitch, mover_yaw, mover_roll };

constexpr double mover_angle = 1e6;
constexpr Column mover_columns[] = {
    {"t_ms", 0.0, 1e12},
    {"mover", 0.0, 65535.0, true},
    {"x", -largest_coordinate, largest_coordinate},
    {"y", -largest_coordinate, largest_coordinate},
    {"z", -largest_coordinate, largest_coordinate},
    {"pitch", -mover_angle, mover_angle},
    {"yaw", -mover_angle, mover_angle},
    {"roll", -mover_angle, mover_angle},
};

oracle::Placement part_way(const oracle::Placement& from, const oracle::Placement& to, double share) {
    return {from.position + share * (to.position - from.position),
            from.orientation.slerp(share, to.orientation)};
}

}  // namespace

std::optional<std::uint32_t> model_of(std::string_view name) {
    std::uint32_t model = 0;
    const char* const end = name.data() + name.size();
    if (!name.starts_with('*')) return std::nullopt;
    const auto [read, error] = std::from_chars(name.data() + 1, end, model);
    return error == std::errc{} && read == end ? std::optional(model) : std::nullopt;
}

Result<std::vector<MoverRow>> parse_movers(std::span<const std::byte> bytes, const std::string& name) {
    std::vector<MoverRow> rows;
    const auto read = read_csv(bytes, name, mover_columns, [&](std::span<const double> row) -> Result<void> {
        const std::int64_t time = std::llround(row[mover_time] * 1e6);
        if (!rows.empty() && time < rows.back().time)
            return fail("column \"t_ms\" goes back, expected rows ordered by time");
        if (rows.size() == max_mover_rows)
            return fail("more than " + std::to_string(max_mover_rows) + " rows, expected those of one match");
        rows.push_back({time,
                        static_cast<std::uint32_t>(row[mover_model]),
                        {{row[mover_x], row[mover_y], row[mover_z]},
                         quake_orientation(row[mover_pitch], row[mover_yaw], row[mover_roll])}});
        return {};
    });
    if (!read) return tl::unexpected(read.error());
    return rows;
}

Result<std::vector<MoverRow>> read_movers(const std::filesystem::path& path) {
    const auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_movers(*bytes, path.string());
}

MoverTracks::MoverTracks(std::span<const MoverRow> rows, std::span<const scene::Mover> movers,
                         const Trace& poses)
    : samples_(movers.size()) {
    const auto places = places_by_model(movers);
    for (const MoverRow& row : rows) {
        const auto place = places.find(row.model);
        if (place == places.end()) continue;
        std::vector<Sample>& samples = samples_[place->second];
        // The last frame before this row, in which it stood still.
        const auto frame = std::lower_bound(
            poses.frames.begin(), poses.frames.end(), row.time,
            [](const TraceFrame& earlier, std::int64_t time) { return earlier.time < time; });
        if (!samples.empty() && frame != poses.frames.begin() && (frame - 1)->time > samples.back().time)
            samples.push_back({(frame - 1)->time, samples.back().placement});
        samples.push_back({row.time, row.placement});
    }
}

std::optional<oracle::Placement> MoverTracks::at(std::size_t mover, std::int64_t time) const {
    const std::vector<Sample>& samples = samples_[mover];
    const auto after =
        std::upper_bound(samples.begin(), samples.end(), time,
                         [](std::int64_t earlier, const Sample& sample) { return earlier < sample.time; });
    if (after == samples.begin()) return std::nullopt;
    const Sample& before = *(after - 1);
    if (after == samples.end()) return before.placement;
    const auto span = static_cast<double>(after->time - before.time);
    return part_way(before.placement, after->placement, static_cast<double>(time - before.time) / span);
}

}  // namespace camdir::evaluation
