/*
 * The camera director's client library, for game servers and for observers (spectator clients). C11, ABI
 * version 2.
 *
 * A game server opens a context and a match, and publishes the players' poses once per server frame:
 *
 *     cdir_context_options options = cdir_context_options_default();
 *     cdir_context context;
 *     if (cdir_context_open(&options, &context) < 0) fail(cdir_last_error());
 *     cdir_match_info info = cdir_match_info_default();
 *     strcpy(info.match_id, "cup-7");
 *     strcpy(info.map_name, "oa_dm1");
 *     cdir_match match;
 *     if (cdir_match_open(context, &info, players, player_count, &match) < 0) fail(cdir_last_error());
 *     cdir_match_publish_poses(match, &frame);      once per server frame
 *     cdir_context_close(context);                  also closes the match
 *
 * An observer opens a context and an observer, requests a shot, and reads cameras:
 *
 *     cdir_observer_open(context, "cup-7", "anna", NULL, &observer);
 *     cdir_observer_request(observer, &request);
 *     cdir_observer_poll(observer, NULL);           once per display frame
 *     cdir_observer_display_time(observer, &time);
 *     cdir_observer_camera_at(observer, time, &camera, &view);
 *
 * Axes and units. Right-handed, z up. Positions are in map units, angles in radians, times in nanoseconds.
 * A quaternion is x y z w and has length 1. It rotates the axes of a player's eye or of a camera (x forward,
 * y left, z up) into the axes of the map. cdir_position_from_engine() and its likes convert those of engines.
 *
 * Time. frame_time is the game's own clock within an epoch, at most 2^61 ns (73 years) from 0. source_time
 * and write_time are the sender's clock, since 1970-01-01 00:00 UTC. An epoch is one life of a match: every
 * map change and every restart begins a new one, with a greater number.
 *
 * Status. Functions return 0 or more when they did what they say or had nothing to do. They return less than
 * 0 when they failed; then cdir_last_error() in the same thread gives the reason, and handles and output
 * parameters are unchanged. Null pointers, closed or invalid handles and calls in the wrong order are errors;
 * they never crash. No exception leaves the library.
 *
 * Structs. Every struct begins with struct_size, its size where the caller was compiled. Initialise it with
 * its _default() function, in other languages than C and C++ with its _init() function: they set struct_size
 * and the defaults. Later versions of this library add fields at a struct's end and change nothing else. So
 * the library accepts every struct_size from that of ABI version 2 to its own: what a caller does not have
 * keeps its default, and is not written. A greater one is refused: the program was compiled for a later
 * library. In an array of structs the first one's struct_size is also the distance from each to the next.
 * Sizes and offsets are the same on every platform: no field depends on a compiler's padding, and a pointer
 * takes 8 bytes. Fields named reserved must be 0. Strings are UTF-8 and zero-terminated. The library keeps no
 * pointer that is passed to it: the caller's memory is its own again when the call returns.
 *
 * Threads. Every function may be called from any thread at any time. Calls on the same match or observer are
 * serialised; calls on different ones run concurrently. cdir_observer_wait() and cdir_context_wait() block
 * for long, and other calls on the same handle proceed meanwhile; opening and closing a context do where a
 * name server is slow. Closing waits, for up to a second, for the calls in progress on what is closed.
 * Closing a match or an observer takes up to 0.3 s where a director does not acknowledge what was sent to it
 * last, or, with cyclone_xml, as long as that lets it linger; a context closes its own one after another. All
 * else takes milliseconds at most. Do not call the library from a signal handler or, after fork(), from the
 * child process.
 */
#ifndef CAMERA_DIRECTOR_CAMERA_DIRECTOR_H
#define CAMERA_DIRECTOR_CAMERA_DIRECTOR_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(CDIR_BUILDING_LIBRARY)
#define CDIR_API __declspec(dllexport)
#elif defined(_WIN32)
#define CDIR_API __declspec(dllimport)
#elif defined(__GNUC__)
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

#define CDIR_ABI_VERSION 2u

/* A pointer in a struct, in 8 bytes also where pointers have 4: the others are not read. */
#if UINTPTR_MAX > 0xffffffffu
#define CDIR_POINTER(type, name) type name
#else
#define CDIR_POINTER(type, name) \
    type name;                   \
    uint32_t name##_unused
#endif

/* Declares type_init(), which does nothing with a null pointer, and type_default(). */
#define CDIR_DEFAULTS(type)                                                  \
    CDIR_API void type##_init(type* to, uint32_t struct_size) CDIR_NOEXCEPT; \
    static inline type type##_default(void) {                                \
        type made;                                                           \
        type##_init(&made, (uint32_t)sizeof made);                           \
        return made;                                                         \
    }

/* ---------------------------------------------------------------------------------------- status */

typedef int32_t cdir_status;

