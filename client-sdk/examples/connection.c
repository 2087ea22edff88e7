#define _POSIX_C_SOURCE 200809L

#include "connection.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

volatile sig_atomic_t stop_requested = 0;

static void request_stop(int signal_number) {
    (void)signal_number;
    stop_requested = 1;
}

void catch_signals(void) {
    struct sigaction action;
    memset(&action, 0, sizeof action);
    action.sa_handler = request_stop;
    sigaction(SIGINT, &action, NULL);
    sigaction(SIGTERM, &action, NULL);
}

double number_option(const char* name, const char* value, double min, double max) {
    char* end = NULL;
    const double number = strtod(value, &end);
    if (end == value || *end != '\0' || !(number >= min && number <= max)) {
        fprintf(stderr, "--%s: expected a number from %g to %g, not '%s'\n", name, min, max, value);
        exit(EXIT_USAGE);
    }
    return number;
}

bool connection_option(cdir_context_options* options, const char* name, const char* value) {
    if (strcmp(name, "domain") == 0) {
        options->domain = (uint32_t)number_option(name, value, 0, 230);
    } else if (strcmp(name, "interface") == 0) {
        options->network_interface = value;
    } else if (strcmp(name, "directors") == 0) {
        options->directors = value;
    } else if (strcmp(name, "security") == 0) {
        options->security = value;
    } else {
        return false;
    }
    return true;
}

void check(const char* what, cdir_status status) {
    if (status >= 0) return;
    fprintf(stderr, "%s: %s (%s)\n", what, cdir_last_error(), cdir_status_name(status));
    exit(EXIT_FAILURE);
}

int64_t monotonic_ns(void) {
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000000000 + now.tv_nsec;
}

void sleep_until(int64_t time) {
    const struct timespec until = {(time_t)(time / 1000000000), (long)(time % 1000000000)};
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, NULL);
}
