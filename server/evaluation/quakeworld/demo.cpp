#include "evaluation/quakeworld/demo.hpp"

#include <algorithm>
#include <string_view>
#include <utility>
#include <variant>

#include "evaluation/quakeworld/inventory.hpp"
#include "evaluation/quakeworld/messages.hpp"
#include "evaluation/quakeworld/obituaries.hpp"
#include "evaluation/quakeworld/text.hpp"

namespace camdir::evaluation::quakeworld {
namespace {

constexpr std::uint8_t print_of_obituaries = 1;
constexpr std::uint8_t print_for_everyone = 2;
constexpr std::size_t longest_line = 1024;
constexpr std::size_t blocks_for_one_unread = 100;

bool is_set(std::string_view value) {
    return !value.empty() && value != "0";
}

struct Client {
    DemoPose pose;
    std::optional<std::uint8_t> model;
    bool dead = false;
    bool fresh = false;  // in the frame that is being read
    bool spectator = false;
    std::string name;
    std::string team;
    Inventory inventory;
    Inventory inventory_before;  // at the end of the last frame
};

// Which models are a living player's body; those without a name are taken for one.
class Bodies {
  public:
    void add(const Models& models) {
        for (std::size_t i = 0; i < models.names.size() && models.first + i < without_.size(); ++i)
            without_[models.first + i] =
                models.names[i] != "progs/player.mdl" && models.names[i] != "progs/eyes.mdl";
    }
    [[nodiscard]] bool has(std::optional<std::uint8_t> model) const {
        return !model || (*model != 0 && !without_[*model]);
    }

  private:
    std::array<bool, 256> without_{};
};

// Puts prints together to lines: old servers print an obituary in pieces.
class Lines {
  public:
    // Nothing while the line goes on.
    std::optional<std::string> add(std::string_view text) {
        if (line_.size() + text.size() > longest_line) line_.clear();
        line_ += plain(text.substr(0, longest_line));
        if (line_.empty() || line_.back() != '\n') return std::nullopt;
        line_.pop_back();
        return std::exchange(line_, {});
    }

  private:
    std::string line_;
};

class Recorder {
  public:
    [[nodiscard]] bool over() const { return over_; }

    void read(const Block& block) {
        if (block.time != time_) {
            close_frame();
            time_ = block.time;
        }
        block_ = &block;
        ++demo_.blocks;
        if (block.audience == Audience::nobody)
            read_hidden(block);
        else
            read_messages(block);
    }

    Result<Demo> finish() {
        if (!over_) close_frame();
        if (demo_.unread_blocks * blocks_for_one_unread > demo_.blocks)
            return fail(demo_.first_unread + "; " + std::to_string(demo_.unread_blocks) + " of " +
                        std::to_string(demo_.blocks) + " blocks cannot be read, expected at most one in " +
                        std::to_string(blocks_for_one_unread));
        if (demo_.frames.empty()) return fail("no player in it, expected at least one frame with a player");
        return std::move(demo_);
    }

  private:
    void read_messages(const Block& block) {
        MessageReader messages(block.content, protocol_);
        while (!messages.at_end() && !over_) {
            const auto message = messages.next();
            if (!message) return note_unread(block, message.error());
            std::visit([this](const auto& content) { take(content); }, *message);
        }
    }

    void read_hidden(const Block& block) {
        for (const Damage& damage : damage_in(block.content))
            note(Occurrence::Kind::damage, damage.attacker, damage.victim, std::to_string(damage.amount));
    }

    void note_unread(const Block& block, const Error& error) {
        if (demo_.unread_blocks++ == 0)
            demo_.first_unread = "block at byte " + std::to_string(block.offset) + ": " + error.message;
    }

    void take(const Other& /*unused*/) {}

    void take(const PlayerInfo& info) {
        Client& client = clients_[info.slot];
        for (int axis = 0; axis < 3; ++axis) {
            const auto i = static_cast<std::size_t>(axis);
            if (info.origin[i]) client.pose.origin[axis] = *info.origin[i];
            if (info.angles[i]) client.pose.angles[axis] = *info.angles[i];
        }
        if (info.model) client.model = info.model;
        client.dead = info.dead;
        client.pose.gibbed = info.gibbed;
        client.fresh = true;
    }

    void take(const Stat& stat) {
        if (block_->audience == Audience::one_s_stats) clients_[block_->slot].inventory.apply(stat);
    }

    void take(const Print& print) {
        if (block_->audience != Audience::everyone) return;
        if (print.level == print_of_obituaries) {
            if (const auto line = obituaries_.add(print.text)) take_obituary(*line);
        }
        if (print.level != print_of_obituaries && print.level != print_for_everyone) return;
        const std::string text = plain(print.text);
        if (text.find("match has begun") != std::string::npos) begin_match();
        if (text.find("match is over") != std::string::npos) end_match();
    }

