#include "bake/stage.hpp"

#include <utility>

namespace camdir::bake {

Stage::Stage(std::string name, ProgressSink sink, std::stop_token stop)
    : name_(std::move(name)), sink_(std::move(sink)), stop_(std::move(stop)) {
    if (sink_) sink_({name_, 0, 0});
}

bool Stage::advance(std::uint64_t done, std::uint64_t total) {
    if (stop_.stop_requested()) return false;
    const auto now = Clock::now();
    if (sink_ && (now - last_shown_ >= std::chrono::milliseconds(50) || (total > 0 && done == total))) {
        sink_({name_, done, total});
        last_shown_ = now;
    }
    return true;
}

void Stage::count(std::string what, double value) {
    counts_.push_back({name_, std::move(what), value});
}

tl::unexpected<Error> Stage::interrupted() const {
    return fail("interrupted during the stage " + name_, ErrorCode::interrupted);
}

StageReport Stage::finish() && {
    const std::chrono::duration<double> elapsed = Clock::now() - start_;
    return {std::move(name_), elapsed.count(), std::move(counts_)};
}

}  // namespace camdir::bake
