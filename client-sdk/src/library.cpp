// The C functions of the whole library: its version, names, errors and options.
#include <camera_director/camera_director.h>

#include "checks.hpp"
#include "log.hpp"
#include "memory.hpp"
#include "structs.hpp"

using namespace camdir::sdk;

uint32_t cdir_abi_version(void) noexcept {
    return CDIR_ABI_VERSION;
}

const char* cdir_status_name(cdir_status status) noexcept {
    switch (status) {
        case CDIR_OK:
            return "CDIR_OK";
        case CDIR_NO_DATA:
            return "CDIR_NO_DATA";
        case CDIR_TIMEOUT:
            return "CDIR_TIMEOUT";
        case CDIR_INTERRUPTED:
            return "CDIR_INTERRUPTED";
        case CDIR_TRUNCATED:
            return "CDIR_TRUNCATED";
        case CDIR_INVALID_ARGUMENT:
            return "CDIR_INVALID_ARGUMENT";
        case CDIR_INVALID_HANDLE:
            return "CDIR_INVALID_HANDLE";
        case CDIR_BUSY:
            return "CDIR_BUSY";
        case CDIR_CONFLICT:
            return "CDIR_CONFLICT";
        case CDIR_NETWORK:
            return "CDIR_NETWORK";
        case CDIR_OUT_OF_MEMORY:
            return "CDIR_OUT_OF_MEMORY";
        case CDIR_INTERNAL:
            return "CDIR_INTERNAL";
        default:
            return "unknown status";
    }
}

const char* cdir_last_error(void) noexcept {
    return last_error_text;
}

cdir_status cdir_library_configure(const cdir_library_options* options) noexcept {
    return guarded([&] {
        const cdir_library_options read = read_struct("options", options);
        require((read.allocate == nullptr) == (read.free == nullptr), "allocate or free is null");
        require(read.reserved == 0, "options.reserved is not 0");
        use_memory(read.allocate, read.free, read.allocator_data);
        log_to(read.log, read.log_data);
        return CDIR_OK;
    });
}

const char* cdir_shot_state_name(uint32_t state) noexcept {
    switch (state) {
        case CDIR_SHOT_REFUSED:
            return "refused";
        case CDIR_SHOT_ACCEPTED:
            return "accepted";
        case CDIR_SHOT_WAITING_FOR_MAP:
            return "waiting for the map";
        case CDIR_SHOT_WAITING_FOR_PLAYER:
            return "waiting for a player";
        case CDIR_SHOT_NOT_REQUESTED:
            return "not requested";
        case CDIR_SHOT_UNANSWERED:
            return "unanswered";
        default:
            return "unknown state";
    }
}
