// What is worth seeing, and how shots may follow each other.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "direction/footage.hpp"

namespace camdir::direction {

enum class EventKind : std::uint8_t {
    kill,           // actor: the killer; subject: the victim
    flag_taken,     // by the actor
    flag_captured,  // by the actor
    objective,      // reached by the actor
    damage,         // by the actor to the subject
    award,          // to the actor
    item,           // taken by the actor
    round_won,      // by the actor
    spawn,          // the actor entered the game, or again after a death
};

struct Event {
    double time = 0.0;  // s from the first frame
    EventKind kind = EventKind::kill;
    Index actor = nobody;
    Index subject = nobody;
    double value = 0.0;  // of an item, in kills: see quakeworld()
};

// What begins a moment.
enum class Trigger : std::uint8_t {
    sight,       // two living enemies in mutual sight, while the sentence's range and angle hold
    exchange,    // one hurt the other; while the next wound of the two comes within the time after
    kill,        // one killed another
    killer,      // likewise; of the killer alone
    multi_kill,  // one killed another, and the same killer's last or next kill is within 3 s
    flag_taken,
    flag_captured,
    objective,
    award,
    item,
    round_won,
    spawn,
    streak,      // somebody killed three since they last died: until they die
    flag_run,    // somebody took a flag: until they capture it or die
    lead,        // somebody killed more than anybody else: until another does
    last_alive,  // who lives, all others of their team dead for 5 s and more, while an enemy lives
};

// A sentence: `name`: while (or when) `trigger`, from `before_s` before to `after_s` after, for whoever is in
// it, `worth` and `worth_both`. Worth counts in points, as the grammar's costs
// do: they mean nothing but beside each other.
struct Rule {
    std::string name;
    Trigger trigger = Trigger::kill;
    double before_s = 0.0;
    double after_s = 0.0;
    // Of a whole moment, once, when it is shown from its begin to its end, by one shot or by two with the cut
    // no farther from either end than the shortest shot is long; else of every second of it that is shown.
    // Shown is whoever of its players is.
    double worth = 0.0;
    double worth_both = 0.0;  // more, while both are shown
    bool whole = false;
    double range = 1e9;     // sight: no farther apart, units of 0.0254 m
    double facing = 180.0;  // sight: one of them looks this near to the other, degrees

    [[nodiscard]] bool is_on() const { return worth > 0.0 || worth_both > 0.0; }
};

// How shots follow each other. Seconds, and costs in points.
struct Grammar {
    double minimum_shot_s = 2.2;  // never shorter
    double preferred_shot_s = 7.0;
    double maximum_shot_s = 14.0;
    double length = 5.0;     // of a piece e times as long, or as short, as preferred
    double cut = 1.5;        // of every cut
    double hidden = 3.0;     // a second in which the rush does not show its own player
    double dead = 3.0;       // a second on a dead player after `beat_after_death_s`
    double idle = 1.2;       // a second on a player who stands about
    double inner_cut = 1.0;  // of a rush's own cut within a shot, beside what its pieces cost
    double beat_after_death_s = 0.7;
    double fresh = 0.02;  // a second, for each minute since its player was last shown; at most two
    // Of 30 degrees: a player seen from directions nearer to each other is a jump cut.
    double jump_cosine = 0.866;
    // What is not known yet is worth what is there now, halved every so many seconds.
    double half_life_s = 4.0;
    double foresight_s = 4.0;  // no plan goes further than this beyond what is known
    bool fixed_shots = true;   // also cameras that stand still
};

struct Rules {
    std::vector<Rule> moments;
    Grammar grammar;
};

// For duels, free for all, team matches and capture the flag.
[[nodiscard]] Rules default_rules();

}  // namespace camdir::direction
