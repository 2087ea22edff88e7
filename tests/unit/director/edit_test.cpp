// What an automatic shot shows, beside the programme of the pure editor.
#include "director/edit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <numeric>
#include <random>
#include <set>

#include "delayed_times.hpp"
#include "direction/programme.hpp"
#include "stage.hpp"
#include "support/freespace_meshes.hpp"
#include "support/mover_twins.hpp"

namespace camdir::director {
namespace {

constexpr std::uint32_t frames = 400;  // of 50 ms
constexpr std::size_t players = 5;

struct Recorded {
    std::vector<PoseFrame> frames;
    std::vector<MatchEvent> events;  // ascending by time
};

// Players who walk, look about, die and are hurt.
Recorded random_match(std::uint32_t seed) {
    std::mt19937 random(seed);
    Recorded match;
    std::vector<bool> alive(players, true);
    for (std::uint32_t number = 0; number < frames; ++number) {
        PoseFrame frame = Stage::poses(number, 1, {1, 2, 3, 4, 5});
        for (std::size_t i = 0; i < players; ++i) {
            PlayerPose& pose = frame.poses[i];
            const float angle = 0.01F * static_cast<float>((i + 1) * number) + static_cast<float>(i);
            pose.orientation = Quatf(Eigen::AngleAxisf(angle, Vec3f::UnitZ()));
            pose.velocity = Vec3f(100.0F, 0.0F, 0.0F);
            if (number > 0 && random() % 60 == 0) alive[i] = !alive[i];
            if (!alive[i]) pose.flags = 0;
            if (random() % 100 == 0) pose.flags |= pose_discontinuity;
        }
        const auto player = [&] { return static_cast<std::uint32_t>(1 + random() % players); };
        if (random() % 8 == 0) match.events.push_back({1, frame.frame_time, 5, player(), player(), 10.0F});
        if (random() % 25 == 0) match.events.push_back({1, frame.frame_time, 1, player(), player(), 1.0F});
        if (random() % 25 == 0) match.events.push_back({1, frame.frame_time, 99, player(), player(), 1.0F});
        match.frames.push_back(std::move(frame));
    }
    // Before the first poses nobody knows who an event is about.
    std::erase_if(match.events, [](const MatchEvent& event) { return event.frame_time == 0; });
    return match;
}

struct Cut {
    direction::Beat beat;
    std::uint32_t player;
    std::uint32_t fixed;
    std::string why;

    bool operator==(const Cut&) const = default;
};

class EditTest : public testing::TestWithParam<double> {
  protected:
    [[nodiscard]] Edit::Setting setting(double delay_s) const {
        return {{space_, &movers_}, rules_, 256, delay_s, 20.0};
    }
    [[nodiscard]] static double unit() {
        return 0.0254 / static_cast<double>(Stage::square().metadata().metres_per_unit);
    }

    // What is shown, with the delay; `early`: how much sooner than that everything is in the buffer. Without
    // a delay, what comes before the first poses is not kept.
    [[nodiscard]] std::vector<Cut> shown(const Recorded& match, double delay_s, std::uint32_t early) const {
        DelayBuffer buffer(std::size_t{64} << 20U);
        buffer.announce(1, delay_s, 0);
        const auto delay = static_cast<std::uint32_t>(delay_s * 20.0);
        Edit edit;
        AutomaticShot shot;
        Roster roster;
        std::size_t next_frame = 0;
        std::size_t next_event = 0;
        std::vector<Cut> cuts;
        for (const PoseFrame& frame : match.frames) {
            const auto receive = [&](const PoseFrame& later) {
                for (; next_event < match.events.size() &&
                       match.events[next_event].frame_time <= later.frame_time;
                     ++next_event) {
                    Message event = match.events[next_event];
                    if (buffer.put(event, later.frame_time) == DelayBuffer::Admission::undelayed)
                        edit.record(match.events[next_event]);
                }
                static_cast<void>(buffer.put(later, later.frame_time));
            };
            const std::uint32_t ahead = delay + (frame.frame_number > 0 || delay_s > 0.0 ? early : 0);
            while (next_frame < match.frames.size() && next_frame <= frame.frame_number + ahead)
                receive(match.frames[next_frame++]);
            roster.update(frame.poses, 1000);
            edit.show(frame, buffer, setting(delay_s));
            if (edit.choose(shot, {}, roster, setting(delay_s)))
                cuts.push_back({edit.decided(), shot.player, shot.fixed, shot.reason.why});
            edit.look(setting(delay_s));
        }
        return cuts;
    }

