/* The time since a map began, which the engine counts in a float: that has steps of 2 ms after 4.5 hours, and
 * of 16 ms after a day and a half. */
#ifndef CAMERA_DIRECTOR_HALFLIFE_GAME_CLOCK_H
#define CAMERA_DIRECTOR_HALFLIFE_GAME_CLOCK_H

/* All 0 = before the first frame of a map. */
struct game_clock {
    int started;
    double time; /* s */
};

/* Once per server frame, with the engine's time and its frame's length in s. Returns the time, which never
 * goes back and follows the engine's where that jumps. */
double game_clock_advance(struct game_clock* clock, double engine_time, double frame_time);

#endif
