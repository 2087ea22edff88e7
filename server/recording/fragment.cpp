#include "recording/fragment.hpp"

#include <algorithm>
#include <cmath>

#include "freespace/shape_checks.hpp"

namespace camdir::recording {
namespace {

template <std::size_t N>
using Floats = std::array<std::uint32_t, N>;

template <std::size_t N>
void put(ByteSink& sink, const Floats<N>& now, Floats<N>& before) {
    for (std::size_t i = 0; i < N; ++i)
        sink.difference(static_cast<std::int32_t>(now[i] - before[i]));
    before = now;
}

template <std::size_t N>
bool get(ByteSource& source, Floats<N>& values) {
    bool finite = true;
    for (std::uint32_t& value : values) {
        value += static_cast<std::uint32_t>(source.difference());
        finite = finite && std::isfinite(std::bit_cast<float>(value));
    }
    return finite;
}

std::uint32_t bits(float value) {
    return std::bit_cast<std::uint32_t>(value);
}
float real(std::uint64_t value) {
    return std::bit_cast<float>(static_cast<std::uint32_t>(value));
}

template <std::size_t N>
Vec3f vector_at(const Floats<N>& values, std::size_t i) {
    return {real(values[i]), real(values[i + 1]), real(values[i + 2])};
}
template <std::size_t N>
Quatf quaternion_at(const Floats<N>& values, std::size_t i) {
    return {real(values[i + 3]), real(values[i]), real(values[i + 1]), real(values[i + 2])};
}
bool is_unit(const Quatf& q) {
    return std::abs(q.norm() - 1.0F) <= 1e-3F;
}

Floats<10> floats_of(const director::PlayerPose& pose) {
    const Quatf& q = pose.orientation;
    return {bits(pose.eye.x()),
            bits(pose.eye.y()),
            bits(pose.eye.z()),
            bits(q.x()),
            bits(q.y()),
            bits(q.z()),
            bits(q.w()),
            bits(pose.velocity.x()),
            bits(pose.velocity.y()),
            bits(pose.velocity.z())};
}
Floats<9> floats_of(const director::ShotCamera& camera) {
    const Quatf& q = camera.orientation;
    return {bits(camera.position.x()),
            bits(camera.position.y()),
            bits(camera.position.z()),
            bits(q.x()),
            bits(q.y()),
            bits(q.z()),
            bits(q.w()),
            bits(camera.vertical_fov),
            bits(camera.clearance)};
}

Floats<7> floats_of(const director::MoverPose& pose) {
    const Vec3f& at = pose.position;
    const Quatf& q = pose.orientation;
    return {bits(at.x()), bits(at.y()), bits(at.z()), bits(q.x()), bits(q.y()), bits(q.z()), bits(q.w())};
}

void put_info(ByteSink& sink, const director::MatchInfo& info) {
    sink.text(info.match_id);
    sink.varint(info.epoch);
    sink.text(info.map_name);
    sink.fixed(info.map_hash, 8);
    for (const float value : {info.metres_per_unit, info.rate_hz, info.spectator_delay_s})
        sink.fixed(bits(value), 4);
    sink.varint(info.players.size());
    for (const director::Player& player : info.players) {
        sink.varint(player.id);
        sink.text(player.name);
        sink.text(player.player_class);
        sink.fixed(player.team, 1);
    }
}

bool get_info(ByteSource& source, director::MatchInfo& info) {
    info.match_id = source.text();
    info.epoch = source.varint();
    info.map_name = source.text();
    info.map_hash = source.fixed(8);
    for (float* value : {&info.metres_per_unit, &info.rate_hz, &info.spectator_delay_s})
        *value = real(source.fixed(4));
    info.players.resize(source.count(4, director::max_players));
    for (director::Player& player : info.players) {
        player.id = source.number();
        player.name = source.text();
        player.player_class = source.text();
        player.team = static_cast<std::uint8_t>(source.fixed(1));
    }
    return std::isfinite(info.metres_per_unit) && std::isfinite(info.rate_hz) &&
           std::isfinite(info.spectator_delay_s);
}

// Of the last frame and of the match's list: see State.
constexpr std::size_t max_poses = 2 * director::max_players;

enum class RecordKind : std::uint64_t {
    info = 1,
    poses,
    event,
    request,
    withdrawal,
    cameras,
    movers,
    mover_frame
};

void put_reasons(ByteSink& sink, const std::vector<director::ShotReason>& reasons) {
    sink.varint(reasons.size());
    for (const auto& [camera_id, reason] : reasons) {
        sink.varint(camera_id);
        sink.varint(reason.actor);
        sink.varint(reason.subject);
        sink.text(reason.why);
    }
}

void put_event(ByteSink& sink, const director::MatchEvent& event) {
    sink.varint(event.epoch);
    sink.difference(event.frame_time);
    for (const std::uint32_t value : {event.kind, event.actor, event.subject})
        sink.varint(value);
    sink.fixed(bits(event.value), 4);
    sink.text(event.detail);
}

void put_request(ByteSink& sink, const director::ObserverRequest& request) {
    sink.text(request.match_id);
    sink.text(request.observer_id);
    sink.varint(request.target);
    sink.varint(request.group.size());
    for (const std::uint32_t id : request.group)
        sink.varint(id);
    sink.text(request.profile);
    sink.text(request.overrides);
    sink.fixed(request.team, 1);
}

void put_vector(ByteSink& sink, const Vec3f& vector) {
    for (const float value : {vector.x(), vector.y(), vector.z()})
        sink.fixed(bits(value), 4);
}

void put_movers(ByteSink& sink, const director::MoverInfo& info) {
    sink.varint(info.epoch);
    sink.varint(info.movers.size());
    for (const auto& [id, shape] : info.movers) {
        sink.varint(id);
        sink.text(shape.name);
        sink.text(shape.kind);
        sink.varint(shape.hulls.size());
        for (const freespace::ConvexHull& hull : shape.hulls) {
            sink.varint(hull.half_spaces.size());
            for (const auto& [normal, distance] : hull.half_spaces) {
                put_vector(sink, normal);
                sink.fixed(bits(distance), 4);
            }
        }
        sink.varint(shape.balls.size());
        for (const auto& [centre, radius] : shape.balls) {
            put_vector(sink, centre);
            sink.fixed(bits(radius), 4);
        }
    }
}

// Decodes the movers of a match; leaves `valid` false where a shape is none that they may have.
class MoversDecoder {
  public:
    MoversDecoder(ByteSource& source, bool& valid) : source_(source), valid_(valid) {}

