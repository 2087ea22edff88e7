// A C++ program that uses the installed library.
#include <camera_director/camera_director.hpp>
#include <cstdio>

namespace cd = camera_director;

int main() {
    try {
        const cd::Context context({.domain = 83});
        cd::Match match(context, {.match_id = "consumer++", .map_name = "map", .players = {{1, "anna"}}});
        cd::Observer observer(context, "consumer++", "cpp");
        observer.request({.target = 1});
        (void)observer.wait(std::chrono::milliseconds(1));
        observer.poll();
        return observer.shot_status().state == CDIR_SHOT_UNANSWERED ? 0 : 1;  // there is no director
    } catch (const cd::Error& error) {
        std::fprintf(stderr, "%s: %s\n", cdir_status_name(error.status()), error.what());
        return 1;
    }
}
