#include "quakeworld/inventory.hpp"

namespace camdir::quakeworld {
namespace {

constexpr std::uint8_t stat_health = 0;
constexpr std::uint8_t stat_armour = 4;
constexpr std::uint8_t stat_items = 15;

constexpr std::uint32_t yellow_armour = 1U << 14U;
constexpr std::uint32_t red_armour = 1U << 15U;
constexpr std::uint32_t mega_health = 1U << 16U;
constexpr std::int32_t largest_small_pack = 25;  // hit points

struct Item {
    std::uint32_t bit;
    std::string_view name;
};
constexpr Item items_of_interest[] = {
    {1U << 5U, "rl"},    {1U << 6U, "lg"},    {yellow_armour, "ya"}, {red_armour, "ra"},
    {mega_health, "mh"}, {1U << 19U, "ring"}, {1U << 20U, "pent"},   {1U << 22U, "quad"},
};

}  // namespace

void Inventory::apply(const Stat& stat) {
    if (stat.number == stat_health) health = stat.value;
    if (stat.number == stat_armour) armour = stat.value;
    if (stat.number == stat_items) items = static_cast<std::uint32_t>(stat.value);
}

std::vector<std::string_view> taken_items(const Inventory& before, const Inventory& after) {
    if (before.health <= 0) return {};
    std::uint32_t taken = after.items & ~before.items;
    if (after.armour > before.armour) taken |= after.items & (yellow_armour | red_armour);
    if (after.health > before.health + largest_small_pack) taken |= after.items & mega_health;
    std::vector<std::string_view> names;
    for (const Item& item : items_of_interest)
        if ((taken & item.bit) != 0) names.push_back(item.name);
    return names;
}

}  // namespace camdir::quakeworld