    director::MoverInfo decode() {
        director::MoverInfo info;
        info.epoch = source_.varint();
        info.movers.resize(source_.count(5, freespace::max_movers));
        for (auto& [id, shape] : info.movers) {
            id = source_.number();
            shape.name = source_.text();
            shape.kind = source_.text();
            shape.hulls.resize(source_.count(1, freespace::max_hulls));
            for (freespace::ConvexHull& hull : shape.hulls)
                decode(hull);
            shape.balls.resize(take(16, freespace::max_hulls, balls_left_));
            for (auto& [centre, radius] : shape.balls) {
                centre = vector();
                radius = number();
                valid_ = valid_ && freespace::is_ball({centre, radius});
            }
        }
        return info;
    }

  private:
    void decode(freespace::ConvexHull& hull) {
        hull.half_spaces.resize(take(16, freespace::max_half_spaces, half_spaces_left_));
        for (auto& [normal, distance] : hull.half_spaces) {
            normal = vector();
            distance = number();
            valid_ = valid_ && std::abs(normal.norm() - 1.0F) <= 1e-3F;
        }
        if (!valid_ || !source_.ok()) return;
        const auto bounds = freespace::bounds_of(hull.half_spaces);
        valid_ = bounds.has_value();
        if (bounds) hull.bounds = *bounds;
    }

    // How many elements follow: no more than are left of all.
    std::size_t take(std::size_t size, std::size_t max, std::size_t& left) {
        const std::size_t count = source_.count(size, std::min(max, left));
        left -= count;
        return count;
    }
    float number() {
        const float value = real(source_.fixed(4));
        valid_ = valid_ && std::isfinite(value);
        return value;
    }
    Vec3f vector() {
        const float x = number(), y = number(), z = number();
        return {x, y, z};
    }

    ByteSource& source_;
    bool& valid_;
    std::size_t half_spaces_left_ = director::max_half_spaces;
    std::size_t balls_left_ = director::max_balls;
};

// Decodes the records of one resource, which start from no poses and no cameras.
class RecordDecoder {
  public:
    // Nothing: the kind is unknown. Leaves the source not ok where a field is cut off or too large, and
    // `valid` false where a value is none that the record may have.
    std::optional<Message> message(std::uint64_t kind, ByteSource& source, bool& valid) {
        switch (static_cast<RecordKind>(kind)) {
            case RecordKind::info: {
                director::MatchInfo info;
                valid = get_info(source, info) && valid;
                return info;
            }
            case RecordKind::poses:
                return poses(source, valid);
            case RecordKind::event:
                return event(source, valid);
            case RecordKind::request:
                return request(source);
            case RecordKind::withdrawal:
                return Withdrawal{source.text()};
            case RecordKind::cameras:
                return cameras(source, valid);
            case RecordKind::movers:
                return MoversDecoder(source, valid).decode();
            case RecordKind::mover_frame:
                return mover_frame(source, valid);
        }
        return std::nullopt;
    }

