#include "scene/bsp/brush_classes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace camdir::scene {
namespace {

constexpr bool yes = true;
constexpr bool no = false;

// clang-format off
constexpr std::array table = {
    BrushClasses{"func_detail_illusionary func_illusionary", yes, yes, BrushUse::none,
                 "drawn only: players and cameras pass through"},
    BrushClasses{"func_group func_static", yes, yes, BrushUse::obstacle,
                 "stands still"},
    BrushClasses{"func_wall func_conveyor func_detail*", yes, yes, BrushUse::obstacle,
                 "stands still; a conveyor moves what is on it, not itself"},
    BrushClasses{"func_healthcharger func_recharge", yes, no, BrushUse::obstacle,
                 "stands still on a wall"},
    BrushClasses{"func_button func_rot_button momentary_rot_button button_target", yes, no, BrushUse::obstacle,
                 "stays on its wall: when used it sinks in, turns in place or does nothing; taken at rest"},
    BrushClasses{"func_breakable func_explosive", yes, yes, BrushUse::obstacle,
                 "stands until it is destroyed; taken whole"},
    BrushClasses{"func_pushable", yes, no, BrushUse::obstacle,
                 "a crate, taken where the map puts it"},
    BrushClasses{"func_button", no, yes, BrushUse::mover,
                 "sinks into its wall when touched; a mover like every moving model of Quake 3"},
    BrushClasses{"func_door", yes, yes, BrushUse::mover,
                 "opens a way"},
    BrushClasses{"func_door_rotating func_door_secret func_door_nzp momentary_door", yes, no, BrushUse::mover,
                 "opens a way"},
    BrushClasses{"func_wall_toggle func_togglewall func_movewall func_episodegate func_bossgate", yes, no,
                 BrushUse::mover,
                 "appears and disappears during the game"},
    BrushClasses{"func_plat func_train", yes, yes, BrushUse::mover,
                 "carries players"},
    BrushClasses{"func_platrot func_new_plat func_train2 func_tracktrain func_trackchange func_trackautochange "
                 "func_vehicle",
                 yes, no, BrushUse::mover,
                 "carries players"},
    BrushClasses{"func_bobbing func_pendulum func_rotating", yes, yes, BrushUse::mover,
                 "swings or turns all the time"},
    BrushClasses{"func_bob func_rotate_door func_rotate_entity func_rotate_train rotate_object", yes, no,
                 BrushUse::mover,
                 "swings or turns"},
    BrushClasses{"func_tankcontrols func_traincontrols func_vehiclecontrols", yes, no, BrushUse::none,
                 "no body: where a player stands to steer"},
    BrushClasses{"func_guntarget func_tank*", yes, no, BrushUse::mover,
                 "a target on its path, a gun that turns to its target"},
    BrushClasses{"trigger_*", yes, yes, BrushUse::none,
                 "no body: an area where something happens"},
    BrushClasses{"func_areaportal", no, yes, BrushUse::none,
                 "no body: a mark for the compiler"},
    BrushClasses{"func_liquid func_water", yes, yes, BrushUse::none,
                 "liquid, no obstacle in the world either"},
    BrushClasses{"func_ladder", yes, yes, BrushUse::none,
                 "no body: an area where players climb; what is drawn there is another brush"},
    BrushClasses{"func_bomb_target func_buyzone func_clip func_ending func_escapezone func_friction "
                 "func_grencatch func_hostage_rescue func_monsterclip func_mortar_field func_nobuild "
                 "func_nogrenades func_vip_safetyzone func_weaponcheck buy_weapon game_zone_player",
                 yes, no, BrushUse::none,
                 "no body: an area with a rule of the game"},
    BrushClasses{"env_bubbles func_rain func_snow", yes, yes, BrushUse::none,
                 "no body: an area with an effect"},
};
// clang-format on

bool matches(std::string_view pattern, std::string_view name) {
    if (pattern.ends_with('*')) return name.starts_with(pattern.substr(0, pattern.size() - 1));
    return name == pattern;
}

bool names_class(std::string_view names, std::string_view class_name) {
    while (!names.empty()) {
        const std::size_t end = std::min(names.find(' '), names.size());
        if (matches(names.substr(0, end), class_name)) return true;
        names.remove_prefix(std::min(end + 1, names.size()));
    }
    return false;
}

}  // namespace

std::span<const BrushClasses> brush_classes() {
    return table;
}

std::string_view name_of(BrushUse use) {
    constexpr std::array<std::string_view, 4> names = {"obstacle", "mover", "no obstacle", "unknown class"};
    return names[static_cast<std::size_t>(use)];
}

BrushUse brush_use(BspFamily family, std::string_view class_name) {
    const auto* const row = std::find_if(table.begin(), table.end(), [&](const BrushClasses& classes) {
        return (family == BspFamily::quake ? classes.in_quake : classes.in_quake3) &&
               names_class(classes.names, class_name);
    });
    return row == table.end() ? BrushUse::unknown : row->use;
}

}  // namespace camdir::scene
