// What a spectator's client draws, in pixels: pictures against the views and poses that the server sent.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

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
    bool before_cut;             // the next snapshot is a cut
};

Vec3d vector(const float* values) {
    return Eigen::Map<const Eigen::Vector3f>(values).cast<double>();
}

class Picture : public LiveMatch {
  protected:
    // The pictures since the `first`th that the client drew from the director's cameras.
    std::vector<Judged> judged(const CommandedPath& path, std::size_t first) {
        std::vector<Judged> result;
        const auto& pictures = spectator().client().drawn();
        for (std::size_t i = first; i < pictures.size(); ++i) {
            const auto drawn = locate(path, pictures[i]);
            if (!drawn) continue;
            const std::size_t from = path.snapshot_at(drawn->time, drawn->newest);
            const std::size_t to = std::min(from + 1, drawn->newest);
            if (!is_overlaid(path.snapshots()[from].frame, spectator().slot()) ||
                !is_overlaid(path.snapshots()[to].frame, spectator().slot()))
                continue;
            result.push_back({pictures[i], *drawn, path.view(drawn->time, drawn->newest),
                              &path.snapshots()[from].frame, path.snapshots()[to].cut});
        }
        return result;
    }
};

// By how much the server or the client came late in the seconds before a picture, as the machine had other
// work. The client's clock, which aims at the newest snapshot, takes so long to recover.
class Lateness {
  public:
    Lateness(const CommandedPath& path, const std::vector<drawn_record>& pictures)
        : snapshots_(path.snapshots()), pictures_(pictures) {}

    [[nodiscard]] double before(const drawn_record& picture) const {
        return of_server(picture.time) + of_client(picture.time);
    }

  private:
    static constexpr double ns = 1e-6;                     // in ms
    static constexpr std::int64_t memory = 3'000'000'000;  // ns

    double of_server(std::int64_t time) const {
        double least = std::numeric_limits<double>::infinity(), most = -least;
        for (const auto& [frame, cut] : snapshots_) {
            if (frame.time > time || frame.time < time - memory) continue;
            const double delay =
                static_cast<double>(frame.time - snapshots_.front().frame.time) * ns - frame.level_time;
            least = std::min(least, delay);
            most = std::max(most, delay);
        }
        return std::max(0.0, most - least);
    }

    double of_client(std::int64_t time) const {
        constexpr double interval = 25.0;  // ms: the client's own limit
        double longest = interval;
        for (std::size_t i = 1; i < pictures_.size(); ++i) {
            if (pictures_[i].time > time || pictures_[i - 1].time < time - memory) continue;
            longest = std::max(longest, static_cast<double>(pictures_[i].time - pictures_[i - 1].time) * ns);
        }
        return longest - interval;
    }

    const std::vector<CommandedPath::Snapshot>& snapshots_;
    const std::vector<drawn_record>& pictures_;
};

// What is wrong with a picture, and with its place after the one before: it shows a view between those on
// both sides of a cut, stands still while newer snapshots wait, or is older than interpolation needs.
std::string fault(const CommandedPath& path, const Judged& picture, const Judged* before, double late) {
    constexpr double interval = 50.0;          // ms
    constexpr double sets_clock_anew = 100.0;  // ms: a client that is off by more
    const DrawnView& drawn = picture.drawn;
    std::ostringstream text;
    if (drawn.offset > 0.1) text << drawn.offset << " units off the commanded path; ";
    if (drawn.turn > 0.1) text << drawn.turn << " degrees off the commanded view; ";
    if (drawn.age > 1.5 + late / interval) text << drawn.age << " snapshots behind; ";
    if (before != nullptr && late <= sets_clock_anew && drawn.latest_time <= before->drawn.time &&
        path.snapshots()[drawn.newest].frame.level_time > before->drawn.time)
        text << "stands still; ";
    if (text.tellp() > 0) text << "at " << drawn.time << " ms, " << late << " ms late\n";
    return text.str();
}

// Nearly all pictures: which packets a client had when it drew one is known only by their times, and a client
// that a busy machine stops for a moment is behind for a few pictures more.
void expect_views_as_commanded(const CommandedPath& path, const std::vector<Judged>& pictures,
                               const Lateness& lateness) {
    std::size_t count = 0;
    std::string faults;
    for (std::size_t i = 0; i < pictures.size(); ++i) {
        const double late = lateness.before(pictures[i].picture);
        const std::string found = fault(path, pictures[i], i > 0 ? &pictures[i - 1] : nullptr, late);
        count += !found.empty();
        faults += found;
    }
    EXPECT_LE(count, 1 + pictures.size() / 10) << faults;
}

// Between two snapshots that are not separated by a cut the camera moves as a camera can.
void expect_declared_cuts(const CommandedPath& path, int spectator) {
    constexpr double fastest = 3500.0;  // units per second: a little above the cameras of recorded matches
    const auto& snapshots = path.snapshots();
    for (std::size_t i = 1; i < snapshots.size(); ++i) {
        const witness_record &from = snapshots[i - 1].frame, &to = snapshots[i].frame;
        if (snapshots[i].cut || !is_overlaid(to, spectator)) continue;
        ASSERT_TRUE(is_overlaid(from, spectator))
            << "the camera begins without a cut at " << to.level_time << " ms";
        const double step = (eye_of(to.players[spectator]) - eye_of(from.players[spectator])).norm();
        EXPECT_LE(step, fastest * (to.level_time - from.level_time) / 1000.0)
            << "at " << to.level_time << " ms";
    }
}

