#include "direction/editor.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <numeric>

#include "direction/grammar.hpp"
#include "direction/value.hpp"

namespace camdir::direction {
namespace {

// More than any plan can be worth: what breaks the grammar is chosen only where everything does.
constexpr double never = 1e4;
// A shot is rather for its own player's moments than for what is in the picture beside them.
constexpr double foreign = 0.25;
constexpr double worst = -std::numeric_limits<double>::infinity();

// The best that can follow a decision.
struct Choice {
    double worth = worst;
    Beat end = 0;          // of a shot
    std::size_t rush = 0;  // of a cut
};

Beat first_cut_from(Beat beat) {
    return (beat + cut_every - 1) / cut_every * cut_every;
}

Beat last_cut_before(Beat beat) {
    return (beat - 1) / cut_every * cut_every;
}

// A moment that a rush shows from its begin to its end.
struct WholeMoment {
    Beat begin = 0;
    Beat end = 0;
    double worth = 0.0;
};

// What a shot has shown as a whole when it ends; ends ascend from call to call.
class CreditSum {
  public:
    // Of a shot that began at `begin`; what was over at `from` counts no more. `moments` by their ends.
    CreditSum(std::span<const WholeMoment> moments, Beat begin, Beat from)
        : moments_(moments), begin_(begin), from_(from) {}

    [[nodiscard]] double at(Beat end) {
        for (; next_ < moments_.size() && moments_[next_].end <= end; ++next_)
            if (moments_[next_].begin >= begin_ && moments_[next_].end > from_) sum_ += moments_[next_].worth;
        return sum_;
    }
    // Until there the sum stays what it is.
    [[nodiscard]] Beat next_end() const {
        return next_ < moments_.size() ? moments_[next_].end : std::numeric_limits<Beat>::max();
    }

  private:
    std::span<const WholeMoment> moments_;
    Beat begin_;
    Beat from_;
    std::size_t next_ = 0;
    double sum_ = 0.0;
};

class Plan {
  public:
    Plan(const Footage& footage, std::span<const Moment> moments, const Rules& rules, double unit,
         const OnAir& on_air, Beat now, std::span<const std::size_t> choice)
        : footage_(footage),
          moments_(moments),
          rules_(rules),
          on_air_(on_air),
          now_(now),
          horizon_(std::max(footage.beats(), now) + beat_of(rules.grammar.foresight_s)),
          rushes_(footage.rushes()),
          value_(footage, moments, rules, unit, on_air.last_shown, now, horizon_),
          shots_(static_cast<std::size_t>(horizon_ - now + 1) * rushes_),
          cuts_(shots_.size()),
          after_end_(shots_.size()),
          whole_(rushes_),
          order_(choice.begin(), choice.end()) {
        if (order_.empty()) {
            order_.resize(rushes_);
            std::iota(order_.begin(), order_.end(), std::size_t{0});
        }
        collect_whole_moments();
        const Beat longest = horizon_ - now + beat_of(rules.grammar.maximum_shot_s);
        for (Beat length = 0; length <= longest; ++length)
            length_costs_.push_back(length_cost(rules.grammar, length));
    }

    std::vector<Shot> make() {
        choose_ends(horizon_);
        for (Beat beat = last_cut_before(horizon_); beat >= now_; beat -= cut_every) {
            choose_ends(beat);
            choose_cuts(beat);
        }
        return read_out();
    }

  private:
    // Of each rush, by their ends.
    void collect_whole_moments() {
        for (const Credit& credit : value_.credits())
            for (const std::size_t rush : order_)
                if (credit.until[rush] == credit.end)
                    whole_[rush].push_back({credit.begin, credit.end,
                                            credit.worth + static_cast<double>(credit.worth_both[rush])});
        for (auto& moments : whole_)
            std::ranges::stable_sort(moments, {}, &WholeMoment::end);
    }

    // The beats of a rush lie side by side.
    [[nodiscard]] std::size_t at(Beat beat, std::size_t rush) const {
        return rush * static_cast<std::size_t>(horizon_ - now_ + 1) + static_cast<std::size_t>(beat - now_);
    }

    // Of shots that begin at `begin`.
    void choose_ends(Beat begin) {
        for (const std::size_t rush : order_)
            shots_[at(begin, rush)] =
                begin == horizon_ ? Choice{0.0, horizon_, rush} : best_end(begin, begin, rush);
    }