enum {
    CDIR_OK = 0,
    CDIR_NO_DATA = 1,     /* no such data has arrived yet */
    CDIR_TIMEOUT = 2,     /* nothing arrived within the timeout */
    CDIR_INTERRUPTED = 3, /* the wait was ended by cdir_observer_interrupt() or by closing */
    CDIR_TRUNCATED = 4,   /* done, but the caller's array was too short for all elements */

    CDIR_INVALID_ARGUMENT = -1, /* null pointer, value out of range, or malformed id */
    CDIR_INVALID_HANDLE = -2,   /* never opened, or closed */
    CDIR_BUSY = -3,             /* the send queue is full or the context not open yet: nothing was done, try
                                   again later */
    CDIR_CONFLICT = -4,         /* contradicts what is already open or was published before */
    CDIR_NETWORK = -5,          /* DDS refused; cdir_last_error() says what and why */
    CDIR_OUT_OF_MEMORY = -6,
    CDIR_INTERNAL = -7 /* a bug in this library */
};

/* The ABI version of the loaded library: CDIR_ABI_VERSION, or greater if the library only adds to it. */
CDIR_API uint32_t cdir_abi_version(void) CDIR_NOEXCEPT;

/* The constant's name, such as "CDIR_OK"; "unknown status" for any other number. Never null. */
CDIR_API const char* cdir_status_name(cdir_status status) CDIR_NOEXCEPT;

/* The reason of this thread's last failed call, one line of at most 511 bytes. Never null; empty before the
 * first failure. Valid until this thread's next failed call or end. */
CDIR_API const char* cdir_last_error(void) CDIR_NOEXCEPT;

/* --------------------------------------------------------------------------------- shared limits */

#define CDIR_MAX_PLAYERS 256u
#define CDIR_MAX_CAMERAS 256u
#define CDIR_MAX_MOVERS 256u
#define CDIR_MAX_HULLS 256u            /* of one mover, and as many balls */
#define CDIR_MAX_HALF_SPACES 64u       /* of one hull */
#define CDIR_MAX_SHAPES 2048u          /* half spaces of all movers of a match, and as many balls */
#define CDIR_NO_PLAYER 0xffffffffu     /* in events: no player */
#define CDIR_CHOOSE_TARGET 0xffffffffu /* as a shot's target: the director chooses */
#define CDIR_SHOW_GROUP 0xfffffffeu    /* as a shot's target: the players of its group together */
#define CDIR_MAX_GROUP_SHOT 4u         /* players of such a group */

/* Handles: plain values, free to copy. 0 is never a valid handle. Closed handles are detected and refused. */
typedef struct cdir_context {
    uint64_t id;
} cdir_context;
typedef struct cdir_match {
    uint64_t id;
} cdir_match;
typedef struct cdir_observer {
    uint64_t id;
} cdir_observer;

/* --------------------------------------------------------------------------------------- library */

/* Memory for what handles stand for: contexts, matches and observers, with their poses, players and cameras.
 * Names, the tables of handles, and what lives during a call only are in the C++ runtime's memory, and what
 * Cyclone DDS holds in malloc()'s.
 * Returns `size` bytes at a multiple of `alignment`, a power of two; null when there are none. */
typedef void* (*cdir_allocate_function)(void* user_data, size_t size, size_t alignment);
/* Takes back what cdir_allocate_function has returned for this size and alignment. */
typedef void (*cdir_free_function)(void* user_data, void* memory, size_t size, size_t alignment);

enum { CDIR_LOG_ERROR = 1, CDIR_LOG_WARNING = 2, CDIR_LOG_INFO = 3 };

/* Takes a message of Cyclone DDS for people: one line of UTF-8 without its end, valid during the call. */
typedef void (*cdir_log_function)(void* user_data, uint32_t level, const char* text);

/* For the whole process. The functions are called on any thread, the log on one at a time. They must not
 * throw, nor call this library. */
typedef struct cdir_library_options {
    uint32_t struct_size;
    uint32_t reserved;
    CDIR_POINTER(cdir_allocate_function, allocate); /* both or none */
    CDIR_POINTER(cdir_free_function, free);
    CDIR_POINTER(void*, allocator_data); /* their user_data */
    CDIR_POINTER(cdir_log_function, log);
    CDIR_POINTER(void*, log_data); /* its user_data */
} cdir_library_options;

/* The C++ runtime's memory; messages go to standard error. */
CDIR_DEFAULTS(cdir_library_options)

/* Replaces these options. A context, match or observer keeps the allocator that it was opened with until it
 * is closed, calls in progress included. The previous log is not called any more when this returns. */
CDIR_API cdir_status cdir_library_configure(const cdir_library_options* options) CDIR_NOEXCEPT;

/* --------------------------------------------------------------------------------------- context */

