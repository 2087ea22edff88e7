#include "game_clock.h"

#include <math.h>

static const double greatest_error = 0.25; /* s: more than a float's step and the sum of the frames' errors */

double game_clock_advance(struct game_clock* clock, double engine_time, double frame_time) {
    const double next = frame_time > 0.0 ? clock->time + frame_time : clock->time;
    if (!clock->started || fabs(engine_time - next) > greatest_error) {
        if (!clock->started || engine_time > clock->time) clock->time = engine_time;
    } else {
        clock->time = next;
    }
    clock->started = 1;
    return clock->time;
}
