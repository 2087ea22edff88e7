// The messages of Cyclone DDS, for the application's log.
#pragma once

#include <camera_director/camera_director.h>

namespace camdir::sdk {

// From now on; null: to standard error. Thread-safe.
void log_to(cdir_log_function log, void* user_data);

}  // namespace camdir::sdk
