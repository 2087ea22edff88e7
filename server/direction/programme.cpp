#include "direction/programme.hpp"

#include <algorithm>
#include <iterator>

#include "direction/figures.hpp"

namespace camdir::direction {
namespace {

constexpr Beat history = 20;  // beats whose moments may reach into a plan
constexpr Beat never_shown = -1'000'000;

// Takes what becomes known, and cuts.
class Director {
  public:
    Director(const Footage& all, std::span<const Event> events, const Rules& rules, double unit)
        : all_(all), events_(events), rules_(rules), unit_(unit), known_(all.players(), all.subjects()) {
        on_air_.last_shown.assign(all.rushes(), never_shown);
    }

    void decide(Beat now, Beat end_of_known) {
        while (known_.beats() < end_of_known)
            known_.append(all_.players_at(known_.beats()), all_.takes_at(known_.beats()));
        const auto moments =
            find_moments(known_, known_events(), rules_, unit_, std::max<Beat>(0, now - history));
        const Shot next = plan_shots(known_, moments, rules_, unit_, on_air_, now).front();
        if (!on_air_.shot || on_air_.shot->rush != next.rush) cut_to(next, now);
        on_air_.last_shown[next.rush] = now;
    }

    std::vector<Shot> finish() {
        shots_.back().end = all_.beats();
        return std::move(shots_);
    }

  private:
    void cut_to(const Shot& next, Beat now) {
        if (!shots_.empty()) shots_.back().end = now;
        shots_.push_back({next.rush, now, now, next.reason});
        on_air_.shot = shots_.back();
    }

    [[nodiscard]] std::span<const Event> known_events() const {
        const double end = static_cast<double>(known_.beats()) * beat_s;
        return {events_.begin(), std::ranges::lower_bound(events_, end, {}, &Event::time)};
    }

    const Footage& all_;
    std::span<const Event> events_;
    const Rules& rules_;
    double unit_;
    Footage known_;
    OnAir on_air_;
    std::vector<Shot> shots_;
};

}  // namespace

Result<std::vector<Shot>> direct(const Footage& footage, std::span<const Event> events, const Rules& rules,
                                 double unit, double delay_s, const std::stop_token& stop) {
    if (footage.beats() == 0 || footage.rushes() == 0) return fail("the match has no players or no time");
    Director director(footage, events, rules, unit);
    const Beat delay = beat_of(delay_s);
    for (Beat now = 0; now < footage.beats(); now += cut_every) {
        if (stop.stop_requested()) return fail("interrupted", ErrorCode::interrupted);
        director.decide(now, std::min(now + delay, footage.beats()));
    }
    return director.finish();
}

std::vector<Shot> direct_for_kills(const Footage& footage, std::span<const Event> events, const Rules& rules,
                                   double unit) {
    Rules kills;
    kills.grammar.minimum_shot_s = rules.grammar.minimum_shot_s;
    kills.grammar.maximum_shot_s = rules.grammar.maximum_shot_s;
    kills.grammar.jump_cosine = rules.grammar.jump_cosine;
    kills.grammar.foresight_s = 0.0;
    kills.grammar.length = kills.grammar.cut = kills.grammar.hidden = kills.grammar.dead = 0.0;
    kills.grammar.idle = kills.grammar.inner_cut = kills.grammar.fresh = 0.0;
    kills.moments = {{.name = "kill",
                      .trigger = Trigger::kill,
                      .before_s = before_kill_s,
                      .after_s = after_kill_s,
                      .worth = 1.0,
                      .whole = true}};
    std::vector<Event> counted;
    std::ranges::copy_if(events, std::back_inserter(counted),
                         [&](const Event& event) { return kill_counts(footage, event.time); });
    const auto moments = find_moments(footage, counted, kills, unit, 0);
    const OnAir nothing{{}, std::vector<Beat>(footage.rushes(), never_shown)};
    return plan_shots(footage, moments, kills, unit, nothing, 0);
}

}  // namespace camdir::direction