  private:
    director::PoseFrame poses(ByteSource& source, bool& valid) {
        director::PoseFrame frame;
        frame.epoch = source.varint();
        frame.frame_number = source.number();
        frame.frame_time = source.difference();
        frame.source_time = source.difference();
        frame.poses.resize(source.count(13, max_poses));
        for (director::PlayerPose& pose : frame.poses) {
            pose.player_id = source.number();
            pose.flags = source.number();
            if (source.fixed(1) != 0) pose.discontinuities = source.number();
            Floats<10>& values = poses_[pose.player_id];
            valid = get(source, values) && valid;
            pose.eye = vector_at(values, 0);
            pose.orientation = quaternion_at(values, 3);
            pose.velocity = vector_at(values, 7);
            valid = valid && is_unit(pose.orientation);
        }
        return frame;
    }

    director::CameraFrame cameras(ByteSource& source, bool& valid) {
        director::CameraFrame frame;
        frame.epoch = source.varint();
        frame.frame_number = source.number();
        frame.pose_number = source.number();
        frame.frame_time = source.difference();
        frame.source_time = source.difference();
        frame.cameras.resize(source.count(12, director::max_cameras));
        for (director::ShotCamera& camera : frame.cameras) {
            camera.camera_id = source.number();
            camera.target = source.number();
            camera.flags = source.number();
            Floats<9>& values = cameras_[camera.camera_id];
            valid = get(source, values) && valid;
            camera.position = vector_at(values, 0);
            camera.orientation = quaternion_at(values, 3);
            camera.vertical_fov = real(values[7]);
            camera.clearance = real(values[8]);
            valid = valid && is_unit(camera.orientation);
        }
        if (source.ok() && source.left() > 0) frame.reasons = reasons(source);  // since minor version 1
        return frame;
    }

    director::MoverFrame mover_frame(ByteSource& source, bool& valid) {
        director::MoverFrame frame;
        frame.epoch = source.varint();
        frame.frame_time = source.difference();
        frame.source_time = source.difference();
        frame.poses.resize(source.count(8, freespace::max_movers));
        for (director::MoverPose& pose : frame.poses) {
            pose.mover_id = source.number();
            Floats<7>& values = movers_[pose.mover_id];
            valid = get(source, values) && valid;
            pose.position = vector_at(values, 0);
            pose.orientation = quaternion_at(values, 3);
            valid = valid && is_unit(pose.orientation);
        }
        return frame;
    }

    static std::vector<director::ShotReason> reasons(ByteSource& source) {
        std::vector<director::ShotReason> reasons(source.count(4, director::max_cameras));
        for (auto& [camera_id, reason] : reasons) {
            camera_id = source.number();
            reason.actor = source.number();
            reason.subject = source.number();
            reason.why = source.text();
        }
        return reasons;
    }

    static director::MatchEvent event(ByteSource& source, bool& valid) {
        director::MatchEvent event;
        event.epoch = source.varint();
        event.frame_time = source.difference();
        for (std::uint32_t* value : {&event.kind, &event.actor, &event.subject})
            *value = source.number();
        event.value = real(source.fixed(4));
        event.detail = source.text();
        valid = std::isfinite(event.value) && valid;
        return event;
    }

    static director::ObserverRequest request(ByteSource& source) {
        director::ObserverRequest request;
        request.match_id = source.text();
        request.observer_id = source.text();
        request.target = source.number();
        request.group.resize(source.count(1, source.left()));
        for (std::uint32_t& id : request.group)
            id = source.number();
        request.profile = source.text();
        request.overrides = source.text();
        if (source.ok() && source.left() > 0)  // since minor version 3
            request.team = static_cast<std::uint8_t>(source.fixed(1));
        return request;
    }

