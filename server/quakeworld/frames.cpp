#include "quakeworld/frames.hpp"

#include <utility>
#include <variant>

#include "quakeworld/obituaries.hpp"
#include "quakeworld/text.hpp"

namespace camdir::quakeworld {
namespace {

constexpr std::uint8_t print_of_obituaries = 1;
constexpr std::uint8_t print_for_everyone = 2;
constexpr std::size_t longest_line = 1024;
constexpr std::size_t longest_name = 255;  // of players, teams and maps: servers allow less
constexpr std::size_t blocks_for_one_unread = 100;
constexpr std::size_t recent_blocks = 10'000;  // some minutes
constexpr std::size_t most_in_a_frame = 1024;  // flashes, occurrences

// Nothing else, as it would where a player has called themselves so.
bool says(std::string_view line, std::string_view sentence) {
    if (!line.starts_with(sentence)) return false;
    return line.find_first_not_of("!.\n", sentence.size()) == std::string_view::npos;
}

bool is_set(std::string_view value) {
    return !value.empty() && value != "0";
}

// "dm3" of "maps/dm3.bsp"; empty when it is no map.
std::string map_of(std::string_view model) {
    constexpr std::string_view folder = "maps/";
    constexpr std::string_view extension = ".bsp";
    if (model.size() > folder.size() + longest_name + extension.size() || !model.starts_with(folder) ||
        !model.ends_with(extension))
        return {};
    model.remove_prefix(folder.size());
    model.remove_suffix(extension.size());
    return plain(model);
}

}  // namespace

void FrameReader::Bodies::add(const Models& models) {
    for (std::size_t i = 0; i < models.names.size() && models.first + i < without_.size(); ++i)
        without_[models.first + i] =
            models.names[i] != "progs/player.mdl" && models.names[i] != "progs/eyes.mdl";
}

std::optional<std::string> FrameReader::Lines::add(std::string_view text) {
    if (line_.size() + text.size() > longest_line) line_.clear();
    line_ += plain_lines(text.substr(0, longest_line));
    if (line_.empty() || line_.back() != '\n') return std::nullopt;
    line_.pop_back();
    return std::exchange(line_, {});
}

std::optional<Frame> FrameReader::read(const Block& block) {
    std::optional<Frame> before;
    if (block.time != frame_.time) {
        before = finish();
        frame_.time = block.time;
    }
    count_block();
    if (block.audience == Audience::nobody)
        read_hidden(block);
    else
        read_messages(block);
    return before;
}

std::optional<Frame> FrameReader::finish() {
    note_taken_items();
    for (std::size_t slot = 0; slot < max_slots; ++slot) {
        Body& body = level_.players[slot];
        if (!std::exchange(body.fresh, false) || level_.clients[slot].spectator) continue;
        body.pose.slot = static_cast<Slot>(slot);
        body.pose.alive = !body.dead && level_.bodies.has(body.model);
        frame_.poses.push_back(body.pose);
    }
    Frame finished = std::exchange(frame_, {});
    if (finished.poses.empty() && finished.occurrences.empty()) return std::nullopt;
    return finished;
}

Result<void> FrameReader::expect_readable() const {
    if (lost_level_) return fail(*lost_level_);
    if (recent_.unread * blocks_for_one_unread <= recent_.all) return {};
    return fail(first_unread_ + "; " + std::to_string(recent_.unread) + " of " + std::to_string(recent_.all) +
                " blocks cannot be read, expected at most one in " + std::to_string(blocks_for_one_unread));
}

// A stream goes on for days: what counts is how it is now.
void FrameReader::count_block() {
    ++blocks_;
    if (++recent_.all >= recent_blocks) {
        recent_.all /= 2;
        recent_.unread /= 2;
    }
}

void FrameReader::read_messages(const Block& block) {
    MessageReader messages(block.content, protocol_);
    while (!messages.at_end()) {
        const auto message = messages.next();
        if (!message) return note_unread(block, messages, message.error());
        std::visit([&](const auto& content) { take(block, content); }, *message);
    }
}

void FrameReader::read_hidden(const Block& block) {
    for (const Damage& damage : damage_in(block.content))
        note(Occurrence::Kind::damage, damage.attacker, damage.victim, std::to_string(damage.amount));
}

void FrameReader::note_unread(const Block& block, const MessageReader& messages, const Error& error) {
    const std::string what = "block at byte " + std::to_string(block.offset) + ": " + error.message;
    if (messages.begins_level()) lost_level_ = what;
    if (unread_blocks_++ == 0) first_unread_ = what;
    ++recent_.unread;
}

void FrameReader::take(const Block& block, const BeginLevel& /*unused*/) {
    level_ = {};
    lost_level_.reset();
    map_.clear();
    ++levels_;
    frame_ = {};
    frame_.time = block.time;
}

void FrameReader::take(const Block& /*unused*/, const PlayerInfo& info) {
    Body& body = level_.players[info.slot];
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        if (info.origin[i]) body.pose.origin[axis] = *info.origin[i];
        if (info.angles[i]) body.pose.angles[axis] = *info.angles[i];
    }
    if (info.model) body.model = info.model;
    body.dead = info.dead;
    body.pose.gibbed = info.gibbed;
    body.fresh = true;
}

