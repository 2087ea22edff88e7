// What a spectator's client draws, in pixels: pictures against the views and poses that the server sent.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "live_match.hpp"
#include "oracle/oracle.hpp"
#include "scene/load.hpp"
#include "support/game/marker_model.hpp"
#include "support/openarena.hpp"

namespace camdir::test {
namespace {

constexpr int marker = GameServer::marker_slot;

struct Judged {
    drawn_record picture;
    DrawnView drawn;
    GameView commanded;
    const witness_record* from;  // the snapshot from which the client went on
};

Vec3d vector(const float* values) {
    return Eigen::Map<const Eigen::Vector3f>(values).cast<double>();
}

class Picture : public LiveMatch {
  protected:
    // The pictures since the `first`th that the client drew from the director's cameras.
    std::vector<Judged> judged(const CommandedPath& path, std::size_t first) {
        std::vector<Judged> result;
        const auto& pictures = client_->drawn();
        for (std::size_t i = first; i < pictures.size(); ++i) {
            const auto drawn = locate(path, pictures[i]);
            if (!drawn) continue;
            const std::size_t from = path.snapshot_at(drawn->time, drawn->newest);
            const std::size_t to = std::min(from + 1, drawn->newest);
            if (!is_overlaid(path.snapshots()[from].frame, slot_) ||
                !is_overlaid(path.snapshots()[to].frame, slot_))
                continue;
            result.push_back(
                {pictures[i], *drawn, path.view(drawn->time, drawn->newest), &path.snapshots()[from].frame});
        }
        return result;
    }
};

// No picture between the views on both sides of a cut, none that stands still while newer snapshots wait,
// none that is older than interpolation needs.
void expect_views_as_commanded(const CommandedPath& path, const std::vector<Judged>& pictures) {
    for (const Judged& picture : pictures) {
        const DrawnView& drawn = picture.drawn;
        EXPECT_LE(drawn.offset, 0.1) << "units off the commanded path at " << drawn.time << " ms";
        EXPECT_LE(drawn.turn, 0.1) << "degrees off the commanded view at " << drawn.time << " ms";
        EXPECT_LE(drawn.age, 1.5) << "snapshots behind at " << drawn.time << " ms";
    }
    for (std::size_t i = 1; i < pictures.size(); ++i) {
        const DrawnView& before = pictures[i - 1].drawn;
        const DrawnView& after = pictures[i].drawn;
        if (path.snapshots()[after.newest].frame.level_time <= before.time) continue;
        EXPECT_GT(after.latest_time, before.time) << "stands still";
    }
}

// Between two snapshots that are not separated by a cut the camera moves as a camera can.
void expect_declared_cuts(const CommandedPath& path, int spectator) {
    constexpr double fastest = 2000.0;  // units per second; a player runs at 320
    const auto& snapshots = path.snapshots();
    for (std::size_t i = 1; i < snapshots.size(); ++i) {
        const witness_record &from = snapshots[i - 1].frame, &to = snapshots[i].frame;
        if (snapshots[i].cut || !is_overlaid(to, spectator)) continue;
        ASSERT_TRUE(is_overlaid(from, spectator))
            << "the camera begins without a cut at " << to.level_time << " ms";
        const double step =
            (vector(to.players[spectator].origin) - vector(from.players[spectator].origin)).norm();
        EXPECT_LE(step, fastest * (to.level_time - from.level_time) / 1000.0)
            << "at " << to.level_time << " ms";
    }
}

// The director's cameras by their own observer: what the server sends is one of the last 250 ms, moved only
// within its free space.
void expect_cameras_of_the_director(const CommandedPath& path, int spectator,
                                    const std::vector<CameraTape::Entry>& tape) {
    std::size_t oldest = 0;
    for (const auto& snapshot : path.snapshots()) {
        const int time = snapshot.frame.level_time;
        if (!is_overlaid(snapshot.frame, spectator)) continue;
        while (oldest < tape.size() && tape[oldest].level_time < time - 250)
            ++oldest;
        const Vec3d sent = vector(snapshot.frame.players[spectator].origin);
        double excess = std::numeric_limits<double>::infinity();
        for (std::size_t i = oldest; i < tape.size() && tape[i].level_time <= time; ++i) {
            const auto& camera = tape[i].camera;
            excess = std::min(
                excess, (sent - vector(camera.position)).norm() - static_cast<double>(camera.clearance));
        }
        EXPECT_LE(excess, 0.01) << "at " << time << " ms";
    }
}

// In pixels. Corpses of the marked player have the marker's model too: pictures that may show one are left
// out.
class Markers {
  public:
    explicit Markers(const CommandedPath& path, const oracle::Oracle& map) : path_(path), map_(map) {}

    void judge(const Judged& picture) {
        if (may_show_corpse(picture)) return;
        const Vec3d place = path_.player(marker, picture.drawn.time, picture.drawn.newest);
        const auto box = box_at(picture, picture.drawn.time);
        expect_in(extended(box, picture), picture);
        if (!box || !is_in_sight(picture, place, *box)) return;
        ++in_sight_;
        constexpr double ellipse = std::numbers::pi / 4;
        const double area = ellipse * (box->right - box->left) * (box->bottom - box->top);
        if (picture.picture.marker_pixels >= area / 3) ++drawn_;
    }

    [[nodiscard]] int in_sight() const { return in_sight_; }
    [[nodiscard]] int drawn() const { return drawn_; }

