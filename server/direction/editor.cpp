#include "direction/editor.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <limits>
#include <utility>

#include "direction/grammar.hpp"
#include "direction/value.hpp"

namespace camdir::direction {
namespace {

// A shot is rather for its own player's moments than for what is in the picture beside them.
constexpr double foreign = 0.25;
constexpr double worst = -std::numeric_limits<double>::infinity();

// The best that can follow a decision.
struct Choice {
    double worth = worst;
    std::uint32_t end = 0;   // of a shot: beats after now
    std::uint32_t rush = 0;  // of a cut
};

Beat first_cut_from(Beat beat) {
    return (beat + cut_every - 1) / cut_every * cut_every;
}

Beat last_cut_before(Beat beat) {
    return (beat - 1) / cut_every * cut_every;
}

// Of a[i] - b[i]. In lanes: one comparison would wait for the other.
double greatest_difference(const double* a, const double* b, std::size_t count) {
    constexpr std::size_t lanes = 4;
    std::array<double, lanes> greatest;
    greatest.fill(worst);
    std::size_t i = 0;
    for (; i + lanes <= count; i += lanes)
        for (std::size_t lane = 0; lane < lanes; ++lane)
            greatest[lane] = std::max(greatest[lane], a[i + lane] - b[i + lane]);
    for (; i < count; ++i)
        greatest[0] = std::max(greatest[0], a[i] - b[i]);
    return std::ranges::max(greatest);
}

// The first that is `difference`, which there is.
std::size_t place_of_difference(const double* a, const double* b, double difference) {
    std::size_t i = 0;
    while (a[i] - b[i] != difference)
        ++i;
    return i;
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
          slots_(static_cast<std::size_t>(horizon_ - now + 1) / cut_every + 1),
          shortest_(beat_of(rules.grammar.minimum_shot_s)),
          longest_(beat_of(std::max(rules.grammar.minimum_shot_s, rules.grammar.maximum_shot_s))),
          preferred_(beat_of(rules.grammar.preferred_shot_s)),
          lengths_((horizon_ - now + longest_) / cut_every + 1),
          value_(footage, moments, rules, unit, on_air.last_shown, now, horizon_),
          shots_(slots_ * rushes_),
          cuts_(shots_.size()),
          after_end_(shots_.size()),
          whole_(rushes_),
          jumped_(rushes_),
          jumps_(rushes_) {
        choose_from(choice);
        collect_whole_moments();
        length_costs_.resize(static_cast<std::size_t>(lengths_ * cut_every));
        for (Beat length = 0; length < lengths_ * cut_every; ++length)
            length_costs_[place_of_length(length)] = length_cost(rules.grammar, length);
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
    // What has no picture from now on is left out.
    void choose_from(std::span<const std::size_t> choice) {
        const auto consider = [&](std::size_t rush) {
            if (rush == current_rush() || ever_to_be_had(rush)) choice_.push_back(rush);
        };
        if (choice.empty())
            for (std::size_t rush = 0; rush < rushes_; ++rush)
                consider(rush);
        else
            std::ranges::for_each(choice, consider);
    }

    [[nodiscard]] bool ever_to_be_had(std::size_t rush) const {
        if (!footage_.is_fixed(rush)) return true;
        for (Beat beat = std::max(footage_.first(), std::min(now_, footage_.beats() - 1));
             beat < footage_.beats(); ++beat)
            if (footage_.take(beat, rush).subject != nobody) return true;
        return false;
    }

    // In the first beat of a shot, or the last that is known before it.
    [[nodiscard]] bool to_be_had(Beat beat, std::size_t rush) const {
        const Beat seen = std::min(beat, footage_.beats() - 1);
        return !footage_.is_fixed(rush) ||
               (seen >= footage_.first() && footage_.take(seen, rush).subject != nobody);
    }

    // Of each rush, by their ends.
    void collect_whole_moments() {
        for (const Credit& credit : value_.credits())
            for (const std::size_t rush : choice_)
                if (credit.until[rush] == credit.end)
                    whole_[rush].push_back({credit.begin, credit.end,
                                            credit.worth + static_cast<double>(credit.worth_both[rush])});
        for (auto& moments : whole_)
            std::ranges::stable_sort(moments, {}, &WholeMoment::end);
    }

    // Of the beats that may have a cut, and of the horizon. Those of a rush lie side by side.
    [[nodiscard]] std::size_t at(Beat beat, std::size_t rush) const {
        return rush * slots_ + static_cast<std::size_t>(beat - now_ + cut_every - 1) / cut_every;
    }

    [[nodiscard]] Choice ending(double worth, Beat end, std::size_t rush) const {
        return {worth, static_cast<std::uint32_t>(end - now_), static_cast<std::uint32_t>(rush)};
    }

    // Of shots that begin at `begin`.
    void choose_ends(Beat begin) {
        for (const std::size_t rush : choice_)
            if (begin == horizon_)
                shots_[at(begin, rush)] = ending(0.0, horizon_, rush);
            else if (to_be_had(begin, rush))
                shots_[at(begin, rush)] = best_end(begin, begin, rush);
    }

    // What its camera's jumps divide a shot into; ends of the shot ascend from call to call. A jump in the
    // beat where it begins is no other cut than that, or one that was paid for there if it was known.
    class Pieces {
      public:
        Pieces(const Plan& plan, std::size_t rush, Beat begin)
            : plan_(plan),
              jumps_(plan.footage_.jumps(rush)),
              next_(std::ranges::upper_bound(jumps_, begin)),
              first_(next_),
              begin_(begin) {}

        void advance(Beat end) {
            for (; next_ != jumps_.end() && *next_ < end; ++next_) {
                const Beat length = *next_ - std::exchange(begin_, *next_);
                const bool too_short = next_ != first_ && length < shortest_piece;
                cost_ += plan_.cost_of_length(length) + (too_short ? never : plan_.rules_.grammar.inner_cut);
            }
        }
        // Of those that end before that, and of the jumps between.
        [[nodiscard]] double cost() const { return cost_; }
        // Of the one in which that lies, and the last beat at which the shot may end in it.
        [[nodiscard]] Beat begin() const { return begin_; }
        [[nodiscard]] Beat last_end() const {
            return next_ != jumps_.end() ? *next_ : std::numeric_limits<Beat>::max() - 1;
        }

      private:
        const Plan& plan_;
        const std::vector<Beat>& jumps_;
        std::vector<Beat>::const_iterator next_, first_;
        Beat begin_;
        double cost_ = 0.0;
    };

    // When a shot ends that began at `begin` and is on the air at `from`.
    [[nodiscard]] Choice best_end(Beat begin, Beat from, std::size_t rush) const {
        const Beat first = first_cut_from(std::max(from, begin + shortest_));
        const Beat last = std::max(first, begin + longest_);
        const double past = value_.until(from, rush);
        CreditSum credit(whole_[rush], begin, from);
        Pieces pieces(*this, rush, begin);
        double most = worst;
        Beat best = horizon_;
        const double* after = after_end_.data();
        if (first < horizon_) {
            pieces.advance(first);
            after += at(first, rush);
            most =
                *after++ - pieces.cost() - cost_of_length(first - pieces.begin()) + (credit.at(first) - past);
            best = first;
        }
        for (Beat end = first + cut_every; end <= last && end < horizon_;) {
            pieces.advance(end);
            const double earned = credit.at(end) - past - pieces.cost();
            const Beat stretch = std::min({last + 1, horizon_, credit.next_end(), pieces.last_end() + 1});
            const auto count = static_cast<std::size_t>((stretch - end + cut_every - 1) / cut_every);
            const double* costs = length_costs_.data() + place_of_length(end - pieces.begin());
            const double greatest = greatest_difference(after, costs, count);
            if (greatest + earned > most) {
                most = greatest + earned;
                best = end + cut_every * static_cast<Beat>(place_of_difference(after, costs, greatest));
            }
            after += count;
            end += cut_every * static_cast<Beat>(count);
        }
        // To the end of the plan: a piece that is not over yet cannot be too short.
        pieces.advance(horizon_);
        const Beat open_length = std::max(preferred_, horizon_ - pieces.begin());
        double stay = value_.until(horizon_, rush) - past - pieces.cost() - cost_of_length(open_length) +
                      credit.at(horizon_);
        if (horizon_ - begin > longest_) stay -= never;
        return stay >= most ? ending(stay, horizon_, rush) : ending(most, best, rush);
    }

    // Lengths with the same remainder by cut_every lie side by side, as those of a shot's ends do.
    [[nodiscard]] std::size_t place_of_length(Beat length) const {
        return static_cast<std::size_t>(length % cut_every * lengths_ + length / cut_every);
    }

    [[nodiscard]] double cost_of_length(Beat length) const {
        return length < lengths_ * cut_every ? length_costs_[place_of_length(length)]
                                             : length_cost(rules_.grammar, length);
    }

    // Of the shot on each rush that ends at `beat`, which rush is next. The most promising are asked first:
    // the costs of a cut are looked up for few.
    void choose_cuts(Beat beat) {
        span_at(beat);
        promising_.clear();
        for (const std::size_t rush : choice_) {
            jumped_[rush] = jumped_just_before(footage_, beat, rush);
            jumps_[rush] = jumps_soon_after(footage_, beat, rush);
            if (const double worth = shots_[at(beat, rush)].worth; worth > worst)
                promising_.push_back({worth - rules_.grammar.cut, rush});
        }
        std::ranges::sort(promising_, [](const Promise& a, const Promise& b) {
            return a.worth != b.worth ? a.worth > b.worth : a.rush < b.rush;
        });
        for (const std::size_t from : choice_) {
            Choice& best = cuts_[at(beat, from)];
            best = ending(worst, beat, from);
            const double least = least_cost_of_dividing(from);
            for (const auto& [before, to] : promising_) {
                if (before - least <= best.worth) break;
                if (to == from) continue;
                double worth = before - cost_of_dividing(from, to);
                if (jumped_[from] || jumps_[to]) worth -= never;
                if (worth <= best.worth) continue;  // looking at the pictures takes longest
                if (breaks_continuity(beat, from, to)) worth -= never;
                if (worth > best.worth) best = ending(worth, beat, to);
            }
            after_end_[at(beat, from)] = value_.until(beat, from) + best.worth;
        }
    }

    // The moments that a cut at a beat divides. Moment m has bit m % 64 of word m / 64, of each rush: set in
    // `until` where the rush shows it up to the cut, in `from` where it shows it from there on. The first
    // words of all rushes come first.
    struct Spanning {
        std::vector<const Credit*> credits;
        std::vector<double> worths;  // of showing them, the cut notwithstanding
        std::vector<Footage::Word> until, from;
        std::vector<Footage::Word> coming_kills;
    };

    void span_at(Beat beat) {
        Spanning& spanning = spanning_;
        spanning.credits.clear();
        spanning.worths.clear();
        for (const Credit& credit : value_.credits()) {
            if (beat <= credit.begin || beat >= credit.end) continue;
            spanning.credits.push_back(&credit);
            // It counts once: no other cut may divide it.
            const bool is_divided_once = beat - credit.begin <= shortest_ && credit.end - beat <= shortest_;
            spanning.worths.push_back(is_divided_once ? credit.worth : 0.0);
        }
        const std::size_t words = (spanning.credits.size() + Footage::word_bits - 1) / Footage::word_bits;
        spanning.until.assign(words * rushes_, 0);
        spanning.from.assign(words * rushes_, 0);
        spanning.coming_kills.assign(words, 0);
        for (std::size_t i = 0; i < spanning.credits.size(); ++i) {
            const Credit& credit = *spanning.credits[i];
            const std::size_t word = i / Footage::word_bits;
            const Footage::Word bit = Footage::Word{1} << i % Footage::word_bits;
            if (credit.kill && beat <= credit.peak) spanning.coming_kills[word] |= bit;
            for (const std::size_t rush : choice_) {
                if (credit.until[rush] >= beat) spanning.until[word * rushes_ + rush] |= bit;
                if (credit.from[rush] <= beat) spanning.from[word * rushes_ + rush] |= bit;
            }
        }
    }

    // Less the divided moments that both shots together show.
    [[nodiscard]] double cost_of_dividing(std::size_t from, std::size_t to) const {
        double cost = 0.0;
        for (std::size_t word = 0; word < spanning_.coming_kills.size(); ++word)
            cost += cost_of_showing(
                word, spanning_.until[word * rushes_ + from] & spanning_.from[word * rushes_ + to]);
        return cost;
    }

    // Whatever follows.
    [[nodiscard]] double least_cost_of_dividing(std::size_t from) const {
        double cost = 0.0;
        for (std::size_t word = 0; word < spanning_.coming_kills.size(); ++word)
            cost += cost_of_showing(word, spanning_.until[word * rushes_ + from]);
        return cost;
    }

    // Of a word's moments these, and not the others.
    [[nodiscard]] double cost_of_showing(std::size_t word, Footage::Word seen) const {
        const Footage::Word missed = spanning_.coming_kills[word] & ~seen;
        double cost = missed == 0 ? 0.0 : never * std::popcount(missed);
        for (; seen != 0; seen &= seen - 1) {
            const auto bit = static_cast<std::size_t>(std::countr_zero(seen));
            cost -= spanning_.worths[word * Footage::word_bits + bit];
        }
        return cost;
    }

    // The first beat that is not known looks like the last that is: a live cut is made there.
    [[nodiscard]] bool breaks_continuity(Beat beat, std::size_t from, std::size_t to) const {
        const Grammar& grammar = rules_.grammar;
        if (beat < footage_.beats())
            return may_be_jump_cut(footage_, grammar, beat, from, to) ||
                   may_cross_line(footage_, beat, from, to);
        const Beat seen = footage_.beats() - 1;
        return seen >= 0 && beat == seen + 1 &&
               (jump_cut(footage_, grammar, seen, from, to) || crosses_line(footage_, seen, from, to));
    }

    [[nodiscard]] std::vector<Shot> read_out() const {
        std::vector<Shot> shots;
        Choice shot = first_shot();
        Beat begin = shot.rush == current_rush() ? on_air_.shot->begin : now_;
        Beat from = now_;
        std::size_t before = current_rush();
        for (;;) {
            const Beat end = now_ + static_cast<Beat>(shot.end);
            const Reason reason = from == now_ && shot.rush == current_rush()
                                      ? on_air_.shot->reason
                                      : reason_for(before, shot.rush, from, end);
            shots.push_back({shot.rush, begin, end, reason});
            if (end >= horizon_) return shots;
            before = shot.rush;
            const std::size_t next = cuts_[at(end, shot.rush)].rush;
            from = begin = end;
            shot = shots_[at(from, next)];
        }
    }

    [[nodiscard]] std::size_t current_rush() const { return on_air_.shot ? on_air_.shot->rush : rushes_; }

    // Going on with the shot on the air, or cutting at once.
    [[nodiscard]] Choice first_shot() const {
        if (on_air_.shot) {
            const Choice going_on = best_end(on_air_.shot->begin, now_, on_air_.shot->rush);
            if (going_on.end > 0) return going_on;
            return shots_[at(now_, cuts_[at(now_, on_air_.shot->rush)].rush)];
        }
        const std::size_t best = *std::ranges::min_element(choice_, [&](std::size_t a, std::size_t b) {
            const double one = shots_[at(now_, a)].worth;
            const double other = shots_[at(now_, b)].worth;
            return one != other ? one > other : a < b;
        });
        return shots_[at(now_, best)];
    }

    [[nodiscard]] Reason reason_for(std::size_t before, std::size_t rush, Beat from, Beat end) const {
        double most = 0.0;
        const Beat seen = std::min(from, footage_.beats() - 1);
        const Index subject = seen >= footage_.first() ? footage_.take(seen, rush).subject : nobody;
        Reason reason{before < rushes_ ? Reason::Why::length : Reason::Why::opening};
        for (const Moment& moment : moments_) {
            const bool own = subject != nobody && (moment.actor == subject || moment.subject == subject);
            const double worth = (own ? 1.0 : foreign) * worth_in(moment, rush, from, end);
            if (worth <= most) continue;
            most = worth;
            reason = {Reason::Why::moment, moment.rule, moment.actor, moment.subject};
        }
        const Beat last = std::min(from, footage_.beats()) - 1;
        if (before >= rushes_ || last < footage_.first() || most >= 1.0) return reason;
        const Index lost = footage_.take(last, before).subject;
        if (lost == nobody) return reason;
        if (!footage_.player(last, lost).alive) return {Reason::Why::death, 0, lost, nobody};
        if (!footage_.take(last, before).shown[lost]) return {Reason::Why::hidden, 0, lost, nobody};
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
    std::size_t slots_;
    Beat shortest_, longest_;  // shots
    Beat preferred_;           // pieces
    Beat lengths_;             // in the table, of each remainder
    Value value_;
    std::vector<Choice> shots_;                    // of a shot that begins at a beat: when it ends
    std::vector<Choice> cuts_;                     // of a shot that ends at a beat: what comes next
    std::vector<double> after_end_;                // what a rush is worth until a beat, and what comes next
    std::vector<std::vector<WholeMoment>> whole_;  // of each rush
    std::vector<std::size_t> choice_;              // the rushes
    struct Promise {
        double worth;
        std::size_t rush;
    };
    Spanning spanning_;                 // of a beat
    std::vector<char> jumped_, jumps_;  // of each rush at a beat: a camera's jump is too near to a cut
    std::vector<Promise> promising_;    // at a beat, the best next one first
    std::vector<double> length_costs_;  // by place_of_length()
};

// Empty of a moment.
std::string_view name_without_moment(Reason::Why why) {
    switch (why) {
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
    return {};
}

}  // namespace

std::vector<Shot> plan_shots(const Footage& footage, std::span<const Moment> moments, const Rules& rules,
                             double unit, const OnAir& on_air, Beat now,
                             std::span<const std::size_t> choice) {
    assert(footage.rushes() > 0 && on_air.last_shown.size() == footage.rushes());
    return Plan(footage, moments, rules, unit, on_air, now, choice).make();
}

std::string_view name_of(const Reason& reason, const Rules& rules) {
    return reason.why == Reason::Why::moment ? rules.moments[reason.rule].name
                                             : name_without_moment(reason.why);
}

bool is_reason_without_moment(std::string_view name) {
    using Why = Reason::Why;
    constexpr std::array whys = {Why::opening, Why::death, Why::hidden, Why::length};
    return std::ranges::find(whys, name, name_without_moment) != whys.end();
}

}  // namespace camdir::direction