/* How this process reaches the directors. The strings must not be null unless cyclone_xml is given. */
typedef struct cdir_context_options {
    uint32_t struct_size;
    uint32_t domain; /* DDS domain, 0 .. 230 */
    /* Name or address of the network interface; empty = Cyclone DDS chooses one. */
    CDIR_POINTER(const char*, network_interface);
    /* The directors' addresses or host names, separated by commas: "10.0.0.5, 10.0.0.6" or "10.0.0.5:7412".
     * The default port is that of DDS participant index 0 on the host, which a director has by default. */
    CDIR_POINTER(const char*, directors);
    /* Null, or a complete Cyclone DDS configuration (XML) that replaces the two fields above, for instance
     * for multicast. The environment variable CYCLONEDDS_URI is ignored. */
    CDIR_POINTER(const char*, cyclone_xml);
    /* Null, or for DDS Security the folder of this program's identity, made by deploy/security/authority.sh.
     * The directors need one of the same authority; a domain is either secure or plain. */
    CDIR_POINTER(const char*, security);
} cdir_context_options;

/* Domain 0 on this host only: network_interface "lo", directors "127.0.0.1". Plain DDS. */
CDIR_DEFAULTS(cdir_context_options)

/* Joins the domain. Waits for a name server where `directors` has names.
 * CDIR_CONFLICT: a context of this process has the domain open with other network settings or another
 * identity, or the process holds too many file descriptors: Cyclone DDS needs some below 1000.
 * CDIR_OUT_OF_MEMORY: also when the system gives no thread or no file descriptor.
 * CDIR_INVALID_ARGUMENT: a file is missing in the folder `security`, or its key is open to everyone.
 * CDIR_NETWORK: no address of `directors` can be resolved, or Cyclone DDS refuses the options, for instance
 * an unknown interface or an expired identity. Later, where the identity is not allowed what it opens: an
 * observer's in cdir_match_open(), a game server's in cdir_observer_open(), or that of other matches. When
 * the application itself has joined the domain with Cyclone DDS before, its network settings remain in force.
 * DDS entities that it creates in the domain after this call are deleted with the domain's last context. */
CDIR_API cdir_status cdir_context_open(const cdir_context_options* options,
                                       cdir_context* context) CDIR_NOEXCEPT;

/* As cdir_context_open(), but returns before anything is resolved or joined, which a thread of the library
 * does. Only malformed options fail at once. Until cdir_context_wait() says that the context is open, opening
 * a match or an observer in it fails with CDIR_BUSY; afterwards, when it could not be opened, with the same
 * status and reason as that. It must be closed in any case. */
CDIR_API cdir_status cdir_context_open_async(const cdir_context_options* options,
                                             cdir_context* context) CDIR_NOEXCEPT;

/* Waits until the context is open. timeout: nanoseconds, 0 = do not wait, negative = without limit. Returns
 * CDIR_OK, CDIR_TIMEOUT, or the status of cdir_context_open() when it could not be opened. */
CDIR_API cdir_status cdir_context_wait(cdir_context context, int64_t timeout) CDIR_NOEXCEPT;

/* Waits until an attempt to open it has ended. Closes the context's matches and observers, and leaves the
 * domain with its last context. Contexts that are open when the process exits are closed then. */
CDIR_API cdir_status cdir_context_close(cdir_context context) CDIR_NOEXCEPT;

/* --------------------------------------------------------------------------------- axes and units */

/* How an engine counts. Its orientations are quaternions x y z w that rotate its own axes. */
enum {
    CDIR_ENGINE_QUAKE = 1, /* Quake, GoldSrc, Source: x forward, y left, z up; 0.0254 m */
    CDIR_ENGINE_UNITY = 2, /* x right, y up, z forward: left-handed; 1 m */
    CDIR_ENGINE_UNREAL = 3 /* x forward, y right, z up: left-handed; 0.01 m */
};

/* Convert a position or a velocity (3 numbers, finite) from an engine's axes and units to those of a map with
 * so many metres_per_unit (> 0, as in cdir_match_info), and back. The two arrays may be the same. */
CDIR_API cdir_status cdir_position_from_engine(uint32_t engine, float metres_per_unit, const float* position,
                                               float* converted) CDIR_NOEXCEPT;
CDIR_API cdir_status cdir_position_to_engine(uint32_t engine, float metres_per_unit, const float* position,
                                             float* converted) CDIR_NOEXCEPT;

/* Convert an orientation (4 numbers, of length 1 within 1e-3) from an engine's axes to the map's, and back.
 * The two arrays may be the same. */
CDIR_API cdir_status cdir_orientation_from_engine(uint32_t engine, const float* orientation,
                                                  float* converted) CDIR_NOEXCEPT;
CDIR_API cdir_status cdir_orientation_to_engine(uint32_t engine, const float* orientation,
                                                float* converted) CDIR_NOEXCEPT;

/* Convert between the view angles (3 numbers) of Quake, GoldSrc and Source and an orientation (4 numbers).
 * Pitch (positive looks down), yaw and roll are degrees: any finite ones, and back pitch from -90 to 90, yaw
 * and roll from -180 to 180, and roll 0 where the view is vertical. */
