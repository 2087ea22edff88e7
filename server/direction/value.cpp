#include "direction/value.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "direction/grammar.hpp"

namespace camdir::direction {
namespace {

constexpr Beat recent = 8;                 // beats whose mean is what may go on
constexpr double fixed_half_life_s = 1.0;  // players leave a picture that does not follow them
constexpr double beats_a_minute = 60.0 / beat_s;

}  // namespace

bool shows(const Take& take, const Moment& moment) {
    return (moment.actor != nobody && take.shown[moment.actor]) ||
           (moment.subject != nobody && take.shown[moment.subject]);
}

Value::Value(const Footage& footage, std::span<const Moment> moments, const Rules& rules, double unit,
             std::span<const Beat> last_shown, Beat now, Beat horizon)
    : footage_(footage),
      rules_(rules),
      unit_(unit),
      last_shown_(last_shown),
      now_(now),
      horizon_(horizon),
      known_(std::min(footage.beats(), horizon)),
      first_(std::max(footage.first(), std::min(now, known_ - recent))),
      after_death_(beat_of(rules.grammar.beat_after_death_s)),
      rushes_(footage.rushes()),
      sums_(static_cast<std::size_t>(horizon - first_ + 1) * rushes_, 0.0) {
    rate_beats();
    worth_of_showing_.resize(static_cast<std::size_t>(std::max<Beat>(known_ - first_, 0)) *
                             footage.players());
    for (std::size_t i = 0; i < moments.size(); ++i) {
        const Rule& rule = rules_.moments[moments[i].rule];
        if (rule.whole)
            add_credit(i, moments[i], rule);
        else
            add_span(moments[i], rule);
    }
    add_players();
    fade();
    sum_up();
}

void Value::rate_beats() {
    for (Beat beat = first_; beat < known_; ++beat)
        for (std::size_t rush = 0; rush < rushes_; ++rush)
            rate(beat, rush) = base_rate(beat, rush);
}

double Value::base_rate(Beat beat, std::size_t rush) const {
    const Grammar& grammar = rules_.grammar;
    const Take& take = footage_.take(beat, rush);
    if (take.subject == nobody) return -(grammar.hidden + grammar.dead) * beat_s;
    const PlayerState& state = footage_.player(beat, take.subject);
    const double away = static_cast<double>(now_ - last_shown_[rush]) / beats_a_minute;
    double worth = grammar.fresh * std::min(2.0, away);
    if (!take.shown[take.subject]) worth -= grammar.hidden;
    const Beat before = beat - after_death_;
    if (!state.alive && (before < footage_.first() || !footage_.player(before, take.subject).alive))
        worth -= grammar.dead;
    if (stands_idle(footage_, beat, take.subject, idle_speed * unit_)) worth -= grammar.idle;
    return worth * beat_s;
}

// Players meet many others at a time: what showing each is worth is summed up first, as if it counted for
// each of two; for who shows both it is then set right.
void Value::add_span(const Moment& moment, const Rule& rule) {
    const double one = rule.worth * beat_s;
    const double both = rule.worth_both * beat_s - one;
    const std::size_t words = footage_.words();
    for (Beat beat = std::max(moment.begin, first_); beat < std::min(moment.end, known_); ++beat) {
        for (const Index player : {moment.actor, moment.subject})
            if (player != nobody) worth_of_showing(beat, player) += one;
        if (both == 0.0 || moment.actor == nobody || moment.subject == nobody) continue;
        const auto actor = footage_.showing(beat, moment.actor);
        const auto subject = footage_.showing(beat, moment.subject);
        for (std::size_t word = 0; word < words; ++word)
            if (const Footage::Word showing_both = actor[word] & subject[word]; showing_both != 0)
                add_to_rushes(beat, word, showing_both, both);
    }
}

void Value::add_players() {
    for (Beat beat = first_; beat < known_; ++beat)
        for (Index player = 0; player < footage_.players(); ++player) {
            const double worth = worth_of_showing(beat, player);
            if (worth == 0.0) continue;
            const auto showing = footage_.showing(beat, player);
            for (std::size_t word = 0; word < showing.size(); ++word)
                add_to_rushes(beat, word, showing[word], worth);
        }
}

// Of this word of all rushes' bits.
void Value::add_to_rushes(Beat beat, std::size_t word, Footage::Word rushes, double worth) {
    double* const rates = &rate(beat, word * Footage::word_bits);
    for (; rushes != 0; rushes &= rushes - 1)
        rates[std::countr_zero(rushes)] += worth;
}

void Value::add_credit(std::size_t index, const Moment& moment, const Rule& rule) {
    if (moment.end <= now_) return;
    Credit credit{index,       moment.begin, std::min(moment.end, known_),
                  moment.peak, rule.worth,   rule.trigger == Trigger::kill,
                  {},          {},           {}};
    if (credit.end <= credit.begin) return;
    credit.until.assign(rushes_, credit.end);
    credit.from.assign(rushes_, credit.begin);
    credit.worth_both.assign(rushes_, 0.0F);
    for (std::size_t word = 0; word < footage_.words(); ++word)
        look_through(moment, word, rule.worth_both, credit);
    credits_.push_back(std::move(credit));
}

// What the rushes of one word show of the moment.
void Value::look_through(const Moment& moment, std::size_t word, double worth_both, Credit& credit) const {
    using Word = Footage::Word;
    const std::size_t first = word * Footage::word_bits;
    const std::size_t count = std::min(rushes_ - first, Footage::word_bits);
    const Word all = ~Word{0} >> (Footage::word_bits - count);
    const auto for_each = [&](Word rushes, const auto& change) {
        for (; rushes != 0; rushes &= rushes - 1)
            change(first + static_cast<std::size_t>(std::countr_zero(rushes)));
    };
    const auto showing = [&](Beat beat, Index player) { return footage_.showing(beat, player)[word]; };
    Word still = all;
    Word both = worth_both > 0.0 ? all : 0;
    for (Beat beat = credit.begin; beat < credit.end && still != 0; ++beat) {
        const Word actor = showing(beat, moment.actor);
        const Word subject = showing(beat, moment.subject);
        for_each(still & ~(actor | subject), [&](std::size_t rush) { credit.until[rush] = beat; });
        still &= actor | subject;
        both &= actor & subject;
    }
    for_each(both & still,
             [&](std::size_t rush) { credit.worth_both[rush] = static_cast<float>(worth_both); });
    still = all;
    for (Beat beat = credit.end; beat > credit.begin && still != 0; --beat) {
        const Word shown = showing(beat - 1, moment.actor) | showing(beat - 1, moment.subject);
        for_each(still & ~shown, [&](std::size_t rush) { credit.from[rush] = beat; });
        still &= shown;
    }
}

void Value::fade() {
    const Beat source = std::max(first_, known_ - recent);
    std::vector<double> means(rushes_, 0.0);
    for (std::size_t rush = 0; rush < rushes_; ++rush)
        for (Beat beat = source; beat < known_; ++beat)
            means[rush] += rate(beat, rush) / static_cast<double>(known_ - source);
    for (Beat beat = std::max(known_, first_); beat < horizon_; ++beat) {
        const double age = static_cast<double>(beat - known_ + 1) * beat_s;
        const double left = std::exp2(-age / rules_.grammar.half_life_s);
        const double left_of_fixed = std::exp2(-age / fixed_half_life_s);
        for (std::size_t rush = 0; rush < rushes_; ++rush)
            rate(beat, rush) = means[rush] * (footage_.is_fixed(rush) ? left_of_fixed : left);
    }
}

void Value::sum_up() {
    for (std::size_t i = rushes_; i < sums_.size(); ++i)
        sums_[i] += sums_[i - rushes_];
}

}  // namespace camdir::direction
