/* Shared by the examples: options for reaching the directors, numbers in options, clock, Ctrl-C. */
#ifndef CONNECTION_H
#define CONNECTION_H

#include <camera_director/camera_director.h>
#include <signal.h>
#include <stdbool.h>
#include <stdint.h>

#define CONNECTION_USAGE                                                       \
    "  --domain N            DDS domain (default 0)\n"                         \
    "  --interface NAME      network interface or address (default lo)\n"      \
    "  --directors LIST      addresses of the directors (default 127.0.0.1)\n" \
    "  --security FOLDER     identity for DDS Security (default: plain DDS)\n" \
    "  --help\n"

/* Exit codes: 0 done, 1 failed, 2 bad usage. */
enum { EXIT_USAGE = 2 };

/* Set by SIGINT and SIGTERM after catch_signals(). */
extern volatile sig_atomic_t stop_requested;
void catch_signals(void);

/* Stores the value of --domain, --interface, --directors or --security; returns false when `name` is none of
 * them. */
bool connection_option(cdir_context_options* options, const char* name, const char* value);

/* The number in an option's value. Ends the program with EXIT_USAGE when it is not a number from min to max.
 */
double number_option(const char* name, const char* value, double min, double max);

/* When a call has failed, prints the library's error and ends the program with exit code 1. */
void check(const char* what, cdir_status status);

/* CLOCK_MONOTONIC in nanoseconds, and sleeping until such a time; a signal ends the sleep early. */
int64_t monotonic_ns(void);
void sleep_until(int64_t time);

#endif