    std::map<std::uint32_t, Floats<10>> poses_;
    std::map<std::uint32_t, Floats<9>> cameras_;
    std::map<std::uint32_t, Floats<7>> movers_;
};

}  // namespace

Bytes encode_start(const Start& start) {
    ByteSink sink;
    sink.text(start.director_version);
    sink.difference(start.fragment_duration);
    put_info(sink, start.match);
    return encode(Resource{ResourceKind::start, 0, 0, std::move(sink.bytes)});
}

Result<Start> decode_start(std::span<const std::byte> bytes, const std::string& name) {
    auto resource = decode_resource(bytes, name);
    if (!resource) return tl::unexpected(resource.error());
    if (resource->kind != ResourceKind::start) return fail(name + ": byte 6: expected kind 1 (start)");
    ByteSource source(resource->content);
    Start start;
    start.director_version = source.text();
    start.fragment_duration = source.difference();
    const bool valid = get_info(source, start.match);
    if (!source.ok() || !valid || start.fragment_duration <= 0 ||
        start.fragment_duration > max_fragment_duration)
        return fail(name + ": byte " + std::to_string(source.offset()) +
                    " of the inflated content: expected version, duration and match");
    return start;
}

void RecordEncoder::add(std::int64_t time, const Message& message) {
    ByteSink body;
    body.difference(time - time_);
    time_ = time;
    if (const auto* info = std::get_if<director::MatchInfo>(&message)) put_info(body, *info);
    if (const auto* event = std::get_if<director::MatchEvent>(&message)) put_event(body, *event);
    if (const auto* request = std::get_if<director::ObserverRequest>(&message)) put_request(body, *request);
    if (const auto* gone = std::get_if<Withdrawal>(&message)) body.text(gone->observer_id);
    if (const auto* frame = std::get_if<director::PoseFrame>(&message)) {
        body.varint(frame->epoch);
        body.varint(frame->frame_number);
        body.difference(frame->frame_time);
        body.difference(frame->source_time);
        body.varint(frame->poses.size());
        for (const director::PlayerPose& pose : frame->poses) {
            body.varint(pose.player_id);
            body.varint(pose.flags);
            body.fixed(pose.discontinuities ? 1 : 0, 1);
            if (pose.discontinuities) body.varint(*pose.discontinuities);
            put(body, floats_of(pose), poses_[pose.player_id]);
        }
    }
    if (const auto* frame = std::get_if<director::CameraFrame>(&message)) {
        body.varint(frame->epoch);
        body.varint(frame->frame_number);
        body.varint(frame->pose_number);
        body.difference(frame->frame_time);
        body.difference(frame->source_time);
        body.varint(frame->cameras.size());
        for (const director::ShotCamera& camera : frame->cameras) {
            body.varint(camera.camera_id);
            body.varint(camera.target);
            body.varint(camera.flags);
            put(body, floats_of(camera), cameras_[camera.camera_id]);
        }
        put_reasons(body, frame->reasons);
    }
    if (const auto* movers = std::get_if<director::MoverInfo>(&message)) put_movers(body, *movers);
    if (const auto* frame = std::get_if<director::MoverFrame>(&message)) {
        body.varint(frame->epoch);
        body.difference(frame->frame_time);
        body.difference(frame->source_time);
        body.varint(frame->poses.size());
        for (const director::MoverPose& pose : frame->poses) {
            body.varint(pose.mover_id);
            put(body, floats_of(pose), movers_[pose.mover_id]);
        }
    }
    sink_.varint(message.index() + 1);  // RecordKind has the variant's order
    sink_.varint(body.bytes.size());
    sink_.append(body.bytes);
    ++count_;
}

Result<std::vector<Record>> decode_records(const Resource& resource, const std::string& name) {
    ByteSource source(resource.content);
    RecordDecoder decoder;
    std::vector<Record> records;
    std::int64_t time = resource.begin_time;
    while (source.left() > 0) {
        const std::string where =
            name + ": byte " + std::to_string(source.offset()) + " of the inflated content: ";
        const std::uint64_t kind = source.varint();
        ByteSource body(source.take(source.varint()));
        if (!source.ok()) return fail(where + "expected a record's kind, length and body");
        const std::int64_t step = body.difference();
        bool valid = step >= 0 && !__builtin_add_overflow(time, step, &time);
        auto message = decoder.message(kind, body, valid);
        if (!body.ok() || !valid)
            return fail(
                where + "expected a whole record of kind " + std::to_string(kind) +
                " with finite numbers, unit quaternions, bounded hulls and a time not before the last "
                "one");
        if (!message) continue;
        if (records.size() == max_records)
            return fail(where + "expected at most " + std::to_string(max_records) + " records");
        records.push_back({time, std::move(*message)});
    }
    return records;
}

}  // namespace camdir::recording