    // The same by the pure editor, from footage that is complete before it begins.
    [[nodiscard]] std::vector<Cut> directed(const Recorded& match, double delay_s) const {
        const std::size_t fixed = space_.fixed_shots().size();
        direction::Material known(0, std::vector(fixed, direction::nobody));
        std::vector<std::size_t> followed(players);
        std::iota(followed.begin(), followed.end(), fixed);
        for (std::size_t i = 0; i < players; ++i)
            known.add_player();
        for (const MatchEvent& event : match.events)
            if (event.kind == 1 || event.kind == 5)
                known.add({static_cast<double>(event.frame_time) * 1e-9,
                           event.kind == 1 ? direction::EventKind::kill : direction::EventKind::damage,
                           static_cast<direction::Index>(event.actor - 1),
                           static_cast<direction::Index>(event.subject - 1), 0.0});
        const auto foresight = direction::beat_of(Edit::foresight_s(delay_s));
        direction::Cutter cutter;
        std::vector<Cut> cuts;
        for (direction::Beat now = 0; now < frames / 2; now += direction::cut_every) {
            const direction::Beat end = now == 0 ? std::min<direction::Beat>(3, foresight) : now + foresight;
            while (known.footage().beats() < std::min<direction::Beat>(end, frames / 2 - 1))
                append(known, match, static_cast<std::size_t>(known.footage().beats()));
            const bool nothing_known = known.footage().beats() == 0;
            const auto begun = cutter.decide(known, known.moments(rules_, unit(), now), rules_, unit(), now,
                                             nothing_known ? followed : std::vector<std::size_t>());
            if (!begun) continue;
            const auto rush = static_cast<std::uint32_t>(begun->rush);
            const std::string why(direction::name_of(begun->reason, rules_));
            cuts.push_back(
                rush < fixed ? Cut{now, no_player, rush, why}
                             : Cut{now, static_cast<std::uint32_t>(rush - fixed + 1), freespace::none, why});
        }
        return cuts;
    }

    void append(direction::Material& known, const Recorded& match, std::size_t beat) const {
        Scout scout(space_.fixed_shots().size());
        while (scout.players.size() < players)
            scout.add_player();
        for (std::size_t i = 0; i < players; ++i) {
            const PlayerPose& pose = match.frames[2 * beat].poses[i];
            direction::PlayerState& state = scout.players[i];
            state.eye = pose.eye;
            state.facing = pose.orientation * Vec3f::UnitX();
            state.speed = 100.0F;
            state.present = true;
            state.alive = (pose.flags & pose_alive) != 0;
            scout.present.push_back(static_cast<direction::Index>(i));
            for (std::size_t frame = 2 * beat; frame < 2 * beat + 2; ++frame)
                if ((match.frames[frame].poses[i].flags & pose_discontinuity) != 0)
                    scout.takes[scout.fixed + i].jump(frame == 2 * beat);
        }
        while (!scout.finished())
            scout.look(space_, static_cast<float>(unit()));
        known.append(scout.players, scout.takes);
    }