CDIR_API cdir_status cdir_orientation_from_angles(const float* angles, float* orientation) CDIR_NOEXCEPT;
CDIR_API cdir_status cdir_orientation_to_angles(const float* orientation, float* angles) CDIR_NOEXCEPT;

/* ----------------------------------------------------------------------------------- match info */

/* What a director passes on to observers, and shows to its operator. */
typedef struct cdir_player {
    uint32_t struct_size;
    uint32_t id;  /* less than CDIR_SHOW_GROUP; unique within the match */
    uint8_t team; /* 0 = of none: everybody's enemy. Automatic shots go by it. */
    uint8_t reserved[7];
    char name[64];
    char player_class[32];
} cdir_player;

/* Player 0 of team 0, without name and class. */
CDIR_DEFAULTS(cdir_player)

typedef struct cdir_match_info {
    uint32_t struct_size;
    /* > 0: length of one map unit in metres. For observers, who convert with cdir_position_to_engine();
     * directors go by the map that they have baked, and warn in their log when its length differs. They tell
     * 0 where neither a game server without this SDK nor a map that they have loaded says it. */
    float metres_per_unit;
    /* > 0: pose frames per second that the game server intends to publish. For observers: camera frames per
     * second, which are fewer while a director's machine is too small. */
    float rate_hz;
    /* >= 0: observers receive cameras and this description at least so late; later when the director's
     * operator wants a longer delay. Directors refuse every shot of a match with more than 120: reason in
     * cdir_shot_status says so. A longer one than before stops the cameras until it is filled, a shorter one
     * takes effect with the next epoch. */
    float spectator_delay_s;
    /* open and restart: 0 = taken from the system clock, which makes it greater than those of earlier
     * processes; update: ignored. Observers drop what arrives of an earlier epoch than the one that is shown.
     */
    uint64_t epoch;
    uint64_t map_hash;  /* xxh3-64 of the map file's bytes; 0 = unknown */
    char match_id[64];  /* 1 .. 63 bytes without '/', '*', '?' and control characters */
    char map_name[256]; /* 1 .. 255 bytes: the map's name in the director's configuration */
} cdir_match_info;

/* 0.0254 metres per unit (Quake and Half-Life maps), 60 Hz, no delay. */
CDIR_DEFAULTS(cdir_match_info)

/* ----------------------------------------------------------------------------------- game server */

/* Announces a match and its players. players: player_count <= CDIR_MAX_PLAYERS elements; may be null for 0. A
 * match_id must have only one game server at a time: the director cannot tell two apart.
 * CDIR_INVALID_ARGUMENT: a field of info or of players[i] is out of its range; cdir_last_error() names it.
 * CDIR_BUSY: the context is not open yet, see cdir_context_open_async(). */
CDIR_API cdir_status cdir_match_open(cdir_context context, const cdir_match_info* info,
                                     const cdir_player* players, uint32_t player_count,
                                     cdir_match* match) CDIR_NOEXCEPT;

/* Replaces the match's rate, delay and players, for instance when a player joins, leaves or changes team.
 * CDIR_CONFLICT: match_id, map_name, map_hash or metres_per_unit differ from before; restart the match.
 * CDIR_BUSY: a director is so far behind that the send queue is full. */
CDIR_API cdir_status cdir_match_update(cdir_match match, const cdir_match_info* info,
                                       const cdir_player* players, uint32_t player_count) CDIR_NOEXCEPT;

/* Begins a new epoch after a map change or a restart of the game. frame_time may start again, and the counts
 * of discontinuities do. With a delay, observers see the old epoch to its end before the new one.
 * CDIR_CONFLICT: match_id differs from before, or epoch is neither 0 nor greater than before.
 * CDIR_BUSY: as cdir_match_update(). */
CDIR_API cdir_status cdir_match_restart(cdir_match match, const cdir_match_info* info,
                                        const cdir_player* players, uint32_t player_count) CDIR_NOEXCEPT;

/* Stores the number of the match's present epoch, which a shot's status and camera frames carry, too. */
CDIR_API cdir_status cdir_match_epoch(cdir_match match, uint64_t* epoch) CDIR_NOEXCEPT;

enum {
    CDIR_POSE_ALIVE = 1,
    CDIR_POSE_DISCONTINUITY = 2, /* respawned or teleported since the previous frame */
    CDIR_POSE_SPECTATOR = 4      /* not in the game: never a target */
};

/* The poses of all players at one instant, in the caller's arrays. An array's stride is the distance in bytes
 * from one player's element to the next, so that the arrays may be fields of the engine's own structs; 0 =
 * packed. */
