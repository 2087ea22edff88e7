// A C++ program that uses the installed library. Compiled with and without exceptions and run-time type
// information.
#include <camera_director/camera_director.hpp>
#include <cstdio>

namespace cd = camera_director;

namespace {

int fail(const cd::Error& error) {
    std::fprintf(stderr, "%s: %s\n", cdir_status_name(error.status()), error.what());
    return 1;
}

int use(cd::Match& match, cd::Observer& observer) {
    if (const auto published = match.publish(cd::PoseFrame{.frame_time = 1}); !published)
        return fail(published.error());
    if (const auto asked = observer.request({.target = 1}); !asked) return fail(asked.error());
    if (const auto waited = observer.wait(std::chrono::milliseconds(1)); !waited) return fail(waited.error());
    if (const auto taken = observer.poll(); !taken) return fail(taken.error());
    const auto view = observer.newest_camera();
    const auto answer = observer.shot_status();
    if (!view || *view || !answer) return 1;  // there is no director
    return answer->state == CDIR_SHOT_UNANSWERED ? 0 : 1;
}

}  // namespace

int main() {
    const auto refused = cd::Context::open({.domain = 231});
    if (refused || refused.error().status() != CDIR_INVALID_ARGUMENT) return 1;
    const auto context = cd::Context::open_async({.domain = 83});
    if (!context) return fail(context.error());
    if (const auto opened = context->wait(std::chrono::seconds(-1)); !opened) return fail(opened.error());
    auto match =
        cd::Match::open(*context, {.match_id = "consumer++", .map_name = "map", .players = {{1, "anna"}}});
    if (!match) return fail(match.error());
    auto observer = cd::Observer::open(*context, "consumer++", "cpp");
    if (!observer) return fail(observer.error());
    return use(*match, *observer);
}