void FrameReader::take(const Block& block, const Stat& stat) {
    if (block.audience == Audience::one_s_stats) level_.players[block.slot].inventory.apply(stat);
}

void FrameReader::take(const Block& block, const Print& print) {
    if (block.audience != Audience::everyone) return;
    if (print.level == print_of_obituaries) {
        if (const auto line = level_.obituaries.add(print.text)) take_obituary(*line);
    }
    if (print.level != print_for_everyone) return;
    const std::string line = plain_lines(print.text.substr(0, longest_line));
    if (says(line, "The match has begun")) begin_match();
    if (says(line, "The match is over")) end_match();
}

void FrameReader::take(const Block& block, const ClientCommand& command) {
    if (command.text.starts_with("//ktx matchstart")) begin_match();
    if (command.text.starts_with("fullserverinfo"))
        for (const std::string_view key : {"mode", "teamplay"})
            take(block, ServerKey{key, value_of(command.text.substr(0, command.text.rfind('"')), key)});
}

void FrameReader::take(const Block& block, const UserInfo& info) {
    for (const std::string_view key : {"name", "team", "*spectator"})
        take(block, UserKey{info.slot, key, value_of(info.info, key)});
}

void FrameReader::take(const Block& /*unused*/, const UserKey& user) {
    Client& client = level_.clients[user.slot];
    if (user.key == "name") client.name = plain(user.value.substr(0, longest_name));
    if (user.key == "team") client.team = user.value.substr(0, longest_name);
    if (user.key == "*spectator") client.spectator = is_set(user.value);
}

void FrameReader::take(const Block& /*unused*/, const ServerKey& server) {
    if (server.key == "teamplay") level_.teamplay = is_set(server.value);
    if (server.key == "mode") level_.hands_out_items = server.value.find("wipeout") != std::string_view::npos;
    if (server.key == "status" && server.value.find("left") != std::string_view::npos) begin_match();
    if (server.key == "status" && server.value == "Standby") end_match();
}

void FrameReader::take(const Block& /*unused*/, const Models& models) {
    level_.bodies.add(models);
    if (models.first == 1 && !models.names.empty()) map_ = map_of(models.names.front());
}

void FrameReader::take(const Block& /*unused*/, const TeleportFlash& flash) {
    if (frame_.flashes.size() < most_in_a_frame) frame_.flashes.push_back(flash.position);
}

void FrameReader::take(const Block& /*unused*/, const Intermission& /*unused*/) {
    end_match();
}

void FrameReader::take_obituary(const std::string& line) {
    std::array<std::string, max_slots> names;
    for (std::size_t slot = 0; slot < max_slots; ++slot)
        if (!level_.clients[slot].spectator) names[slot] = level_.clients[slot].name;
    if (const auto obituary = obituary_of(line, names))
        note(Occurrence::Kind::obituary, obituary->killer, obituary->victim, std::string(obituary->cause));
}

void FrameReader::note(Occurrence::Kind kind, std::optional<Slot> actor, std::optional<Slot> subject,
                       std::string detail) {
    if (frame_.occurrences.size() == most_in_a_frame) return;
    frame_.occurrences.push_back({frame_.time, kind, actor, subject, std::move(detail)});
}

void FrameReader::begin_match() {
    if (level_.match_begin) return;
    level_.match_begin = frame_.time;
    level_.match_is_over = false;
    note(Occurrence::Kind::match_begin);
}

void FrameReader::end_match() {
    if (!level_.match_begin) return;
    level_.match_begin.reset();
    level_.match_is_over = true;
    note(Occurrence::Kind::match_end);
}

void FrameReader::note_taken_items() {
    for (std::size_t slot = 0; slot < max_slots; ++slot) {
        Body& body = level_.players[slot];
        const Inventory before = std::exchange(body.inventory_before, body.inventory);
        if (level_.hands_out_items || level_.match_begin == frame_.time) continue;
        for (const std::string_view item : taken_items(before, body.inventory))
            note(Occurrence::Kind::item, static_cast<Slot>(slot), std::nullopt, std::string(item));
    }
}

}  // namespace camdir::quakeworld