    freespace::Freespace space_ = Stage::square();
    freespace::Movers movers_;
    direction::Rules rules_ = direction::default_rules();
};

// Cameras that never jump are chosen, too.
class EditWhereJumpsCostMuchTest : public EditTest {
  protected:
    EditWhereJumpsCostMuchTest() { rules_.grammar.inner_cut = 4.0; }
};

TEST_P(EditTest, ShowsTheProgrammeOfThePureEditor) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        const Recorded match = random_match(seed);
        const auto cuts = shown(match, GetParam(), 1);
        EXPECT_GT(cuts.size(), 1U);
        EXPECT_TRUE(cuts == directed(match, GetParam())) << "seed " << seed;
    }
}

TEST_P(EditWhereJumpsCostMuchTest, ShowsTheProgrammeOfThePureEditor) {
    std::set<bool> kinds;
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        const Recorded match = random_match(seed);
        const auto cuts = shown(match, GetParam(), 1);
        EXPECT_GT(cuts.size(), 1U);
        EXPECT_TRUE(cuts == directed(match, GetParam())) << "seed " << seed;
        for (const Cut& cut : cuts)
            kinds.insert(cut.player == no_player);
    }
    // Live nothing tells whom a fixed camera is going to show, and a second ahead little.
    if (GetParam() != 1.0) {
        EXPECT_EQ(kinds.size(), GetParam() > 0.0 ? 2U : 1U) << "players followed, and fixed shots";
    }
}

TEST_P(EditTest, FollowsPlayersAloneWhereSetSo) {
    rules_.grammar.fixed_shots = false;
    const auto cuts = shown(random_match(2), GetParam(), 1);
    EXPECT_GT(cuts.size(), 1U);
    for (const Cut& cut : cuts)
        EXPECT_NE(cut.player, no_player);
}

// The only fixed shot of the map: none begins beside a mover, nor one whose player a mover hides.
TEST_F(EditWhereJumpsCostMuchTest, ShowsNoFixedShotThatAMoverIsInTheWayOf) {
    const freespace::FixedShot& shot = space_.fixed_shots()[0];
    const Quatf yaw(Eigen::AngleAxisf(shot.yaw, Vec3f::UnitZ()));
    const auto fixed_cuts = [&](const Vec3f& min, const Vec3f& max, double arrives = 0.0) {
        freespace::MoverShape plate;
        plate.hulls = {test::box_hull(min, max)};
        movers_ = *freespace::Movers::of(std::vector{plate});
        const Vec3f below = shot.position - 1000.0F * Vec3f::UnitZ();
        if (arrives > 0.0) movers_.add(0.0, std::vector<freespace::MoverPose>{{0, below, yaw}});
        movers_.add(arrives, std::vector<freespace::MoverPose>{{0, shot.position, yaw}});
        const auto cuts = shown(random_match(1), 5.0, 1);
        return std::ranges::count(cuts, no_player, &Cut::player);
    };
    const auto unit = static_cast<float>(EditTest::unit());
    EXPECT_GT(fixed_cuts({-20.0F * unit, -1.0F, -1.0F}, {-10.0F * unit, 1.0F, 1.0F}), 0) << "behind it";
    EXPECT_EQ(fixed_cuts({-20.0F * unit, -1.0F, -1.0F}, {-7.0F * unit, 1.0F, 1.0F}), 0) << "near behind it";
    EXPECT_EQ(fixed_cuts({-20.0F * unit, -1.0F, -1.0F}, {-7.0F * unit, 1.0F, 1.0F}, 1.5), 0) << "soon";
    EXPECT_GT(fixed_cuts({-20.0F * unit, -1.0F, -1.0F}, {-7.0F * unit, 1.0F, 1.0F}, 4.0), 0) << "later";
    EXPECT_EQ(fixed_cuts({9.0F * unit, -40.0F, -40.0F}, {10.0F * unit, 40.0F, 40.0F}), 0) << "before it";
}