typedef struct cdir_pose_frame {
    uint32_t struct_size;
    uint32_t player_count; /* n <= CDIR_MAX_PLAYERS; for 0 the arrays may be null */
    int64_t frame_time;    /* not less than that of the epoch's previous frame */
    int64_t source_time;   /* when the poses were sampled, since 1970-01-01 00:00 UTC; 0 = now */
    CDIR_POINTER(const uint32_t*, player_id); /* n, distinct, each less than CDIR_SHOW_GROUP */
    CDIR_POINTER(const float*, eye);          /* n times 3: positions of the eyes, map units, finite */
    CDIR_POINTER(const float*, orientation);  /* n times 4: view quaternions, of length 1 within 1e-3 */
    CDIR_POINTER(const float*, velocity);     /* n times 3: map units per second, finite; null = unknown */
    CDIR_POINTER(const uint32_t*, flags);     /* n: bitwise or of CDIR_POSE_ values */
    uint32_t player_id_stride;
    uint32_t eye_stride;
    uint32_t orientation_stride;
    uint32_t velocity_stride;
    uint32_t flags_stride;
    uint32_t reserved;
} cdir_pose_frame;

/* No players, and packed arrays. */
CDIR_DEFAULTS(cdir_pose_frame)

/* Publishes one frame, best effort: a director that falls behind gets the newest. Never waits for a receiver.
 * CDIR_INVALID_ARGUMENT: cdir_last_error() names the array that is wrong, or frame_time went back within the
 * epoch. Nothing of the frame counts then, also not its discontinuities.
 * No discontinuity is lost with a frame: the library counts them by player within the epoch, and every frame
 * carries the counts.
 * Costs one system call per director; a game that cannot afford them in its frame calls this from a thread of
 * its own. */
CDIR_API cdir_status cdir_match_publish_poses(cdir_match match, const cdir_pose_frame* frame) CDIR_NOEXCEPT;

/* What the fields of an event mean for each kind. The director finds by kind, actor and subject what is worth
 * seeing. It shows the last event with value and detail to its operator, and passes none on to observers.
 * Other kinds, greater than these, are sent and shown likewise. Names are the
 * game's own, such as "MOD_ROCKET" or "item_quad". What does not apply or is not known is CDIR_NO_PLAYER, 0
 * or "". A player who dies or is hurt through no other player is the subject alone, by their own doing also
 * the actor. */
enum {
    CDIR_EVENT_KILL = 1,          /* actor killed subject; value: points for actor; detail: means */
    CDIR_EVENT_FLAG_TAKEN = 2,    /* by actor; value: team of the flag; detail: its name */
    CDIR_EVENT_FLAG_CAPTURED = 3, /* by actor; value: points for actor's team; detail: the flag's name */
    CDIR_EVENT_OBJECTIVE = 4,     /* reached by actor, lost by subject; value: points; detail: its name */
    CDIR_EVENT_DAMAGE = 5,        /* actor hurt subject; value: hit points; detail: means */
    CDIR_EVENT_AWARD = 6,         /* for actor, at subject's cost; value: points; detail: its name */
    CDIR_EVENT_ITEM = 7,          /* picked up by actor; value: amount; detail: its name */
    CDIR_EVENT_ROUND = 8,         /* won by actor; value: number, from 1; detail: "begin" or "end" */
    CDIR_EVENT_SPAWN = 9,         /* actor entered the game; value: team; detail: name of the place */
    CDIR_EVENT_WEAPON = 10        /* raised by actor; detail: its name */
};

typedef struct cdir_match_event {
    uint32_t struct_size;
    uint32_t kind;      /* one of CDIR_EVENT_ */
    int64_t frame_time; /* when it happened */
    uint32_t actor;     /* player id or CDIR_NO_PLAYER */
    uint32_t subject;   /* player id or CDIR_NO_PLAYER */
    float value;        /* finite */
    uint32_t reserved;
    char detail[32]; /* up to 31 bytes without control characters */
} cdir_match_event;

/* A kill, by and of nobody. */
CDIR_DEFAULTS(cdir_match_event)

/* Publishes one event, reliably.
 * CDIR_BUSY: a director is so far behind that the send queue of 256 events is full. */
CDIR_API cdir_status cdir_match_publish_event(cdir_match match, const cdir_match_event* event) CDIR_NOEXCEPT;

/* Doors, lifts, platforms and vehicles: what moves and is in the way of cameras and views. A mover has the
 * shape of the map's brush model of this name where the director's map has it, and otherwise the union of the
 * hulls and balls given here: map units, in the mover's own axes, from where its position is. A hull is an
 * intersection of half spaces, bounded and not empty: the points p with normal . p <= distance. */
typedef struct cdir_mover {
    uint32_t struct_size;
    uint32_t id;    /* unique within the match */
    char model[64]; /* "*3"; empty = none */
    char kind[32];  /* what it is, by the game's name, such as "func_door"; may be empty */
    CDIR_POINTER(const float*, half_spaces); /* 4 each, hull after hull: normal, of length 1, and distance */
    CDIR_POINTER(const uint32_t*,
                 hull_sizes);          /* hull_count: half spaces of each, 4 .. CDIR_MAX_HALF_SPACES */
    CDIR_POINTER(const float*, balls); /* ball_count times 4: centre, and radius > 0 */
    uint32_t hull_count;               /* <= CDIR_MAX_HULLS; for 0 the arrays may be null */
    uint32_t ball_count;               /* <= CDIR_MAX_HULLS; for 0 the array may be null */
} cdir_mover;

