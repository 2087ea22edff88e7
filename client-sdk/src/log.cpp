#include "log.hpp"

#include <dds/dds.h>
#include <dds/ddsrt/log.h>

#include <mutex>
#include <string>

namespace camdir::sdk {

namespace {

struct Sink {
    std::mutex mutex;  // held during calls, so that no call is in progress once the sink is replaced
    cdir_log_function log = nullptr;
    void* user_data = nullptr;
};

// Never destroyed: DDS may have something to say while the process exits.
Sink& sink() {
    static auto* only = new Sink;
    return *only;
}

std::uint32_t level_of(std::uint32_t category) {
    if ((category & (DDS_LC_FATAL | DDS_LC_ERROR)) != 0) return CDIR_LOG_ERROR;
    return (category & DDS_LC_WARNING) != 0 ? CDIR_LOG_WARNING : CDIR_LOG_INFO;
}

void write_to_sink(void* /*unused*/, const dds_log_data_t* data) {
    std::string text(data->message, data->size);
    while (!text.empty() && (text.back() == '\n' || text.back() == '\0'))
        text.pop_back();
    const std::lock_guard lock(sink().mutex);
    if (sink().log != nullptr) sink().log(sink().user_data, level_of(data->priority), text.c_str());
}

}  // namespace

void log_to(cdir_log_function log, void* user_data) {
    {
        const std::lock_guard lock(sink().mutex);
        sink().log = log;
        sink().user_data = user_data;
    }
    dds_set_log_sink(log == nullptr ? nullptr : write_to_sink, nullptr);
}

}  // namespace camdir::sdk
