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
        if (observer.wait(std::chrono::seconds(5)) != cd::Waited::arrived) return 1;
        observer.poll();
        const auto info = observer.match_info();
        return info && info->players.at(0).name == "anna" ? 0 : 1;
    } catch (const cd::Error& error) {
        std::fprintf(stderr, "%s: %s\n", cdir_status_name(error.status()), error.what());
        return 1;
    }
}