/* Mover 0, without model and shape: no obstacle. */
CDIR_DEFAULTS(cdir_mover)

/* Says which movers the match has, instead of those before; what is gone is no obstacle any more. Those that
 * stay are where they were. To be called again after cdir_match_restart(). movers: mover_count <=
 * CDIR_MAX_MOVERS elements; may be null for 0. Publishes reliably, also to directors that come later.
 * CDIR_INVALID_ARGUMENT: cdir_last_error() names the field that is out of its range. Whether a hull is
 * bounded is for the director to check, which drops all that was published with one that is not.
 * CDIR_BUSY: as cdir_match_update().
 * CDIR_NETWORK: the identity for DDS Security does not allow it: it is older than movers. */
CDIR_API cdir_status cdir_match_set_movers(cdir_match match, const cdir_mover* movers,
                                           uint32_t mover_count) CDIR_NOEXCEPT;

/* Where movers are at one instant. Strides are as in cdir_pose_frame. */
typedef struct cdir_mover_frame {
    uint32_t struct_size;
    uint32_t mover_count; /* n <= CDIR_MAX_MOVERS; for 0 the arrays may be null */
    int64_t frame_time;   /* not less than that of the epoch's previous frame of movers */
    int64_t source_time;  /* when the movers were sampled, since 1970-01-01 00:00 UTC; 0 = now */
    CDIR_POINTER(const uint32_t*, mover_id); /* n, distinct, of those in cdir_match_set_movers() */
    CDIR_POINTER(const float*, position);    /* n times 3: map units, finite */
    CDIR_POINTER(const float*, orientation); /* n times 4: quaternions, of length 1 within 1e-3 */
    uint32_t mover_id_stride;
    uint32_t position_stride;
    uint32_t orientation_stride;
    uint32_t reserved;
} cdir_mover_frame;

/* No movers, and packed arrays. */
CDIR_DEFAULTS(cdir_mover_frame)

/* Publishes where movers are, reliably, also to directors that come later. Those that the frame does not name
 * are where they were; one that no frame has named is no obstacle. To be called before
 * cdir_match_publish_poses() of the same frame_time, in every frame or in those in which something moves:
 * where nothing is elsewhere than before, nothing is sent. Never waits for a receiver.
 * CDIR_INVALID_ARGUMENT: cdir_last_error() names what is wrong.
 * CDIR_BUSY: as cdir_match_update(). */
CDIR_API cdir_status cdir_match_publish_movers(cdir_match match, const cdir_mover_frame* frame) CDIR_NOEXCEPT;

/* Stores how many directors receive this match's poses now. */
CDIR_API cdir_status cdir_match_director_count(cdir_match match, uint32_t* count) CDIR_NOEXCEPT;

/* Ends the match: the directors end its shots. */
CDIR_API cdir_status cdir_match_close(cdir_match match) CDIR_NOEXCEPT;

/* -------------------------------------------------------------------------------------- observer */

typedef struct cdir_observer_options {
    uint32_t struct_size;
    uint32_t reserved;
    /* How far cdir_observer_display_time() stays behind the newest camera frame, 0 .. 10 s. It must cover the
     * frames' jitter, or the view stands still when a frame is late; two to four frames are usual. */
    int64_t interpolation_delay;
} cdir_observer_options;

/* 50 ms: three frames at 60 Hz. */
CDIR_DEFAULTS(cdir_observer_options)

/* Begins to observe a match, which need not exist yet. match_id: as in cdir_match_info. observer_id: 1 .. 63
 * bytes without control characters, unique within the match: while another process has opened it, or has died
 * less than 10 s ago, that one's answers are received and this one's request waits. options: null = the
 * default. */
CDIR_API cdir_status cdir_observer_open(cdir_context context, const char* match_id, const char* observer_id,
                                        const cdir_observer_options* options,
                                        cdir_observer* observer) CDIR_NOEXCEPT;

typedef struct cdir_shot_request {
    uint32_t struct_size;
    uint32_t target; /* player id, CDIR_CHOOSE_TARGET or CDIR_SHOW_GROUP */
    /* With CDIR_CHOOSE_TARGET: group_count players among whom the director chooses; null = all. With
     * CDIR_SHOW_GROUP: the 2 .. CDIR_MAX_GROUP_SHOT players whom one camera shows together, those who matter
     * most first. A director that knows no group shots
     * answers that there is no such player. */
    CDIR_POINTER(const uint32_t*, group);
    /* "default", "broadcast", "close", "tactical", or another one of the director's configuration, up to 31
     * bytes; null or "" = the one that it chooses. */
    CDIR_POINTER(const char*, profile);
    /* JSON object with a profile's keys, up to 1023 bytes; null or "" = none. The director's operator may
     * narrow them. */
    CDIR_POINTER(const char*, overrides);
    uint32_t group_count; /* <= CDIR_MAX_PLAYERS */
    /* With CDIR_CHOOSE_TARGET, else 0: only players of this team (cdir_player.team) are shown, where there is
     * a group too only those of both; 0 = of any. Whoever leaves the team is shown no more. Where nobody of
     * it plays, the request waits, and its status says so. Directors older than this field ignore it. */
    uint8_t team;
    uint8_t reserved[3]; /* 0 */
} cdir_shot_request;

