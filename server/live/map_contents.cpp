#include "live/map_contents.hpp"

#include <nlohmann/json.hpp>

namespace camdir::live {
namespace {

using json = nlohmann::ordered_json;

json numbers(const Vec3f& v) {
    return {v.x(), v.y(), v.z()};
}

json numbers(const Vec3f& v, float more) {
    return {v.x(), v.y(), v.z(), more};
}

json fixed_camera(const freespace::FixedShot& shot) {
    const bool is_named = shot.spawn_point != freespace::none;
    return {{"position", numbers(shot.position)},
            {"yaw", shot.yaw},
            {"pitch", shot.pitch},
            {"spawn_point", is_named ? json(shot.spawn_point) : json()}};
}

}  // namespace

json mover_json(const freespace::MoverShape& mover) {
    json hulls = json::array();
    for (const freespace::ConvexHull& hull : mover.hulls) {
        json half_spaces = json::array();
        for (const auto& [normal, distance] : hull.half_spaces)
            half_spaces.push_back(numbers(normal, distance));
        hulls.push_back(std::move(half_spaces));
    }
    json balls = json::array();
    for (const auto& [centre, radius] : mover.balls)
        balls.push_back(numbers(centre, radius));
    return {{"name", mover.name}, {"kind", mover.kind}, {"hulls", hulls}, {"balls", balls}};
}

std::string map_contents(const freespace::Freespace& map) {
    json fixed_cameras = json::array();
    for (const freespace::FixedShot& shot : map.fixed_shots())
        fixed_cameras.push_back(fixed_camera(shot));
    json movers = json::array();
    for (const freespace::MoverShape& mover : map.movers())
        movers.push_back(mover_json(mover));
    const json content = {{"version", 1}, {"fixed_cameras", fixed_cameras}, {"movers", movers}};
    return content.dump(-1, ' ', false, json::error_handler_t::replace);
}

}  // namespace camdir::live
