#include "hand_over_rows.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace camdir::soak {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds absence{6000};
// DDS forgets who is silent for 10 s.
constexpr milliseconds long_absence{12'000}, forgotten_absence{15'000};

const std::vector<Stage::Way> leader_cut_off{{Stage::leaders, Stage::standbys},
                                             {Stage::standbys, Stage::leaders},
                                             {Stage::leaders, Stage::clients},
                                             {Stage::clients, Stage::leaders}};
const std::vector<Stage::Way> standby_cut_off{{Stage::leaders, Stage::standbys},
                                              {Stage::standbys, Stage::leaders},
                                              {Stage::standbys, Stage::clients},
                                              {Stage::clients, Stage::standbys}};
const std::vector<Stage::Way> directors_apart{{Stage::leaders, Stage::standbys},
                                              {Stage::standbys, Stage::leaders}};
const std::vector<Stage::Way> clients_cut_off{{Stage::leaders, Stage::clients},
                                              {Stage::clients, Stage::leaders},
                                              {Stage::standbys, Stage::clients},
                                              {Stage::clients, Stage::standbys}};
const std::vector<Stage::Way> all_cut_off{
    {Stage::leaders, Stage::clients},  {Stage::clients, Stage::leaders},  {Stage::standbys, Stage::clients},
    {Stage::clients, Stage::standbys}, {Stage::leaders, Stage::standbys}, {Stage::standbys, Stage::leaders}};
const std::vector<Stage::Way> leader_deaf{{Stage::standbys, Stage::leaders},
                                          {Stage::clients, Stage::leaders}};
const std::vector<Stage::Way> leader_dumb{{Stage::leaders, Stage::standbys},
                                          {Stage::leaders, Stage::clients}};

void hand_over(Stage& stage) {
    if (!stage.leader->hand_over())
        throw std::runtime_error("the leader keeps matches for want of a standby\n" + stage.leader->log());
}

// What the network does between hosts.
std::vector<Row> network_rows() {
    const auto row = [](const std::string& name, const std::vector<Stage::Way>& ways, milliseconds duration,
                        std::uint64_t changes) {
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(duration).count();
        return Row{.name = name + " " + std::to_string(seconds) + " s",
                   .happens = [&ways, duration](Stage& s) { s.cut(ways, duration); },
                   .changes = changes,
                   .means = Row::Means::hosts};
    };
    // Nobody can serve the observer for that long, and when they meet again all must be sent anew.
    const auto blind = [](Row of, milliseconds duration) {
        of.more_gap_ms = std::chrono::duration<double, std::milli>(duration + milliseconds(500)).count();
        of.fills_delay = true;
        return of;
    };
    return {
        {.name = "nothing, three hosts", .happens = [](Stage&) {}, .means = Row::Means::hosts},
        row("leader cut off", leader_cut_off, absence, 1),
        row("leader cut off", leader_cut_off, forgotten_absence, 1),
        row("leader deaf", leader_deaf, absence, 1),
        row("leader deaf", leader_deaf, forgotten_absence, 1),
        row("leader dumb", leader_dumb, absence, 1),
        row("leader dumb", leader_dumb, forgotten_absence, 1),
        row("standby cut off", standby_cut_off, absence, 0),
        row("standby cut off", standby_cut_off, forgotten_absence, 0),
        row("directors apart", directors_apart, absence, 1),
        row("directors apart", directors_apart, forgotten_absence, 1),
        blind(row("clients cut off", clients_cut_off, absence, 0), absence),
        blind(row("clients cut off", clients_cut_off, forgotten_absence, 0), forgotten_absence),
        blind(row("all cut off", all_cut_off, absence, 1), absence),
        blind(row("all cut off", all_cut_off, forgotten_absence, 1), forgotten_absence),
    };
}

std::vector<Row> clock_rows() {
    const auto row = [](const std::string& name, auto clock, std::chrono::seconds by) {
        return Row{.name = name + (by.count() < 0 ? " an hour back" : " an hour on"),
                   .happens = [=](Stage& s) { (s.*clock)->step(by); },
                   .means = Row::Means::clocks};
    };
    constexpr std::chrono::hours hour{1};
    return {row("leader's clock", &Stage::leader_clock, hour),
            row("leader's clock", &Stage::leader_clock, -hour), row("game's clock", &Stage::game_clock, hour),
            row("game's clock", &Stage::game_clock, -hour)};
}

std::vector<Row> process_rows() {
    const auto pause = [] { std::this_thread::sleep_for(absence); };
    return {
        {.name = "nothing", .happens = [](Stage&) {}},
        {.name = "leader killed", .happens = [](Stage& s) { s.leader->signal(SIGKILL); }, .changes = 1},
        {.name = "leader SIGTERM",
         .happens = [](Stage& s) { s.leader->signal(SIGTERM); },
         .changes = 1,
         .planned = true},
        {.name = "leader hands over", .happens = hand_over, .changes = 1, .planned = true},
        {.name = "leader stopped 6 s",
         .happens =
             [=](Stage& s) {
                 s.leader->signal(SIGSTOP);
                 pause();
                 s.leader->signal(SIGCONT);
             },
         .changes = 1},
        {.name = "leader stopped 12 s",
         .happens =
             [](Stage& s) {
                 s.leader->signal(SIGSTOP);
                 std::this_thread::sleep_for(long_absence);
                 s.leader->signal(SIGCONT);
             },
         .changes = 1},
        {.name = "leader killed, back",
         .happens =
             [=](Stage& s) {
                 s.leader->signal(SIGKILL);
                 s.leader->wait();
                 pause();
                 s.start_leader();
             },
         .changes = 1},
        {.name = "both start together", .happens = [](Stage&) {}, .from_start = true},
        {.name = "leader back, baking",
         .happens =
             [=](Stage& s) {
                 s.leader->signal(SIGKILL);
                 s.leader->wait();
                 std::this_thread::sleep_for(milliseconds(1000));
                 s.return_while_the_map_is_baked();
             },
         .changes = 1},
        {.name = "standby stopped 6 s",
         .happens =
             [=](Stage& s) {
                 s.standby->signal(SIGSTOP);
                 pause();
                 s.standby->signal(SIGCONT);
             }},
        {.name = "standby killed", .happens = [](Stage& s) { s.standby->signal(SIGKILL); }},
        {.name = "leader's workers hang 6 s",
         .happens = [](Stage& s) { s.leader->hang_threads("worker-", absence); },
         .changes = 1},
        {.name = "leader's reception hangs 6 s",
         .happens = [](Stage& s) { s.leader->hang_threads("reception", absence); },
         .changes = 1},
        {.name = "observer late 1 s",
         .happens = [](Stage& s) { s.pause_observer(milliseconds(1000)); },
         .more_gap_ms = 1000.0},
        {.name = "game stopped 6 s",
         .happens =
             [=](Stage& s) {
                 s.game->send_signal(SIGSTOP);
                 pause();
                 s.game->send_signal(SIGCONT);
             },
         .more_gap_ms = 6000.0,
         .forced = 1},
        {.name = "game restarted",
         .happens =
             [](Stage& s) {
                 s.game->send_signal(SIGKILL);
                 s.game->wait();
                 s.start_game();
             },
         .more_gap_ms = 1000.0},
    };
}

}  // namespace

std::vector<Row> rows() {
    std::vector<Row> all;
    for (std::vector<Row>& some : std::array{process_rows(), network_rows(), clock_rows()})
        std::ranges::move(some, std::back_inserter(all));
    return all;
}

}  // namespace camdir::soak