TEST_P(EditTest, WhatLiesBeyondTheDelayChangesNothing) {
    for (std::uint32_t seed = 1; seed <= 8; ++seed) {
        const Recorded match = random_match(seed);
        const auto cuts = shown(match, GetParam(), 0);
        EXPECT_GT(cuts.size(), 1U);
        EXPECT_TRUE(cuts == shown(match, GetParam(), frames)) << "seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Delays, EditTest, testing::Values(0.0, 1.0, 5.0));
INSTANTIATE_TEST_SUITE_P(Delays, EditWhereJumpsCostMuchTest, testing::Values(0.0, 1.0, 5.0));

TEST_F(EditTest, WhatIsForeseenHasTheTeamsOfItsTime) {
    const auto team_of = [](std::uint8_t team) {
        MatchInfo info = Stage::info();
        info.players = {{1, "anna", "", team}, {2, "ben", "", 2}};
        return info;
    };
    DelayBuffer buffer(std::size_t{1} << 20U);
    buffer.announce(1, 5.0, 0);
    for (std::uint32_t number = 0; number <= 100; ++number) {
        const PoseFrame frame = Stage::poses(number, 1, {1, 2});
        if (number == 60) {
            Message swapped = team_of(2);
            ASSERT_EQ(buffer.put(swapped, frame.frame_time), DelayBuffer::Admission::delayed);
        }
        ASSERT_EQ(buffer.put(frame, frame.frame_time), DelayBuffer::Admission::delayed);
    }
    Edit edit;
    edit.set_players(team_of(1).players);
    for (std::uint32_t number = 0; number < 40; ++number) {
        if (number == 20) edit.set_players(team_of(1).players);  // shown late
        edit.show(Stage::poses(number, 1, {1, 2}), buffer, setting(5.0));
        edit.look(setting(5.0));
    }
    const direction::Footage& footage = edit.material().footage();
    ASSERT_GT(footage.beats(), 40);
    for (direction::Beat beat = 0; beat < footage.beats(); ++beat)
        EXPECT_EQ(footage.player(beat, 0).team, beat < 30 ? 1 : 2) << beat;
}

// Two players, and a door between them or what else the movers are.
class EditAmongMoversTest : public EditTest {
  protected:
    using Movers = std::shared_ptr<const MatchMovers>;

    [[nodiscard]] static Movers standing(const std::shared_ptr<const MoverInfo>& info,
                                         const Vec3f& position) {
        MoverFrame frame;
        frame.epoch = 1;
        frame.poses.push_back({7, position, Quatf::Identity()});
        return std::make_shared<const MatchMovers>(
            MatchMovers{info, std::make_shared<const MoverFrame>(std::move(frame))});
    }

    // Of 100 frames, two a beat, whether the players see each other. With a delay 30 are shown, and the rest
    // is foreseen.
    template <class MoversOf>
    [[nodiscard]] std::vector<bool> sights(double delay_s, double rate_hz, const MoversOf& movers_of) const {
        const auto frame_of = [&](std::uint32_t number) {
            PoseFrame frame = Stage::poses(number, 1, {1, 2});
            frame.poses[0].eye = {40.0F, 50.0F, 0.0F};
            frame.poses[1].eye = {60.0F, 50.0F, 0.0F};
            frame.movers = movers_of(number);
            return frame;
        };
        DelayBuffer buffer(std::size_t{1} << 20U);
        buffer.announce(1, delay_s, 0);
        for (std::uint32_t number = 0; number < 100; ++number)
            static_cast<void>(buffer.put(frame_of(number), received(number)));
        Edit::Setting rules = setting(delay_s);
        rules.rate_hz = rate_hz;
        Edit edit;
        for (std::uint32_t number = 0; number < (delay_s > 0.0 ? 30U : 100U); ++number) {
            edit.show(frame_of(number), buffer, rules);
            edit.look(rules);
        }
        std::vector<bool> sees;
        const direction::Footage& footage = edit.material().footage();
        EXPECT_EQ(footage.first(), 0);
        for (direction::Beat beat = 0; beat < footage.beats(); ++beat)
            sees.push_back(footage.player(beat, 0).sees[1]);
        return sees;
    }
};

TEST_F(EditAmongMoversTest, AMoverHidesWhoIsBehindItWhileItIsThere) {
    const auto info = std::make_shared<MoverInfo>();
    info->epoch = 1;
    Mover& door = info->movers.emplace_back(Mover{7, {}});
    door.shape.hulls = {test::box_hull({-2.0F, -30.0F, -30.0F}, {2.0F, 30.0F, 30.0F})};
    const Movers open = standing(info, {50.0F, 50.0F, -1000.0F});
    const Movers closed = standing(info, {50.0F, 50.0F, 0.0F});
    const auto none = std::make_shared<MoverInfo>();
    none->epoch = 1;
    const Movers gone = standing(none, {50.0F, 50.0F, 0.0F});
    const auto movers_of = [&](std::uint32_t number) {
        if (number < 41) return open;
        return number < 61 ? closed : gone;
    };
    for (const double delay_s : {0.0, 5.0})
        for (const double rate_hz : {10.0, 60.0}) {
            const auto sees = sights(delay_s, rate_hz, movers_of);
            ASSERT_GT(sees.size(), 40U);
            for (std::size_t beat = 0; beat < sees.size(); ++beat)
                EXPECT_EQ(sees[beat], beat < 21 || beat > 30) << delay_s << " s, beat " << beat;
        }
}

TEST_F(EditAmongMoversTest, WhoSitsInAVehicleSeesAndIsSeen) {
    const auto info = std::make_shared<MoverInfo>();
    info->epoch = 1;
    info->movers.emplace_back(Mover{7, {}}).shape.balls.push_back({Vec3f::Zero(), 5.0F});
    for (const float x : {40.0F, 60.0F}) {
        const auto sees =
            sights(0.0, 20.0, [vehicle = standing(info, {x, 50.0F, 0.0F})](auto) { return vehicle; });
        ASSERT_FALSE(sees.empty());
        EXPECT_TRUE(std::ranges::all_of(sees, std::identity())) << x;
    }
    const auto sees = sights(0.0, 20.0, [ball = standing(info, {50.0F, 50.0F, 0.0F})](auto) { return ball; });
    EXPECT_TRUE(std::ranges::none_of(sees, std::identity()));
}

// A game's clock that jumps makes no cut.
TEST_F(EditTest, AJumpOfTheClockKeepsTheShot) {
    Edit edit;
    AutomaticShot shot;
    Roster roster;
    const DelayBuffer live(1U << 20U);
    const auto show = [&](std::uint32_t number, std::int64_t offset) {
        PoseFrame frame = Stage::poses(number);
        frame.frame_time += offset;
        roster.update(frame.poses, 1000);
        edit.show(frame, live, setting(0.0));
        const bool begins = edit.choose(shot, {}, roster, setting(0.0));
        edit.look(setting(0.0));
        return begins;
    };
    EXPECT_TRUE(show(1, 0));
    std::uint32_t number = 2;
    for (const std::int64_t offset : {3600'000 * ms, -3600'000 * ms}) {
        const std::uint32_t player = shot.player;
        for (const std::uint32_t end = number + 20; number < end; ++number)
            EXPECT_FALSE(show(number, offset));
        EXPECT_EQ(shot.player, player);
    }
}

TEST_F(EditTest, ManyStrangersAreNoReasonToForgetTheShot) {
    Edit edit;
    AutomaticShot shot;
    Roster roster;
    const DelayBuffer live(1U << 20U);
    const std::vector<std::uint32_t> among{1};
    for (std::uint32_t number = 1; number < 400; ++number) {
        const PoseFrame frame = Stage::poses(number, 1, {1, 1000 + number});
        roster.update(frame.poses, 1);
        edit.show(frame, live, setting(0.0));
        edit.choose(shot, {among}, roster, setting(0.0));
        edit.look(setting(0.0));
        EXPECT_EQ(shot.player, 1U);
        EXPECT_LE(edit.material().footage().players(), direction::max_players);
    }
    EXPECT_EQ(shot.reason.why, "opening");
}

}  // namespace
}  // namespace camdir::director
