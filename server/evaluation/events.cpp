#include "evaluation/events.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/file.hpp"
#include "evaluation/csv.hpp"

namespace camdir::evaluation {
namespace {

enum EventField { event_time, event_kind, event_actor, event_subject, event_detail };

constexpr TextColumn event_columns[] = {{"t_ms", "t_ms"},
                                        {"event", "kind"},
                                        {"player", "actor"},
                                        {"other", "subject"},
                                        {"detail", "value", true}};

// Games of Quake 3's family number the world, which kills by falls and lava, as 1022.
bool is_nobody(std::string_view field, const Trace& trace) {
    return field.empty() || (field == "1022" && !std::ranges::binary_search(trace.players, 1022U));
}

Result<TraceEvent> event_of(std::int64_t time, std::span<const std::string_view> row, const Trace& trace) {
    const auto actor = player_in(row[event_actor], event_columns[event_actor].name, trace);
    if (!actor) return tl::unexpected(actor.error());
    const auto subject = player_in(row[event_subject], event_columns[event_subject].name, trace);
    if (!subject) return tl::unexpected(subject.error());
    return TraceEvent{time, std::string(row[event_kind]), *actor, *subject, std::string(row[event_detail])};
}

// Whose death it was is the subject, or the actor alone; it was nobody else's doing.
TraceEvent in_one_shape(TraceEvent event) {
    if (event.kind != "death") return event;
    if (!event.subject) event.subject = event.actor;
    event.actor.reset();
    return event;
}

}  // namespace

Result<std::optional<std::uint32_t>> player_in(std::string_view field, const char* column,
                                               const Trace& trace) {
    if (is_nobody(field, trace)) return std::nullopt;
    const auto number = to_number(field, {column, 0.0, 4294967294.0, true});
    if (!number) return tl::unexpected(number.error());
    const auto player = static_cast<std::uint32_t>(*number);
    if (std::ranges::binary_search(trace.players, player)) return player;
    return fail("column \"" + std::string(column) + "\" is " + std::to_string(player) +
                ", expected a player of the trace");
}

Result<std::int64_t> time_in(std::string_view field) {
    const auto milliseconds = to_number(field, {"t_ms", 0.0, 1e12});
    if (!milliseconds) return tl::unexpected(milliseconds.error());
    return std::llround(*milliseconds * 1e6);
}

Result<std::vector<TraceEvent>> parse_events(std::span<const std::byte> bytes, const std::string& name,
                                             const Trace& trace, const TakesKind& takes) {
    std::vector<TraceEvent> events;
    std::int64_t last = 0;
    const auto read = read_text_csv(bytes, name, event_columns, [&](auto row) -> Result<void> {
        const auto time = time_in(row[event_time]);
        if (!time) return tl::unexpected(time.error());
        if (*time < std::exchange(last, *time))
            return fail("column \"t_ms\" is before the last row's, expected rows ordered by time");
        if (takes && !takes(row[event_kind])) return {};
        auto event = event_of(*time, row, trace);
        if (!event) return tl::unexpected(event.error());
        if (events.size() == max_events)
            return fail("more than " + std::to_string(max_events) + " events, expected those of one match");
        events.push_back(in_one_shape(std::move(*event)));
        return {};
    });
    if (!read) return tl::unexpected(read.error());
    return events;
}

Result<std::vector<TraceEvent>> read_events(const std::filesystem::path& path, const Trace& trace,
                                            const TakesKind& takes) {
    const auto bytes = read_file(path);
    if (!bytes) return tl::unexpected(bytes.error());
    return parse_events(*bytes, path.string(), trace, takes);
}

}  // namespace camdir::evaluation