  private:
    static bool may_show_corpse(const Judged& picture) {
        for (int i = 0; i < picture.from->corpse_count; ++i) {
            const witness_corpse& corpse = picture.from->corpses[i];
            constexpr double reach = 48.0;  // falls so far between two snapshots
            const Vec3d relative =
                picture.commanded.axes.transpose() * (vector(corpse.base) - picture.commanded.position);
            if (corpse.slot == marker && relative.x() > -reach) return true;
        }
        return false;
    }

    std::optional<PixelBox> box_at(const Judged& picture, int time) const {
        return picture_of_ball(path_.view(time, picture.drawn.newest),
                               path_.player(marker, time, picture.drawn.newest), marker_radius,
                               picture.picture.width, picture.picture.height);
    }

    // By what the time drawn is not known better.
    std::optional<PixelBox> extended(std::optional<PixelBox> box, const Judged& picture) const {
        for (const int time : {picture.drawn.earliest_guess, picture.drawn.latest_guess}) {
            const auto other = box_at(picture, time);
            if (!box || !other) return std::nullopt;
            box = PixelBox{std::min(box->left, other->left), std::min(box->top, other->top),
                           std::max(box->right, other->right), std::max(box->bottom, other->bottom)};
        }
        return box;
    }

    void expect_in(const std::optional<PixelBox>& box, const Judged& picture) const {
        const drawn_record& seen = picture.picture;
        if (seen.marker_pixels == 0) return;
        const int time = picture.drawn.time;
        ASSERT_TRUE(box) << "pixels of a player who is not in front of the camera at " << time << " ms";
        // Pixels. Clients extrapolate players, and not the camera, while a snapshot is late.
        const int extrapolated = std::max(0, time - path_.snapshots()[picture.drawn.newest].frame.level_time);
        const double tolerance = 1.5 + 0.1 * extrapolated;
        SCOPED_TRACE(std::to_string(time) + " ms, of them " + std::to_string(extrapolated) +
                     " ms extrapolated");
        EXPECT_GE(seen.marker_left, box->left - tolerance);
        EXPECT_GE(seen.marker_top, box->top - tolerance);
        EXPECT_LE(seen.marker_right + 1, box->right + tolerance);
        EXPECT_LE(seen.marker_bottom + 1, box->bottom + tolerance);
    }

    // Alive, whole in the picture, and hidden by neither the map nor other players.
    bool is_in_sight(const Judged& picture, const Vec3d& place, const PixelBox& box) const {
        const witness_record& next = path_.snapshots()[picture.drawn.newest].frame;
        if (picture.from->players[marker].health <= 0 || next.players[marker].health <= 0) return false;
        if (box.left < 0 || box.top < 0 || box.right > picture.picture.width ||
            box.bottom > picture.picture.height)
            return false;
        const Vec3d& eye = picture.commanded.position;
        for (int axis = 0; axis < 3; ++axis) {
            for (const double side : {-marker_radius, marker_radius}) {
                if (!map_.segment_clear(eye, place + side * Vec3d::Unit(axis))) return false;
            }
        }
        const Vec3d sight = place - eye;
        for (int slot = 0; slot < witness_slots; ++slot) {
            const witness_player& other = picture.from->players[slot];
            if (slot == marker || !other.bot || !other.in_game) continue;
            const Vec3d there = path_.player(slot, picture.drawn.time, picture.drawn.newest);
            const double along = std::clamp((there - eye).dot(sight) / sight.squaredNorm(), 0.0, 1.0);
            constexpr double reach = 80.0;  // of a player with a weapon
            if ((eye + along * sight - there).norm() < reach) return false;
        }
        return true;
    }

    const CommandedPath& path_;
    const oracle::Oracle& map_;
    int in_sight_ = 0, drawn_ = 0;
};

TEST_F(Picture, ShowsTheFollowedPlayerWhereTheCameraProjectsThem) {
    ASSERT_NO_FATAL_FAILURE(join());
    ASSERT_NO_FATAL_FAILURE(follow(marker));
    const std::size_t first = client_->drawn().size();
    for (const int other : {1, 2, 3}) {  // another player is a cut
        ASSERT_TRUE(client_->draws(80)) << logs();
        ASSERT_NO_FATAL_FAILURE(follow(other));
        ASSERT_TRUE(client_->draws(10)) << logs();
        ASSERT_NO_FATAL_FAILURE(follow(marker));
    }
    ASSERT_TRUE(client_->draws(80)) << logs();

    const CommandedPath path(server_->witnessed(), slot_);
    const auto pictures = judged(path, first);
    EXPECT_GE(pictures.size(), 300U) << logs();
    expect_views_as_commanded(path, pictures);
    expect_declared_cuts(path, slot_);
    if (tape_->gaps() == 0) expect_cameras_of_the_director(path, slot_, tape_->entries());

    const auto scene = scene::load(*openarena_map("oa_dm1"));
    ASSERT_TRUE(scene);
    const oracle::Oracle map(*scene);
    Markers markers(path, map);
    for (const Judged& picture : pictures)
        ASSERT_NO_FATAL_FAILURE(markers.judge(picture));
    RecordProperty("pictures", static_cast<int>(pictures.size()));
    RecordProperty("in_sight", markers.in_sight());
    RecordProperty("drawn", markers.drawn());
    EXPECT_GE(markers.in_sight(), 60) << "pictures with the marked player in sight, of " << pictures.size();
    // Explosions and smoke may hide the rest.
    EXPECT_GE(markers.drawn(), 0.95 * markers.in_sight());
    expect_players_untouched();
}

}  // namespace
}  // namespace camdir::test