/* The director chooses the target among all players, with its default profile. */
CDIR_DEFAULTS(cdir_shot_request)

/* Requests a shot, or replaces the observer's request. Returns before a director has answered:
 * cdir_observer_shot_status() has the answer. The request ends with the observer. */
CDIR_API cdir_status cdir_observer_request(cdir_observer observer,
                                           const cdir_shot_request* request) CDIR_NOEXCEPT;

/* Withdraws the request. CDIR_CONFLICT: there is none. */
CDIR_API cdir_status cdir_observer_withdraw(cdir_observer observer) CDIR_NOEXCEPT;

/* Waits until there is something for poll or next_frame to take, or a director that came or left for them to
 * take note of. Meanwhile a request that nobody answers is sent again every 2 s. timeout: nanoseconds, 0 = do
 * not wait, negative = without limit. Returns CDIR_OK, CDIR_TIMEOUT or CDIR_INTERRUPTED. */
CDIR_API cdir_status cdir_observer_wait(cdir_observer observer, int64_t timeout) CDIR_NOEXCEPT;

/* Ends the waits in progress; if there is none, the next one. */
CDIR_API cdir_status cdir_observer_interrupt(cdir_observer observer) CDIR_NOEXCEPT;

/* Takes everything that has arrived. frame_count (may be null) receives the number of camera frames taken.
 * The results of the functions below change only here and in cdir_observer_next_frame(). */
CDIR_API cdir_status cdir_observer_poll(cdir_observer observer, uint32_t* frame_count) CDIR_NOEXCEPT;

enum {
    CDIR_CAMERA_CUT = 1,            /* the camera jumped since the previous frame */
    CDIR_CAMERA_TARGET_VISIBLE = 2, /* no obstacle between the camera and the target's eye; in a
                                     * group shot: all living players of the group are shown */
    CDIR_CAMERA_SEARCHING = 4,      /* moving towards a target that is out of sight */
    CDIR_CAMERA_TARGET_ABSENT = 8,  /* the target has no pose */
    CDIR_CAMERA_HELD = 16           /* the camera stands still: the target is dead or cannot be followed */
};

typedef struct cdir_camera {
    uint32_t struct_size;
    uint32_t camera_id;
    /* player id: of a group shot the first of its group; CDIR_CHOOSE_TARGET where the director has chosen a
     * camera that stands still, or nobody, yet or any more */
    uint32_t target;
    uint32_t flags;       /* bitwise or of CDIR_CAMERA_ values */
    float position[3];    /* map units */
    float orientation[4]; /* x y z w */
    float vertical_fov;   /* radians, greater than 0, less than pi */
    float clearance;      /* lower bound of the distance to the nearest obstacle, map units */
    uint32_t reserved;
    /* Where the director chooses the target: why it cut to this one. "opening" (the
     * shot's first, or what was shown can be shown no more: a player who left the game or the team, a
     * fixed camera that a door comes near), "death" or "lost sight" (of the one before), "length" (that one
     * was shown long enough), or the name of a rule of the director's configuration, such as "kill", with the
     * players of its moment. Empty where it is not known: for up to a second after the observer has come.
     * cdir_observer_next_frame() has it in the frame of the cut and then once a second. */
    uint32_t reason_actor;   /* player id or CDIR_NO_PLAYER */
    uint32_t reason_subject; /* player id or CDIR_NO_PLAYER */
    char reason[32];
} cdir_camera;

/* At the map's origin, looking along x, with a field of view of 60 degrees. */
CDIR_DEFAULTS(cdir_camera)

typedef struct cdir_camera_frame {
    uint32_t struct_size;
    uint32_t camera_count;
    uint64_t epoch;
    uint64_t director_id;
    int64_t frame_time;    /* of the pose frame that the cameras were computed for */
    int64_t source_time;   /* of that pose frame */
    int64_t write_time;    /* when the director published the cameras, by its clock */
    uint32_t frame_number; /* consecutive within the epoch and director, from 0 */
    uint32_t pose_number;  /* number of that pose frame within the epoch, from 0 */
} cdir_camera_frame;

CDIR_DEFAULTS(cdir_camera_frame)

/* For broadcasters and recorders: takes the next camera frame, oldest first, with the cameras of all shots of
 * the match. Stores up to capacity cameras; cameras may be null for 0, and its first needs its struct_size.
 * Needs no request.
 * CDIR_TRUNCATED: there are more, camera_count in all. CDIR_NO_DATA: no frame waits.
 * Frames that are not taken are kept up to 32, then the oldest are lost and count as gaps. */
