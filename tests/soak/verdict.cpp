#include "verdict.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <iomanip>
#include <iterator>
#include <numeric>
#include <span>
#include <sstream>

namespace camdir::soak {
namespace {

std::string text(double value, int decimals = 0) {
    std::ostringstream text;
    text << std::fixed << std::setprecision(decimals) << value;
    return text.str();
}

bool overlaps(const Slice& slice, double begin, double end) {
    return slice.end > begin && slice.begin < end;
}

Verdict verdict_of(bool passed) {
    return passed ? Verdict::passed : Verdict::failed;
}

// Whether the leader is expected to leave its matches.
bool removes_leader(const Act& act) {
    return is_done_to_director(act.kind) && act.kind != ActKind::reload && act.director == Role::leader;
}

// Its processes are too many for the machine: what others lose meanwhile is not the directors' doing.
bool is_crowd(const Act& act) {
    return act.kind == ActKind::crowd;
}

class Judge {
  public:
    Judge(const Timeline& timeline, bool sanitized) : timeline_(timeline), sanitized_(sanitized) {}

    [[nodiscard]] std::vector<Check> checks() const {
        std::vector<Check> checks{acts_succeed(), nothing_is_lost(), no_gap_is_long(), cameras_return()};
        checks.push_back(none("cuts without a reason", &Seen::cuts));
        checks.push_back(none("frames older than the one before", &Seen::stale));
        checks.push_back(none("changes of a match's epoch", &Seen::epochs));
        checks.push_back(all_are_answered());
        const auto is_of_crowd = [](const ActRecord& record) { return is_crowd(record.act); };
        if (std::ranges::any_of(timeline_.acts, is_of_crowd)) checks.push_back(crowds_are_served());
        for (const ActKind flood : {ActKind::flood_observers, ActKind::flood_matches})
            judge_floods(flood, checks);
        for (int director = 0; director < timeline_.scenario.directors; ++director)
            judge_lives(director, checks);
        return checks;
    }

    // Whether the machine ran what is measured, in the slice and those beside it.
    [[nodiscard]] bool is_fair(std::size_t slice) const {
        if (during(timeline_.slices[slice], is_crowd, longest_absence_s)) return false;
        const double limit = 0.5 / timeline_.scenario.rate_hz;
        const std::size_t last = std::min(slice + 2, timeline_.slices.size());
        for (std::size_t i = slice - std::min<std::size_t>(slice, 1); i < last; ++i)
            if (timeline_.slices[i].stall_s > limit) return false;
        return true;
    }

  private:
    // Of what a director does too late or with too much memory when sanitizers slow it down.
    [[nodiscard]] Verdict cost_verdict_of(bool passed) const {
        return sanitized_ ? Verdict::not_judged : verdict_of(passed);
    }

    // What one process of a director used: its slices without acts.
    using Life = std::vector<const Slice*>;

    // Whether an act that `concerns` is, or has just been, under way.
    [[nodiscard]] bool during(const Slice& slice, bool (*concerns)(const Act&), double afterwards) const {
        return std::ranges::any_of(timeline_.acts, [&](const ActRecord& record) {
            return concerns(record.act) && overlaps(slice, record.begin, record.end + afterwards);
        });
    }

    [[nodiscard]] Check acts_succeed() const {
        const auto failed =
            std::ranges::find_if(timeline_.acts, [](const ActRecord& act) { return !act.failure.empty(); });
        const bool passed = failed == timeline_.acts.end();
        return {"acts that could not be carried out",
                passed ? "none" : name_of(failed->act.kind) + ": " + failed->failure, "none",
                verdict_of(passed)};
    }

