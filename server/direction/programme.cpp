#include "direction/programme.hpp"

#include <algorithm>
#include <iterator>

#include "direction/figures.hpp"

#include "direction/cutter.hpp"

namespace camdir::direction {
namespace {

// Takes what becomes known, and cuts.
class Director {
  public:
    Director(const Footage& all, std::span<const Event> events, const Rules& rules, double unit,
             const MayShow& may_show)
        : all_(all),
          events_(events),
          rules_(rules),
          unit_(unit),
          may_show_(may_show),
          known_(all.players(), all.followed()) {}

    void decide(Beat now, Beat end_of_known) {
        while (known_.footage().beats() < end_of_known) {
            const Beat next = known_.footage().beats();
            known_.append(all_.players_at(next), all_.takes_at(next));
        }
        for (; next_event_ < events_.size() && beat_of(events_[next_event_].time) < end_of_known;
             ++next_event_)
            known_.add(events_[next_event_]);
        known_.forget_before(now);
        const auto begun =
            cutter_.decide(known_, known_.moments(rules_, unit_, now), rules_, unit_, now, choice_at(now));
        if (!begun) return;
        if (!shots_.empty()) shots_.back().end = now;
        shots_.push_back(*begun);
    }

    std::vector<Shot> finish() {
        shots_.back().end = all_.beats();
        return std::move(shots_);
    }

  private:
    [[nodiscard]] std::vector<std::size_t> choice_at(Beat now) const {
        std::vector<std::size_t> choice;
        if (!may_show_) return choice;
        const auto& on_air = cutter_.on_air();
        for (std::size_t rush = 0; rush < all_.rushes(); ++rush)
            if (may_show_(rush, now, on_air && on_air->rush == rush)) choice.push_back(rush);
        return choice;
    }

    const Footage& all_;
    std::span<const Event> events_;
    const Rules& rules_;
    double unit_;
    const MayShow& may_show_;
    Material known_;
    std::size_t next_event_ = 0;
    Cutter cutter_;
    std::vector<Shot> shots_;
};

}  // namespace

Result<std::vector<Shot>> direct(const Footage& footage, std::span<const Event> events, const Rules& rules,
                                 double unit, double delay_s, const std::stop_token& stop,
                                 const MayShow& may_show) {
    if (footage.beats() == 0 || footage.rushes() == 0) return fail("the match has no players or no time");
    Director director(footage, events, rules, unit, may_show);
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