    // When a shot ends that began at `begin` and is on the air at `from`.
    [[nodiscard]] Choice best_end(Beat begin, Beat from, std::size_t rush) const {
        const Grammar& grammar = rules_.grammar;
        const Beat first = first_cut_from(std::max(from, begin + beat_of(grammar.minimum_shot_s)));
        const Beat last = std::max(first, begin + beat_of(grammar.maximum_shot_s));
        const double past = value_.until(from, rush);
        CreditSum credit(whole_[rush], begin, from);
        Choice best;
        for (Beat end = first; end <= last && end < horizon_;) {
            const double earned = credit.at(end) - past;
            const Beat stretch = std::min({last + 1, horizon_, credit.next_end()});
            for (; end < stretch; end += cut_every) {
                const double worth = after_end_[at(end, rush)] - cost_of_length(end - begin) + earned;
                if (worth > best.worth) best = {worth, end, rush};
            }
        }
        // To the end of the plan: a shot that is not over yet cannot be too short.
        const Beat open_length = std::max(beat_of(grammar.preferred_shot_s), horizon_ - begin);
        double stay = value_.until(horizon_, rush) - past - cost_of_length(open_length) + credit.at(horizon_);
        if (horizon_ - begin > beat_of(grammar.maximum_shot_s)) stay -= never;
        if (stay >= best.worth) best = {stay, horizon_, rush};
        return best;
    }

    [[nodiscard]] double cost_of_length(Beat length) const {
        const auto index = static_cast<std::size_t>(length);
        return index < length_costs_.size() ? length_costs_[index] : length_cost(rules_.grammar, length);
    }

    // Of the shot on each rush that ends at `beat`, which rush is next. The most promising are asked first:
    // the costs of a cut are looked up for few.
    void choose_cuts(Beat beat) {
        const Spanning spanning = spanning_at(beat);
        std::ranges::sort(order_, [&](std::size_t a, std::size_t b) {
            const double one = shots_[at(beat, a)].worth;
            const double other = shots_[at(beat, b)].worth;
            return one != other ? one > other : a < b;
        });
        for (const std::size_t from : order_) {
            Choice& best = cuts_[at(beat, from)];
            best = {worst, beat, from};
            for (const std::size_t to : order_) {
                const double before = shots_[at(beat, to)].worth - rules_.grammar.cut;
                if (before + spanning.worth <= best.worth) break;
                if (to == from) continue;
                const double worth = before - faults(spanning, beat, from, to);
                if (worth > best.worth) best = {worth, beat, to};
            }
            after_end_[at(beat, from)] = value_.until(beat, from) + best.worth;
        }
    }

    // The moments that a cut at a beat divides, and what they are worth together.
    struct Spanning {
        std::vector<const Credit*> credits;
        double worth = 0.0;
    };

    [[nodiscard]] Spanning spanning_at(Beat beat) const {
        Spanning spanning;
        for (const Credit& credit : value_.credits()) {
            if (beat <= credit.begin || beat >= credit.end) continue;
            spanning.credits.push_back(&credit);
            spanning.worth += credit.worth;
        }
        return spanning;
    }

    // What is wrong with a cut, less the divided moments that both shots together show.
    [[nodiscard]] double faults(const Spanning& spanning, Beat beat, std::size_t from, std::size_t to) const {
        double cost = 0.0;
        for (const Credit* credit : spanning.credits) {
            const bool seen = credit->until[from] >= beat && credit->from[to] <= beat;
            if (seen)
                cost -= credit->worth;
            else if (credit->kill && beat <= credit->peak)
                cost += never;
        }
        if (leaves_fragment(footage_, beat, from, to)) cost += rules_.grammar.inner_cut;
        // The first beat that is not known looks like the last that is: a live cut is made there.
        const Beat seen = std::min(beat, footage_.beats() - 1);
        if (seen >= 0 && beat - seen <= 1 &&
            (jump_cut(footage_, rules_.grammar, seen, from, to) || crosses_line(footage_, seen, from, to)))
            cost += never;
        return cost;
    }

    [[nodiscard]] std::vector<Shot> read_out() const {
        std::vector<Shot> shots;
        Choice shot = first_shot();
        Beat begin = shot.rush == current_rush() ? on_air_.shot->begin : now_;
        Beat from = now_;
        std::size_t before = current_rush();
        for (;;) {
            const Reason reason = from == now_ && shot.rush == current_rush()
                                      ? on_air_.shot->reason
                                      : reason_for(before, shot.rush, from, shot.end);
            shots.push_back({shot.rush, begin, shot.end, reason});
            if (shot.end >= horizon_) return shots;
            before = shot.rush;
            const std::size_t next = cuts_[at(shot.end, shot.rush)].rush;
            from = begin = shot.end;
            shot = shots_[at(from, next)];
        }
    }