    void take(const ClientCommand& command) {
        if (command.text.starts_with("//ktx matchstart")) begin_match();
        if (command.text.starts_with("fullserverinfo"))
            for (const std::string_view key : {"mode", "teamplay"})
                take(ServerKey{key, value_of(command.text.substr(0, command.text.rfind('"')), key)});
    }

    void take(const UserInfo& info) {
        for (const std::string_view key : {"name", "team", "*spectator"})
            take(UserKey{info.slot, key, value_of(info.info, key)});
    }

    void take(const UserKey& user) {
        Client& client = clients_[user.slot];
        if (user.key == "name") client.name = plain(user.value);
        if (user.key == "team") client.team = user.value;
        if (user.key == "*spectator") client.spectator = is_set(user.value);
    }

    void take(const ServerKey& server) {
        if (server.key == "teamplay") demo_.teamplay = is_set(server.value);
        if (server.key == "mode") hands_out_items_ = server.value.find("wipeout") != std::string_view::npos;
        if (server.key == "status" && server.value.find("left") != std::string_view::npos) begin_match();
        if (server.key == "status" && server.value == "Standby") end_match();
    }

    void take(const Models& models) { bodies_.add(models); }
    void take(const TeleportFlash& flash) { demo_.flashes.push_back(flash.position); }
    void take(const Intermission& /*unused*/) { end_match(); }

    void take_obituary(const std::string& line) {
        std::array<std::string, max_slots> names;
        for (std::size_t slot = 0; slot < max_slots; ++slot)
            if (!clients_[slot].spectator) names[slot] = clients_[slot].name;
        const auto obituary = obituary_of(line, names);
        if (obituary)
            note(Occurrence::Kind::obituary, obituary->killer, obituary->victim,
                 std::string(obituary->cause));
    }

    void note(Occurrence::Kind kind, std::optional<Slot> actor, std::optional<Slot> subject,
              std::string detail) {
        demo_.occurrences.push_back({time_, kind, actor, subject, std::move(detail)});
    }

    void begin_match() {
        if (begin_) return;
        begin_ = time_;
        demo_.frames.clear();
        demo_.poses.clear();
        demo_.flashes.clear();
        demo_.occurrences.clear();
    }

    void end_match() { over_ = begin_.has_value(); }

    void close_frame() {
        note_taken_items();
        const DemoFrame last = demo_.frames.empty() ? DemoFrame{} : demo_.frames.back();
        DemoFrame frame{time_, last.first_pose + last.pose_count, 0, last.first_flash + last.flash_count, 0};
        for (std::size_t slot = 0; slot < max_slots; ++slot)
            if (std::exchange(clients_[slot].fresh, false) && !clients_[slot].spectator)
                add_pose(static_cast<Slot>(slot));
        frame.pose_count = static_cast<std::uint32_t>(demo_.poses.size()) - frame.first_pose;
        if (frame.pose_count == 0) {
            demo_.flashes.resize(frame.first_flash);
            return;
        }
        frame.flash_count = static_cast<std::uint32_t>(demo_.flashes.size()) - frame.first_flash;
        demo_.frames.push_back(frame);
    }

    void add_pose(Slot slot) {
        Client& client = clients_[slot];
        client.pose.slot = slot;
        client.pose.alive = !client.dead && bodies_.has(client.model);
        demo_.poses.push_back(client.pose);
        demo_.teams[slot] = client.team;
    }

    void note_taken_items() {
        for (std::size_t slot = 0; slot < max_slots; ++slot) {
            Client& client = clients_[slot];
            const Inventory before = std::exchange(client.inventory_before, client.inventory);
            if (hands_out_items_ || begin_ == time_) continue;
            for (const std::string_view item : taken_items(before, client.inventory))
                note(Occurrence::Kind::item, static_cast<Slot>(slot), std::nullopt, std::string(item));
        }
    }

    Demo demo_;
    Protocol protocol_;
    Bodies bodies_;
    Lines obituaries_;
    std::array<Client, max_slots> clients_;
    const Block* block_ = nullptr;  // that is being read
    std::int64_t time_ = 0;
    std::optional<std::int64_t> begin_;  // of the match
    bool over_ = false;
    bool hands_out_items_ = false;  // at the begin of every round
};

}  // namespace

Result<Demo> read_demo(std::span<const std::byte> bytes) {
    BlockReader blocks(bytes);
    Recorder recorder;
    while (!recorder.over()) {
        const auto block = blocks.next();
        if (!block) return tl::unexpected(block.error());
        if (!*block) break;
        recorder.read(**block);
    }
    return recorder.finish();
}

}  // namespace camdir::evaluation::quakeworld
