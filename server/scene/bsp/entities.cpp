#include "scene/bsp/entities.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "base/utf8.hpp"

namespace camdir::scene {
namespace {

class Text {
  public:
    explicit Text(std::string_view text) : text_(text) {}

    // Skips blanks; 0 at the end. Compilers end the text with zero bytes.
    [[nodiscard]] char peek() {
        while (at_ < text_.size() && (text_[at_] == ' ' || (text_[at_] >= '\t' && text_[at_] <= '\r')))
            ++at_;
        return at_ < text_.size() ? text_[at_] : '\0';
    }
    void skip() { ++at_; }

    [[nodiscard]] Result<std::string_view> quoted() {
        if (peek() != '"') return unexpected("a quoted string");
        const std::size_t begin = at_ + 1;
        const std::size_t end = text_.find('"', begin);
        if (end == std::string_view::npos) return unexpected("a closing quote");
        at_ = end + 1;
        return text_.substr(begin, end - begin);
    }

    [[nodiscard]] tl::unexpected<Error> unexpected(const std::string& expected) const {
        return fail("lump 0 (entities): byte " + std::to_string(at_) + ": expected " + expected);
    }

  private:
    std::string_view text_;
    std::size_t at_ = 0;
};

Result<Entity> parse_entity(Text& text, std::size_t number) {
    if (text.peek() != '{') return text.unexpected("'{'");
    text.skip();
    Entity entity{number, {}};
    while (text.peek() != '}') {
        const Result<std::string_view> key = text.quoted();
        if (!key) return tl::unexpected(key.error());
        const Result<std::string_view> value = text.quoted();
        if (!value) return tl::unexpected(value.error());
        entity.pairs.emplace_back(*key, *value);
    }
    text.skip();
    return entity;
}

// Takes a number from the front of `text`.
std::optional<double> next_number(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
    if (text.starts_with('+')) text.remove_prefix(1);
    double number = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error != std::errc() || !std::isfinite(number)) return std::nullopt;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
    return number;
}

std::optional<Vec3d> three_numbers(std::string_view text) {
    Vec3d numbers;
    for (double& number : numbers) {
        const std::optional<double> next = next_number(text);
        if (!next) return std::nullopt;
        number = *next;
    }
    return numbers;
}

// Of entities with the same model, one of a higher rank is taken as well.
int rank_of(BrushUse use) {
    if (use == BrushUse::obstacle) return 3;
    return use == BrushUse::mover ? 2 : 1;
}

}  // namespace

std::string_view Entity::value(std::string_view key) const {
    const auto found =
        std::find_if(pairs.begin(), pairs.end(), [&](const auto& pair) { return pair.first == key; });
    return found == pairs.end() ? std::string_view() : found->second;
}

Result<Vec3d> Entity::origin() const {
    const std::string_view text = value("origin");
    if (text.empty()) return Vec3d::Zero().eval();
    const std::optional<Vec3d> origin = three_numbers(text);
    if (!origin || origin->cwiseAbs().maxCoeff() >= max_coordinate)
        return fail("entity " + std::to_string(number) + ": origin '" + std::string(text) +
                    "': expected three numbers below 2^20");
    return *origin;
}

double Entity::yaw() const {
    const std::optional<Vec3d> angles = three_numbers(value("angles"));
    std::string_view text = value("angle");
    const double degrees = angles ? angles->y() : next_number(text).value_or(0.0);
    return std::remainder(degrees, 360.0) * radians_of_a_degree<double>;
}

std::optional<std::size_t> Entity::brush_model() const {
    std::string_view text = value("model");
    if (!text.starts_with('*')) return std::nullopt;
    text.remove_prefix(1);
    std::size_t model = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), model);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return model;
}

Result<std::vector<Entity>> parse_entities(std::string_view text) {
    Text rest(text);
    std::vector<Entity> entities;
    while (rest.peek() != '\0') {
        Result<Entity> entity = parse_entity(rest, entities.size());
        if (!entity) return tl::unexpected(entity.error());
        entities.push_back(std::move(*entity));
    }
    return entities;
}

Result<std::vector<PlacedModel>> placed_models(const std::vector<Entity>& entities, std::size_t model_count,
                                               BspFamily family) {
    std::vector<int> ranks(model_count, 0);
    std::vector<PlacedModel> placed = {{0, "worldspawn", BrushUse::obstacle, Vec3d::Zero()}};
    for (const Entity& entity : entities) {
        const std::optional<std::size_t> model = entity.brush_model();
        if (!model || *model == 0) continue;
        const std::string who =
            "entity " + std::to_string(entity.number) + ": model *" + std::to_string(*model);
        if (*model >= model_count)
            return fail(who + " does not exist; expected a number below " + std::to_string(model_count));
        PlacedModel found{*model, entity.class_name(), brush_use(family, entity.class_name()), Vec3d::Zero()};
        const int rank = rank_of(found.use);
        int& highest = ranks[*model];
        if (rank == highest && found.use == BrushUse::obstacle)
            return fail(who + " belongs to another entity already");
        if (rank <= highest) continue;
        highest = rank;
        if (found.use == BrushUse::obstacle || found.use == BrushUse::mover) {
            const Result<Vec3d> origin = entity.origin();
            if (!origin) return tl::unexpected(origin.error());
            found.origin = *origin;
        }
        placed.push_back(found);
    }
    return placed;
}

std::string class_text(const PlacedModel& placed) {
    constexpr std::size_t max_class_bytes = 64;
    // A few bytes more than are kept, so that the last character is whole.
    const std::string class_name = to_utf8(placed.class_name.substr(0, max_class_bytes + 4));
    return class_name.substr(0, utf8_prefix(class_name, max_class_bytes));
}

std::string skip_reason(const PlacedModel& placed, bool has_parts) {
    const std::string class_name = class_text(placed);
    std::string what(name_of(placed.use));
    if (placed.use == BrushUse::mover) what = has_parts ? "kept as a mover" : "mover without a solid part";
    return what + ": " + (class_name.empty() ? "without a name" : class_name);
}

bool is_spawn_point(std::string_view class_name) {
    constexpr std::array<std::string_view, 4> of_teams = {"team_CTF_redplayer", "team_CTF_blueplayer",
                                                          "team_CTF_redspawn", "team_CTF_bluespawn"};
    if (class_name == "info_player_intermission") return false;  // a camera that overlooks the map
    return class_name.starts_with("info_player_") ||
           std::find(of_teams.begin(), of_teams.end(), class_name) != of_teams.end();
}

}  // namespace camdir::scene