    // A busy machine loses frames without any act as well: so many, twice over, are not the acts' doing.
    [[nodiscard]] Check nothing_is_lost() const {
        const Losses without = losses_where([this](const Slice& slice) { return is_quiet(slice, 0.0); });
        const Losses during =
            losses_where([this](const Slice& slice) { return !is_quiet(slice, 0.0) && keeps_leader(slice); });
        const double rate =
            without.seconds > 0.0 ? static_cast<double>(without.frames) / without.seconds : 0.0;
        const double allowed = std::ceil(2.0 * rate * during.seconds);
        return {"frames lost during acts that leave the leader alone",
                std::to_string(during.frames) + " in " + text(during.seconds) + " s, without acts " +
                    std::to_string(without.frames) + " in " + text(without.seconds) + " s",
                text(allowed), cost_verdict_of(static_cast<double>(during.frames) <= allowed)};
    }
    struct Losses {
        std::uint64_t frames = 0;
        double seconds = 0.0;
    };
    template <class Condition>
    [[nodiscard]] Losses losses_where(const Condition& holds) const {
        Losses losses;
        for (std::size_t i = 0; i < timeline_.slices.size(); ++i) {
            const Slice& slice = timeline_.slices[i];
            if (!is_fair(i) || !holds(slice)) continue;
            losses.frames += slice.seen.lost;
            losses.seconds += slice.end - slice.begin;
        }
        return losses;
    }

    [[nodiscard]] Check all_are_answered() const {
        std::uint64_t count = 0;
        for (const Slice& slice : timeline_.slices)
            if (keeps_leader(slice)) count += slice.seen.unanswered;
        return {"frames without the observer's camera where the leader was left alone", std::to_string(count),
                "0", cost_verdict_of(count == 0)};
    }
    [[nodiscard]] bool keeps_leader(const Slice& slice) const {
        return !during(slice, removes_leader, longest_absence_s);
    }
    [[nodiscard]] bool is_quiet(const Slice& slice, double after_s) const {
        return !during(
            slice, [](const Act&) { return true; }, after_s + longest_absence_s);
    }

    [[nodiscard]] Check no_gap_is_long() const {
        double longest = 0.0;
        for (const Slice& slice : timeline_.slices) {
            const bool alone = timeline_.scenario.directors < 2;
            if (alone && !keeps_leader(slice)) continue;
            if (during(slice, is_crowd, longest_absence_s)) continue;
            longest = std::max(longest, slice.seen.gap_s - slice.stall_s);
        }
        return {"longest gap beside the machine's own, ms", text(1e3 * longest), text(1e3 * longest_gap_s),
                cost_verdict_of(longest <= longest_gap_s)};
    }

    [[nodiscard]] Check cameras_return() const {
        double longest = 0.0;
        for (const ActRecord& act : timeline_.acts)
            longest = std::max(longest, findings_of(act, timeline_).back_s);
        return {"cameras again after an act, s", text(longest, 1), text(longest_absence_s, 1),
                cost_verdict_of(longest <= longest_absence_s)};
    }

    [[nodiscard]] Check crowds_are_served() const {
        double longest = 0.0;
        for (const ActRecord& act : timeline_.acts)
            longest = std::max(longest, act.waited_s);
        return {"wait of the last observer of a crowd for its camera, s", text(longest, 1),
                text(longest_wait_s, 1), cost_verdict_of(longest <= longest_wait_s)};
    }

    // A flood that starves, or is not heard, proves nothing. Of one that was stopped nobody knows.
    void judge_floods(ActKind kind, std::vector<Check>& checks) const {
        double invented = 0.0;
        double answered = 0.0;
        for (const ActRecord& record : timeline_.acts) {
            if (record.act.kind != kind || record.end - record.begin < record.act.for_s) continue;
            invented += static_cast<double>(record.act.count);
            answered += static_cast<double>(record.invented);
        }
        if (invented == 0.0) return;
        const double share = answered / invented;
        checks.push_back({name_of(kind) + ": answered of what was invented, %", text(100.0 * share, 1),
                          "at least " + text(100.0 * least_answered_share),
                          cost_verdict_of(share >= least_answered_share)});
    }

    [[nodiscard]] Check none(const std::string& what, std::uint64_t Seen::*count) const {
        std::string seen;
        for (const Slice& slice : timeline_.slices)
            if (slice.seen.*count > 0)
                seen += (seen.empty() ? "" : ", ") + std::to_string(slice.seen.*count) + " at " +
                        text(slice.begin, 1) + " s";
        return {what, seen.empty() ? "0" : seen, "0", cost_verdict_of(seen.empty())};
    }