    [[nodiscard]] std::size_t current_rush() const { return on_air_.shot ? on_air_.shot->rush : rushes_; }

    // Going on with the shot on the air, or cutting at once.
    [[nodiscard]] Choice first_shot() const {
        if (on_air_.shot) {
            const Choice going_on = best_end(on_air_.shot->begin, now_, on_air_.shot->rush);
            if (going_on.end > now_) return going_on;
            return shots_[at(now_, cuts_[at(now_, on_air_.shot->rush)].rush)];
        }
        const std::size_t best = *std::ranges::min_element(order_, [&](std::size_t a, std::size_t b) {
            const double one = shots_[at(now_, a)].worth;
            const double other = shots_[at(now_, b)].worth;
            return one != other ? one > other : a < b;
        });
        return shots_[at(now_, best)];
    }

    [[nodiscard]] Reason reason_for(std::size_t before, std::size_t rush, Beat from, Beat end) const {
        double most = 0.0;
        Reason reason{before < rushes_ ? Reason::Why::length : Reason::Why::opening};
        for (const Moment& moment : moments_) {
            const Index subject = footage_.subject(rush);
            const bool own = moment.actor == subject || moment.subject == subject;
            const double worth = (own ? 1.0 : foreign) * worth_in(moment, rush, from, end);
            if (worth <= most) continue;
            most = worth;
            reason = {Reason::Why::moment, moment.rule, moment.actor, moment.subject};
        }
        const Beat last = std::min(from, footage_.beats()) - 1;
        if (before >= rushes_ || last < footage_.first() || most >= 1.0) return reason;
        const Index subject = footage_.subject(before);
        if (!footage_.player(last, subject).alive) return {Reason::Why::death, 0, subject, nobody};
        if (!footage_.take(last, before).shown[subject]) return {Reason::Why::hidden, 0, subject, nobody};
        return reason;
    }

    [[nodiscard]] double worth_in(const Moment& moment, std::size_t rush, Beat from, Beat end) const {
        const Rule& rule = rules_.moments[moment.rule];
        const Beat first = std::max(from - 1, moment.begin);
        const Beat last = std::min({end, moment.end, footage_.beats()});
        if (last <= first || (rule.whole && (moment.begin < from || moment.end > end))) return 0.0;
        double shown = 0.0;  // beats
        for (Beat beat = first; beat < last; ++beat)
            shown += shows(footage_.take(beat, rush), moment) ? 1.0 : 0.0;
        return rule.worth * shown * (rule.whole ? 1.0 / static_cast<double>(last - first) : beat_s);
    }

    const Footage& footage_;
    std::span<const Moment> moments_;
    const Rules& rules_;
    const OnAir& on_air_;
    Beat now_;
    Beat horizon_;
    std::size_t rushes_;
    Value value_;
    std::vector<Choice> shots_;                    // of a shot that begins at a beat: when it ends
    std::vector<Choice> cuts_;                     // of a shot that ends at a beat: what comes next
    std::vector<double> after_end_;                // what a rush is worth until a beat, and what comes next
    std::vector<std::vector<WholeMoment>> whole_;  // of each rush
    std::vector<std::size_t> order_;               // rushes, the best next one first
    std::vector<double> length_costs_;             // by length
};

}  // namespace

std::vector<Shot> plan_shots(const Footage& footage, std::span<const Moment> moments, const Rules& rules,
                             double unit, const OnAir& on_air, Beat now,
                             std::span<const std::size_t> choice) {
    assert(footage.rushes() > 0 && on_air.last_shown.size() == footage.rushes());
    return Plan(footage, moments, rules, unit, on_air, now, choice).make();
}

std::string_view name_of(const Reason& reason, const Rules& rules) {
    switch (reason.why) {
        case Reason::Why::opening:
            return "opening";
        case Reason::Why::death:
            return "death";
        case Reason::Why::hidden:
            return "lost sight";
        case Reason::Why::length:
            return "length";
        case Reason::Why::moment:
            break;
    }
    return rules.moments[reason.rule].name;
}

}  // namespace camdir::direction
