/*
 * The camera director's client library, for game servers and for observers. C11, ABI version 1.
 *
 * A game server opens a context and a match, and publishes every player's pose once a server frame:
 *
 *     cdir_context_options options = cdir_context_options_default();
 *     cdir_context context;
 *     if (cdir_context_open(&options, &context) != CDIR_OK) fail(cdir_last_error());
 *     cdir_match_info info = cdir_match_info_default();
 *     strcpy(info.match_id, "cup-7"); strcpy(info.map_name, "oa_dm1");
 *     cdir_match match;
 *     cdir_match_open(context, &info, players, player_count, &match);
 *     cdir_match_publish_poses(match, &frame);      once a server frame
 *     cdir_context_close(context);                  closes the match too
 *
 * An observer opens a context and an observer, requests a shot, and takes cameras:
 *
 *     cdir_observer_open(context, "cup-7", "anna", &observer_options, &observer);
 *     cdir_observer_request(observer, &request);
 *     cdir_observer_poll(observer, NULL);           once a display frame
 *     cdir_observer_display_time(observer, &time);
 *     cdir_observer_camera_at(observer, time, &view);
 *
 * Units and axes. Right-handed, z up; positions in map units; angles in radians; times in nanoseconds.
 * Quaternions are x y z w and turn the axes x forward, y left, z up of a player's eye or of a camera into
 * the map's axes. frame_time is the game's own clock within an epoch, and within 73 years of 0; an epoch
 * counts a match's lives: a map change or a restart begins a new one.
 *
 * Status. 0 or greater: the call did what it says, or there was nothing to do. Less than 0: the call
 * failed, changed nothing, and cdir_last_error() in the same thread says why. No call crashes on a null
 * pointer, on a handle that is closed or was never opened, or on a wrong order of calls; none throws.
 *
 * Parameter structs. Begin with the struct's _default() function, which sets struct_size: a struct that
 * was never initialised is refused. Fields named reserved must be 0. Strings are UTF-8 and end with a
 * zero byte. Everything that is passed in is copied or used up before the call returns.
 *
 * Threads. Every function may be called from every thread at any time. Calls on one match or observer wait
 * for each other; calls on different ones do not. Only cdir_observer_wait() waits for the network, and it
 * holds up no other call meanwhile; opening and closing take milliseconds.
 * Do not call from a signal handler, nor in a child process after fork().
 */
#ifndef CAMERA_DIRECTOR_CAMERA_DIRECTOR_H
#define CAMERA_DIRECTOR_CAMERA_DIRECTOR_H

/* NOLINTBEGIN(modernize-deprecated-headers,modernize-use-nullptr): C, although C++ reads it too. */
#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__)
#define CDIR_API __attribute__((visibility("default")))
#else
#define CDIR_API
#endif