    [[nodiscard]] std::vector<Life> lives_of(std::size_t director) const {
        const double settle = timeline_.scenario.settle_s / 2.0;
        std::vector<Life> lives;
        pid_t process = 0;
        double settled = 0.0;
        for (const Slice& slice : timeline_.slices) {
            const auto& usage = slice.directors.at(director);
            if (!usage) continue;
            if (usage->process != process) {
                lives.emplace_back();
                // The first one has settled when the scenario begins.
                const double settling = process == 0 ? 0.0 : settle;
                settled = slice.begin + std::max(settling, timeline_.scenario.warm_up_s);
                process = usage->process;
            }
            if (is_quiet(slice, settle) && slice.begin >= settled) lives.back().push_back(&slice);
        }
        return lives;
    }

    void judge_lives(int director, std::vector<Check>& checks) const {
        const auto place = static_cast<std::size_t>(director);
        const auto count = static_cast<std::size_t>(
            std::ceil(timeline_.scenario.settle_s / 2.0 /
                      (timeline_.slices.front().end - timeline_.slices.front().begin)));
        for (const Life& life : lives_of(place)) {
            if (life.size() < 2 * count) continue;
            judge_life(place, std::span(life).first(count), std::span(life).last(count), checks);
        }
    }

    void judge_life(std::size_t director, std::span<const Slice* const> first,
                    std::span<const Slice* const> last, std::vector<Check>& checks) const {
        const std::string whose = "director " + std::to_string(director) + ", process " +
                                  std::to_string(first.front()->directors.at(director)->process) + ": ";
        const auto level = [&](std::span<const Slice* const> slices, auto value) {
            std::vector<double> values;
            for (const Slice* slice : slices)
                values.push_back(static_cast<double>(std::invoke(value, *slice->directors.at(director))));
            std::ranges::nth_element(values, values.begin() + std::ssize(values) / 2);
            return values[values.size() / 2];
        };
        const auto compare = [&](const std::string& what, auto value, double more, int decimals) -> Check& {
            const double before = level(first, value);
            const double after = level(last, value);
            return checks.emplace_back(
                Check{whose + what, text(before, decimals) + " then " + text(after, decimals),
                      "at most " + text(before + more, decimals), verdict_of(after <= before + more)});
        };
        const double slack = timeline_.scenario.warm_up_s > 0.0 ? 0.0 : slack_mib;
        Check& memory = compare("memory, MiB", &Usage::resident_mib,
                                max_growth * level(first, &Usage::resident_mib) + slack, 1);
        if (sanitized_) memory.verdict = Verdict::not_judged;
        compare("descriptors", &Usage::descriptors, 0.0, 0);
        compare("threads", &Usage::threads, 0.0, 0);
    }

    const Timeline& timeline_;
    const bool sanitized_;
};

}  // namespace

std::string name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::passed:
            return "passed";
        case Verdict::failed:
            return "FAILED";
        case Verdict::not_judged:
            return "not judged";
    }
    return "";
}

bool is_failed(const Check& check) {
    return check.verdict == Verdict::failed;
}

ActFindings findings_of(const ActRecord& act, const Timeline& timeline) {
    ActFindings found;
    bool back = false;
    for (const Slice& slice : timeline.slices) {
        if (overlaps(slice, act.begin, act.end + longest_absence_s)) {
            found.gap_s = std::max(found.gap_s, slice.seen.gap_s);
            found.lost += slice.seen.lost;
        }
        if (slice.end <= act.end || back) continue;
        const double since = slice.end - act.end;
        back = slice.seen.silent_s <= since;
        found.back_s = back ? since - slice.seen.silent_s : since;
    }
    return found;
}

double judged_share(const Timeline& timeline) {
    const Judge judge(timeline, false);
    std::size_t fair = 0;
    for (std::size_t i = 0; i < timeline.slices.size(); ++i)
        fair += judge.is_fair(i) ? 1 : 0;
    return static_cast<double>(fair) / static_cast<double>(std::max<std::size_t>(1, timeline.slices.size()));
}

std::vector<Check> judge(const Timeline& timeline, bool sanitized) {
    return Judge(timeline, sanitized).checks();
}

}  // namespace camdir::soak