// The director's cameras by their own observer: what the server sends is one of them, moved only within its
// free space.
void expect_cameras_of_the_director(const CommandedPath& path, int spectator,
                                    const std::vector<CameraTape::Entry>& tape) {
    for (const auto& [frame, cut] : path.snapshots()) {
        if (!is_overlaid(frame, spectator)) continue;
        EXPECT_LE(distance_to_cameras(frame, spectator, tape), 0.01) << "at " << frame.level_time << " ms";
    }
}

// In pixels. Corpses of the marked player have the marker's model too: pictures that may show one are left
// out.
class Markers {
  public:
    Markers(const CommandedPath& path, const oracle::Oracle& map) : path_(path), map_(map) {}

    void judge(const Judged& picture) {
        // Clients extrapolate players whom they will not see after a cut.
        if (picture.before_cut || may_show_corpse(picture)) return;
        const Vec3d place = player(marker, picture.drawn.time, picture);
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

    Vec3d player(int slot, int time, const Judged& picture) const {
        return path_.player(slot, time, picture.drawn.newest,
                            picture.drawn.motions.at(static_cast<std::size_t>(slot)));
    }

    std::optional<PixelBox> box_at(const Judged& picture, int time) const {
        return picture_of_ball(path_.view(time, picture.drawn.newest), player(marker, time, picture),
                               marker_radius, picture.picture.width, picture.picture.height);
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
        if (!box) {
            EXPECT_TRUE(reaches_in_front(picture))
                << "pixels of a player behind the camera at " << time << " ms";
            return;
        }
        // Clients extrapolate players, and not the camera, while a snapshot is late.
        if (time > path_.snapshots()[picture.drawn.newest].frame.level_time) return;
        constexpr double tolerance = 1.5;  // pixels
        SCOPED_TRACE(std::to_string(time) + " ms");
        EXPECT_GE(seen.marker_left, box->left - tolerance);
        EXPECT_GE(seen.marker_top, box->top - tolerance);
        EXPECT_LE(seen.marker_right + 1, box->right + tolerance);
        EXPECT_LE(seen.marker_bottom + 1, box->bottom + tolerance);
    }

    bool reaches_in_front(const Judged& picture) const {
        const std::array guesses = {picture.drawn.earliest_guess, picture.drawn.latest_guess};
        return std::ranges::any_of(guesses, [&](int time) {
            const GameView camera = path_.view(time, picture.drawn.newest);
            const Vec3d place = player(marker, time, picture);
            return camera.axes.col(0).dot(place - camera.position) > -marker_radius;
        });
    }

    // Alive, in its own colour, whole in the picture, and hidden by neither the map nor other players.
    bool is_in_sight(const Judged& picture, const Vec3d& place, const PixelBox& box) const {
        const witness_record& next = path_.snapshots()[picture.drawn.newest].frame;
        if (picture.from->players[marker].health <= 0 || next.players[marker].health <= 0) return false;
        if (picture.from->players[marker].powerups != 0 || next.players[marker].powerups != 0) return false;
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
            const Vec3d there = player(slot, picture.drawn.time, picture);
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
    constexpr int enough_pictures = 300, enough_in_sight = 150, most_rounds = 30;
    const auto scene = scene::load(*openarena_map("oa_dm1"));
    ASSERT_TRUE(scene);
    const oracle::Oracle map(*scene);
    ASSERT_NO_FATAL_FAILURE(join());
    GameClient& client = spectator().client();
    int count = 0, in_sight = 0, drawn = 0;
    for (int round = 0; round < most_rounds && (count < enough_pictures || in_sight < enough_in_sight);
         ++round) {
        const std::size_t first = client.drawn().size();
        for (const int player : {1 + round % 7, marker}) {  // another player is a cut
            ASSERT_TRUE(spectator().follows(player)) << logs();
            ASSERT_TRUE(client.draws(player == marker ? 80 : 10)) << logs();
        }
        const CommandedPath path(server_->witnessed(), spectator().slot());
        const auto pictures = judged(path, first);
        expect_views_as_commanded(path, pictures, Lateness(path, client.drawn()));
        Markers markers(path, map);
        for (const Judged& picture : pictures)
            markers.judge(picture);
        count += static_cast<int>(pictures.size());
        in_sight += markers.in_sight();
        drawn += markers.drawn();
    }
    RecordProperty("pictures", count);
    RecordProperty("in_sight", in_sight);
    RecordProperty("drawn", drawn);
    EXPECT_GE(count, enough_pictures) << logs();
    EXPECT_GE(in_sight, enough_in_sight) << "pictures with the marked player in sight, of " << count;
    // Explosions and smoke may hide the rest: each some 20 pictures long.
    EXPECT_GE(drawn, 0.8 * in_sight);

    const CommandedPath path(server_->witnessed(), spectator().slot());
    expect_declared_cuts(path, spectator().slot());
    if (tape_->gaps() == 0) expect_cameras_of_the_director(path, spectator().slot(), tape_->entries());
    expect_players_untouched();
}

}  // namespace
}  // namespace camdir::test