#ifdef __cplusplus
#define CDIR_NOEXCEPT noexcept
extern "C" {
#else
#define CDIR_NOEXCEPT
#endif

#define CDIR_ABI_VERSION 1u

/* ---------------------------------------------------------------------------------------- status */

typedef int32_t cdir_status;

enum {
    CDIR_OK = 0,
    CDIR_NO_DATA = 1,     /* nothing of the kind has arrived (yet) */
    CDIR_TIMEOUT = 2,     /* the time was over before anything arrived */
    CDIR_INTERRUPTED = 3, /* cdir_observer_interrupt() or a close ended the wait */
    CDIR_TRUNCATED = 4,   /* done, but the caller's array holds only the first elements */

    CDIR_INVALID_ARGUMENT = -1, /* a null pointer, a number out of range, an id that is not allowed */
    CDIR_INVALID_HANDLE = -2,   /* never opened, or closed */
    CDIR_BUSY = -3,             /* the send queue is full: nothing was sent, try again later */
    CDIR_CONFLICT = -4,         /* does not go together with what is already open or was said before */
    CDIR_NETWORK = -5,          /* DDS refused: the text says what and why */
    CDIR_OUT_OF_MEMORY = -6,
    CDIR_INTERNAL = -7 /* a bug in this library */
};

/* The ABI version of the loaded library: equal to CDIR_ABI_VERSION, or greater when only functions and
 * fields were added. */
CDIR_API uint32_t cdir_abi_version(void) CDIR_NOEXCEPT;

/* "CDIR_OK" and so on; "unknown status" for any other number. */
CDIR_API const char* cdir_status_name(cdir_status status) CDIR_NOEXCEPT;

/* Why the last call of this thread that returned less than 0 did so. Never null; empty before the first
 * failure. Valid until the next failing call of this thread. */
CDIR_API const char* cdir_last_error(void) CDIR_NOEXCEPT;

/* --------------------------------------------------------------------------------- shared limits */

#define CDIR_MAX_PLAYERS 256u
#define CDIR_MAX_CAMERAS 256u
#define CDIR_NO_PLAYER 0xffffffffu     /* in events: nobody */
#define CDIR_CHOOSE_TARGET 0xffffffffu /* as a shot's target: the director chooses */

/* Handles. Values that can be copied; 0 is never a handle; a closed handle is recognised and refused. */
typedef struct cdir_context {
    uint64_t id;
} cdir_context;
typedef struct cdir_match {
    uint64_t id;
} cdir_match;
typedef struct cdir_observer {
    uint64_t id;
} cdir_observer;

/* --------------------------------------------------------------------------------------- context */

/* How this process reaches the directors. */
typedef struct cdir_context_options {
    uint32_t struct_size;
    uint32_t domain; /* DDS domain, 0 .. 230 */
    /* Name or address of the network interface; empty = the system's first that is up. */
    const char* network_interface;
    /* The directors' addresses, separated by commas: "10.0.0.5, 10.0.0.6" or "10.0.0.5:7412". Without a
     * port: that of the first participant of the domain on that host, which a director is by default. */
    const char* directors;
    /* Null, or a whole Cyclone DDS configuration (XML) to use instead of the two fields above; for
     * multicast, DDS Security and the like. The environment variable CYCLONEDDS_URI is not read. */
    const char* cyclone_xml;
} cdir_context_options;

/* Domain 0 on this host only: interface "lo", director "127.0.0.1". */
static inline cdir_context_options cdir_context_options_default(void) {
    cdir_context_options options = {sizeof(cdir_context_options), 0u, "lo", "127.0.0.1", NULL};
    return options;
}

/* Joins the domain. Contexts of one domain in one process share its network settings: another context
 * with different ones is refused with CDIR_CONFLICT. Endpoints that the application itself made in the
 * domain with Cyclone DDS before are left alone, and so are their network settings; what it makes after
 * this call dies with the last context of the domain. Open the context before the process holds
 * 1000 file descriptors: Cyclone DDS cannot use higher ones, and CDIR_CONFLICT is returned. */
CDIR_API cdir_status cdir_context_open(const cdir_context_options* options,
                                       cdir_context* context) CDIR_NOEXCEPT;

/* Closes the matches and observers of the context and leaves the domain. Contexts that are still open
 * when the process exits are closed then. */
CDIR_API cdir_status cdir_context_close(cdir_context context) CDIR_NOEXCEPT;

/* ----------------------------------------------------------------------------------- match info */

typedef struct cdir_player {
    uint32_t id; /* anything but CDIR_NO_PLAYER; unique within the match */
    uint8_t team;
    uint8_t reserved[3];
    char name[64];
    char player_class[32];
} cdir_player;

typedef struct cdir_match_info {
    uint32_t struct_size;
    float metres_per_unit;   /* > 0: metres that one map unit is long */
    float rate_hz;           /* > 0: pose frames a second that the game server intends to publish */
    float spectator_delay_s; /* >= 0: how much later than the game observers may see it */
    uint64_t epoch;          /* to open or restart a match: 0 = chosen by the library, and greater than any
                                chosen before, also by an earlier process; to update one: ignored */
    uint64_t map_hash;       /* xxh3-64 of the map file's bytes; 0 = unknown */
    char match_id[64];       /* 1 .. 63 bytes without '/', '*', '?' and control characters */
    char map_name[256];      /* 1 .. 255 bytes: the map's name in the director's configuration */
} cdir_match_info;

/* 0.0254 metres a unit (Quake and Half-Life maps), 60 Hz, no delay. */
static inline cdir_match_info cdir_match_info_default(void) {
    cdir_match_info info = {sizeof(cdir_match_info), 0.0254f, 60.0f, 0.0f, 0u, 0u, {0}, {0}};
    return info;
}

/* ----------------------------------------------------------------------------------- game server */

/* Announces a match and its players. Each match_id has one game server at a time: two that publish the
 * same id confuse the director. */
CDIR_API cdir_status cdir_match_open(cdir_context context, const cdir_match_info* info,
                                     const cdir_player* players, uint32_t player_count,
                                     cdir_match* match) CDIR_NOEXCEPT;

/* Replaces the match's rate, delay and players: somebody joined, left or changed the team. match_id, map
 * and metres_per_unit must be as before (CDIR_CONFLICT). */
CDIR_API cdir_status cdir_match_update(cdir_match match, const cdir_match_info* info,
                                       const cdir_player* players, uint32_t player_count) CDIR_NOEXCEPT;

/* Begins a new epoch: the map changed or the game started again. frame_time may start again too.
 * match_id must be as before, and an epoch that is not 0 greater than before (CDIR_CONFLICT). */
CDIR_API cdir_status cdir_match_restart(cdir_match match, const cdir_match_info* info,
                                        const cdir_player* players, uint32_t player_count) CDIR_NOEXCEPT;

enum {
    CDIR_POSE_ALIVE = 1,
    CDIR_POSE_DISCONTINUITY = 2, /* respawned or teleported since the frame before */
    CDIR_POSE_SPECTATOR = 4      /* not in the game: never a target */
};

/* All players' poses at one instant, in the caller's arrays. */
typedef struct cdir_pose_frame {
    uint32_t struct_size;
    uint32_t player_count;     /* n <= CDIR_MAX_PLAYERS; with 0 the arrays may be null */
    int64_t frame_time;        /* must not go back within an epoch */
    int64_t source_time;       /* CLOCK_REALTIME when the poses were sampled; 0 = now */
    const uint32_t* player_id; /* n */
    const float* eye;          /* 3n */
    const float* orientation;  /* 4n, of length 1 within 1e-3 */
    const float* velocity;     /* 3n, map units a second; null = unknown */
    const uint32_t* flags;     /* n, of CDIR_POSE_ */
} cdir_pose_frame;

static inline cdir_pose_frame cdir_pose_frame_default(void) {
    cdir_pose_frame frame = {sizeof(cdir_pose_frame), 0u, 0, 0, NULL, NULL, NULL, NULL, NULL};
    return frame;
}

/* Publishes one frame, best effort: a director that is late gets the newest. Never waits for a receiver;
 * sending costs a system call for each director (about 0.1 ms), which a game may prefer to pay in a
 * thread of its own. */
CDIR_API cdir_status cdir_match_publish_poses(cdir_match match, const cdir_pose_frame* frame) CDIR_NOEXCEPT;

enum {
    CDIR_EVENT_KILL = 1,
    CDIR_EVENT_FLAG_TAKEN = 2,
    CDIR_EVENT_FLAG_CAPTURED = 3,
    CDIR_EVENT_OBJECTIVE = 4,
    CDIR_EVENT_DAMAGE = 5,
    CDIR_EVENT_AWARD = 6
};

typedef struct cdir_match_event {
    uint32_t struct_size;
    uint32_t kind; /* of CDIR_EVENT_ */
    int64_t frame_time;
    uint32_t actor;   /* player id or CDIR_NO_PLAYER */
    uint32_t subject; /* player id or CDIR_NO_PLAYER */
    float value;      /* points, damage and the like; finite */
    uint32_t reserved;
} cdir_match_event;

static inline cdir_match_event cdir_match_event_default(void) {
    cdir_match_event event = {
        sizeof(cdir_match_event), CDIR_EVENT_KILL, 0, CDIR_NO_PLAYER, CDIR_NO_PLAYER, 0.0f, 0u};
    return event;
}

/* Publishes one event, reliably. CDIR_BUSY when a director is too far behind to take it. */
CDIR_API cdir_status cdir_match_publish_event(cdir_match match, const cdir_match_event* event) CDIR_NOEXCEPT;

/* How many directors read this match's poses now; for "is anybody there?". */
CDIR_API cdir_status cdir_match_director_count(cdir_match match, uint32_t* count) CDIR_NOEXCEPT;

/* Withdraws the match. */
CDIR_API cdir_status cdir_match_close(cdir_match match) CDIR_NOEXCEPT;

/* -------------------------------------------------------------------------------------- observer */

typedef struct cdir_observer_options {
    uint32_t struct_size;
    uint32_t reserved;
    /* How far the display stays behind the newest camera frame, 0 .. 10 s: long enough to have a frame on
     * either side when one is late, or the view stands still. Two to four frames serve well. */
    int64_t interpolation_delay;
} cdir_observer_options;

/* 50 ms: three frames at 60 Hz. */
static inline cdir_observer_options cdir_observer_options_default(void) {
    cdir_observer_options options = {sizeof(cdir_observer_options), 0u, 50000000};
    return options;
}

/* Begins to observe a match, whether it is there already or not. observer_id: 1 .. 63 bytes without
 * control characters, unique within the match. null options = the default. */
CDIR_API cdir_status cdir_observer_open(cdir_context context, const char* match_id, const char* observer_id,
                                        const cdir_observer_options* options,
                                        cdir_observer* observer) CDIR_NOEXCEPT;

typedef struct cdir_shot_request {
    uint32_t struct_size;
    uint32_t target;       /* player id or CDIR_CHOOSE_TARGET */
    const uint32_t* group; /* players to choose the target among; null = all */
    const char* profile;   /* camera profile of the director's configuration, up to 31 bytes; null or "" =
                              its default */
    const char* overrides; /* JSON object with a profile's keys, up to 1023 bytes; null or "" = none */
    uint32_t group_count;  /* <= CDIR_MAX_PLAYERS */
    uint32_t reserved;
} cdir_shot_request;

/* The director chooses the target among all players, with its default profile. */
static inline cdir_shot_request cdir_shot_request_default(void) {
    cdir_shot_request request = {sizeof(cdir_shot_request), CDIR_CHOOSE_TARGET, NULL, NULL, NULL, 0u, 0u};
    return request;
}

/* Asks for a shot, or changes the one asked for. The request dies with the observer. */
CDIR_API cdir_status cdir_observer_request(cdir_observer observer,
                                           const cdir_shot_request* request) CDIR_NOEXCEPT;

/* Takes the request back. CDIR_CONFLICT when there is none. */
CDIR_API cdir_status cdir_observer_withdraw(cdir_observer observer) CDIR_NOEXCEPT;

/* Waits until something arrived that poll or next_frame would take. timeout in nanoseconds, 0 = only
 * look, negative = without limit. CDIR_OK, CDIR_TIMEOUT or CDIR_INTERRUPTED. */
CDIR_API cdir_status cdir_observer_wait(cdir_observer observer, int64_t timeout) CDIR_NOEXCEPT;

/* Ends the waits in progress, or the next one if there is none. */
CDIR_API cdir_status cdir_observer_interrupt(cdir_observer observer) CDIR_NOEXCEPT;

/* Takes all that arrived. frame_count (may be null): camera frames among it. What the calls below return
 * changes only here and in cdir_observer_next_frame(). */
CDIR_API cdir_status cdir_observer_poll(cdir_observer observer, uint32_t* frame_count) CDIR_NOEXCEPT;

enum {
    CDIR_CAMERA_CUT = 1,            /* a declared jump from the frame before */
    CDIR_CAMERA_TARGET_VISIBLE = 2, /* nothing between the camera and the player's eye */
    CDIR_CAMERA_SEARCHING = 4,      /* on the way to a player who got out of sight */
    CDIR_CAMERA_TARGET_ABSENT = 8,  /* the player has no pose */
    CDIR_CAMERA_HELD = 16           /* keeps its place: the player is dead, or there is nowhere to go */
};

typedef struct cdir_camera {
    uint32_t camera_id;
    uint32_t target; /* player id */
    float position[3];
    float orientation[4];
    float vertical_fov; /* radians, 0 .. pi */
    float clearance;    /* map units that the camera is certainly away from any obstacle */
    uint32_t flags;     /* of CDIR_CAMERA_ */
} cdir_camera;

typedef struct cdir_camera_frame {
    uint32_t struct_size;
    uint32_t camera_count;
    uint64_t epoch;
    uint64_t director_id;
    int64_t frame_time;    /* of the poses that the cameras answer */
    int64_t source_time;   /* likewise */
    int64_t write_time;    /* CLOCK_REALTIME of the director */
    uint32_t frame_number; /* counts the director's frames in the epoch */
    uint32_t pose_number;  /* number of the pose frame that the cameras answer */
} cdir_camera_frame;

static inline cdir_camera_frame cdir_camera_frame_default(void) {
    cdir_camera_frame frame = {sizeof(cdir_camera_frame), 0u, 0u, 0u, 0, 0, 0, 0u, 0u};
    return frame;
}

/* For broadcasters and recorders: takes the next camera frame, oldest first, with the cameras of all shots
 * of the match. Up to capacity cameras are stored (CDIR_TRUNCATED when there are more; camera_count says
 * how many). CDIR_NO_DATA when none waits. Also updates all that cdir_observer_poll() updates. */
CDIR_API cdir_status cdir_observer_next_frame(cdir_observer observer, cdir_camera_frame* frame,
                                              cdir_camera* cameras, uint32_t capacity) CDIR_NOEXCEPT;

enum {
    CDIR_SHOT_REFUSED = 0, /* the reason says why */
    CDIR_SHOT_ACCEPTED = 1,
    CDIR_SHOT_WAITING_FOR_MAP = 2,
    CDIR_SHOT_WAITING_FOR_PLAYER = 3,
    CDIR_SHOT_NOT_REQUESTED = 100,
    CDIR_SHOT_UNANSWERED = 101 /* requested, and no director has answered, or it is gone */
};

typedef struct cdir_shot_status {
    uint32_t struct_size;
    uint32_t state;     /* of CDIR_SHOT_ */
    uint64_t epoch;     /* of the director's answer */
    uint32_t camera_id; /* which camera of a frame is the shot's; with state accepted */
    uint32_t reserved;
    char reason[256];
} cdir_shot_status;

static inline cdir_shot_status cdir_shot_status_default(void) {
    cdir_shot_status status = {sizeof(cdir_shot_status), CDIR_SHOT_NOT_REQUESTED, 0u, 0u, 0u, {0}};
    return status;
}

/* What the director made of the request. */
CDIR_API cdir_status cdir_observer_shot_status(cdir_observer observer,
                                               cdir_shot_status* status) CDIR_NOEXCEPT;

/* The shot's camera at one time. */
typedef struct cdir_view {
    uint32_t struct_size;
    uint32_t segment;   /* changes with every cut, and wherever frames are missing: do not blend the picture
                           across a change */
    int64_t frame_time; /* that the camera belongs to */
    int64_t late;       /* how far the time asked for lies after the newest frame: the camera stands still
                           meanwhile; 0 = not at all */
    cdir_camera camera;
} cdir_view;

static inline cdir_view cdir_view_default(void) {
    cdir_view view = {sizeof(cdir_view), 0u, 0, 0, {0u, 0u, {0}, {0}, 0.0f, 0.0f, 0u}};
    return view;
}

/* The newest camera of the shot, as it was received. CDIR_NO_DATA when there is none in this epoch. */
CDIR_API cdir_status cdir_observer_newest_camera(cdir_observer observer, cdir_view* view) CDIR_NOEXCEPT;

/* The shot's camera at a time of the frame_time axis, interpolated between the two frames around it, never
 * across a cut or a missing frame. Before the oldest frame kept (64 are) the oldest, after the newest the
 * newest. CDIR_NO_DATA when there is none in this epoch. */
CDIR_API cdir_status cdir_observer_camera_at(cdir_observer observer, int64_t frame_time,
                                             cdir_view* view) CDIR_NOEXCEPT;

/* The time of the frame_time axis to display now: interpolation_delay behind the game as its frames arrive
 * here. Runs smoothly and never goes back within an epoch. CDIR_NO_DATA before the first frame. */
CDIR_API cdir_status cdir_observer_display_time(cdir_observer observer, int64_t* frame_time) CDIR_NOEXCEPT;

/* The match and up to capacity of its players (CDIR_TRUNCATED when there are more; player_count, which may
 * be null, says how many). CDIR_NO_DATA when it is unknown: it comes from the game server itself, which
 * the network settings must let an observer discover; cameras do not depend on it. */
CDIR_API cdir_status cdir_observer_match_info(cdir_observer observer, cdir_match_info* info,
                                              cdir_player* players, uint32_t capacity,
                                              uint32_t* player_count) CDIR_NOEXCEPT;

/* Since the observer was opened. */
typedef struct cdir_observer_counters {
    uint32_t struct_size;
    uint32_t directors;   /* that write this match's cameras now */
    uint64_t frames;      /* camera frames taken */
    uint64_t gaps;        /* camera frames that are missing between those, by frame_number */
    uint64_t hand_overs;  /* changes of the director within an epoch */
    uint64_t stale_epoch; /* samples dropped because their epoch is over */
    uint64_t invalid;     /* samples dropped because they break the contract */
} cdir_observer_counters;

static inline cdir_observer_counters cdir_observer_counters_default(void) {
    cdir_observer_counters counters = {sizeof(cdir_observer_counters), 0u, 0u, 0u, 0u, 0u, 0u};
    return counters;
}

CDIR_API cdir_status cdir_observer_get_counters(cdir_observer observer,
                                                cdir_observer_counters* counters) CDIR_NOEXCEPT;

/* Ends the waits in progress and withdraws the request. */
CDIR_API cdir_status cdir_observer_close(cdir_observer observer) CDIR_NOEXCEPT;

#ifdef __cplusplus
}
#endif
/* NOLINTEND(modernize-deprecated-headers,modernize-use-nullptr) */

#endif