CDIR_API cdir_status cdir_observer_next_frame(cdir_observer observer, cdir_camera_frame* frame,
                                              cdir_camera* cameras, uint32_t capacity) CDIR_NOEXCEPT;

enum {
    CDIR_SHOT_REFUSED = 0, /* see reason */
    CDIR_SHOT_ACCEPTED = 1,
    CDIR_SHOT_WAITING_FOR_MAP = 2,    /* no game server, or its map is not loaded */
    CDIR_SHOT_WAITING_FOR_PLAYER = 3, /* no player of the request is in the match */
    CDIR_SHOT_NOT_REQUESTED = 100,
    CDIR_SHOT_UNANSWERED = 101 /* requested, but no director has answered, or it has gone */
};

typedef struct cdir_shot_status {
    uint32_t struct_size;
    uint32_t state;     /* one of CDIR_SHOT_ */
    uint64_t epoch;     /* of the director's answer */
    uint32_t camera_id; /* the shot's camera in camera frames, with CDIR_SHOT_ACCEPTED */
    uint32_t reserved;
    char reason[256]; /* for people; may be empty */
} cdir_shot_status;

CDIR_DEFAULTS(cdir_shot_status)

/* The state in words, such as "waiting for the map"; "unknown state" for any other number. Never null. */
CDIR_API const char* cdir_shot_state_name(uint32_t state) CDIR_NOEXCEPT;

/* Stores the director's answer to the request. */
CDIR_API cdir_status cdir_observer_shot_status(cdir_observer observer,
                                               cdir_shot_status* status) CDIR_NOEXCEPT;

/* Where among the frames a shot's camera was taken. */
typedef struct cdir_view {
    uint32_t struct_size;
    uint32_t segment;   /* changes at every cut and where frames are missing: do not blend across a change */
    int64_t frame_time; /* of the camera */
    int64_t late;       /* >= 0: how much later than the newest frame the requested time is; the camera stands
                           still meanwhile */
} cdir_view;

CDIR_DEFAULTS(cdir_view)

/* Stores the newest camera of the shot, as received. CDIR_NO_DATA: there is none in this epoch. */
CDIR_API cdir_status cdir_observer_newest_camera(cdir_observer observer, cdir_camera* camera,
                                                 cdir_view* view) CDIR_NOEXCEPT;

/* Stores the shot's camera at a game time, interpolated between the frames before and after it, but never
 * across a cut or a missing frame. Position and orientation pass through the frames without kinks, and the
 * position stays on the straight way between two frames or within the clearance of one of them. The newest 64
 * frames are kept: earlier times give the oldest of them, later times the newest. CDIR_NO_DATA: there is none
 * in this epoch. */
CDIR_API cdir_status cdir_observer_camera_at(cdir_observer observer, int64_t frame_time, cdir_camera* camera,
                                             cdir_view* view) CDIR_NOEXCEPT;

/* Stores the game time to display now: interpolation_delay behind the camera frames as they arrive. Advances
 * smoothly and never goes back within an epoch, unless the director's frames go back by more than a second.
 * CDIR_NO_DATA: no frame has been taken in this epoch. */
CDIR_API cdir_status cdir_observer_display_time(cdir_observer observer, int64_t* frame_time) CDIR_NOEXCEPT;

/* Stores the match's description and up to capacity of its players; players may be null for 0, and its first
 * needs its struct_size. player_count (may be null) receives their number. CDIR_TRUNCATED: there are more
 * than capacity. The description is of what the cameras show, and late by the match's delay as they are. It
 * comes from the director, needs no request, and stays when the director has gone, until another one's.
 * CDIR_NO_DATA: no director shows the match, or it has been shown to its end. */
CDIR_API cdir_status cdir_observer_match_info(cdir_observer observer, cdir_match_info* info,
                                              cdir_player* players, uint32_t capacity,
                                              uint32_t* player_count) CDIR_NOEXCEPT;

/* Since the observer was opened. */
typedef struct cdir_observer_counters {
    uint32_t struct_size;
    uint32_t directors;   /* connected now that publish this match's cameras, standbys included */
    uint64_t frames;      /* camera frames taken */
    uint64_t gaps;        /* camera frames missing between them, by frame_number */
    uint64_t hand_overs;  /* changes of the publishing director within an epoch */
    uint64_t stale_epoch; /* samples of an earlier epoch, dropped */
    uint64_t invalid;     /* malformed samples, dropped */
    uint64_t repeated;    /* camera frames that had been shown before, dropped */
} cdir_observer_counters;

CDIR_DEFAULTS(cdir_observer_counters)

CDIR_API cdir_status cdir_observer_get_counters(cdir_observer observer,
                                                cdir_observer_counters* counters) CDIR_NOEXCEPT;

/* Ends the waits in progress and withdraws the request. */
CDIR_API cdir_status cdir_observer_close(cdir_observer observer) CDIR_NOEXCEPT;

#ifdef __cplusplus
}
#endif

#endif
