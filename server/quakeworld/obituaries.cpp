#include "quakeworld/obituaries.hpp"

#include <algorithm>

namespace camdir::quakeworld {
namespace {

constexpr char victim = '<';
constexpr char killer = '>';
constexpr char word = '*';

struct Phrase {
    std::string_view cause;
    std::string_view text;  // <: the victim's name, >: the killer's, *: a word
};

// Those of the original game and of KTX.
constexpr Phrase phrases[] = {
    {"rl", "< rides >'s rocket"},
    {"rl", "< was gibbed by >'s rocket"},
    {"rl", "< was brutalized by >'s quad rocket"},
    {"rl", "< was smeared by >'s quad rocket"},
    {"rl", "> rips < a new one"},
    {"gl", "< eats >'s pineapple"},
    {"gl", "< was gibbed by >'s grenade"},
    {"lg", "< accepts >'s shaft"},
    {"lg", "< gets a natural disaster from >"},
    {"lg", "< accepts >'s discharge"},
    {"lg", "< drains >'s batteries"},
    {"sg", "< chewed on >'s boomstick"},
    {"sg", "< was lead poisoned by >"},
    {"ssg", "< ate 2 loads of >'s buckshot"},
    {"ssg", "< ate 8 loads of >'s buckshot"},
    {"ng", "< was nailed by >"},
    {"ng", "< was body pierced by >"},
    {"sng", "< was punctured by >"},
    {"sng", "< was perforated by >"},
    {"sng", "< was ventilated by >"},
    {"sng", "< was straw-cuttered by >"},
    {"axe", "< was ax-murdered by >"},
    {"tele", "< was telefragged by >'s Satan's power"},
    {"tele", "< was telefragged by >"},
    {"stomp", "< softens >'s fall"},
    {"stomp", "< tried to catch >"},
    {"stomp", "< was jumped by >"},
    {"stomp", "< was crushed by >"},
    {"stomp", "> stomps <"},
    {"stomp", "> squishes <"},
    {"team", "< was telefragged by * teammate"},
    {"team", "< was jumped by * teammate"},
    {"team", "< was crushed by * teammate"},
    {"team", "> mows down a teammate"},
    {"team", "> squished a teammate"},
    {"team", "> checks * glasses"},
    {"team", "> loses another friend"},
    {"team", "> gets a frag for the other team"},
    {"self", "< tries to put the pin back in"},
    {"self", "< discovers blast radius"},
    {"self", "< becomes bored with life"},
    {"self", "< somehow becomes bored with life"},
    {"self", "< electrocutes *"},
    {"self", "< discharges into the *"},
    {"self", "< heats up the water"},
    {"self", "< suicides"},
    {"self", "Satan's power deflects <'s telefrag"},
    {"fall", "< cratered"},
    {"fall", "< fell to * death"},
    {"liquid", "< sleeps with the fishes"},
    {"liquid", "< sucks it down"},
    {"liquid", "< gulped a load of slime"},
    {"liquid", "< can't exist on slime alone"},
    {"liquid", "< turned into hot slag"},
    {"liquid", "< visits the Volcano God"},
    {"liquid", "< burst into flames"},
    {"world", "< was squished"},
    {"world", "< was spiked"},
    {"world", "< was zapped"},
    {"world", "< blew up"},
    {"world", "< ate a lavaball"},
    {"world", "< tried to leave"},
    {"world", "< died"},
};

class Matcher {
  public:
    explicit Matcher(std::span<const std::string> names) : names_(names) {}

    std::optional<Obituary> match(const Phrase& phrase, std::string_view line) {
        found_ = {phrase.cause, {}, {}};
        return fits(phrase.text, line) ? std::optional(found_) : std::nullopt;
    }

  private:
    bool fits(std::string_view text, std::string_view line) {
        while (!text.empty()) {
            const char sign = text.front();
            text.remove_prefix(1);
            if (sign == victim) return names_a_player(text, line, found_.victim);
            if (sign == killer) return names_a_player(text, line, found_.killer);
            if (sign == word) {
                line.remove_prefix(std::min(line.find(' '), line.size()));
                continue;
            }
            if (line.empty() || line.front() != sign) return false;
            line.remove_prefix(1);
        }
        return line.empty();
    }

    // A name may begin with another one, so each is tried.
    bool names_a_player(std::string_view text, std::string_view line, std::optional<std::size_t>& player) {
        for (std::size_t i = 0; i < names_.size(); ++i) {
            if (names_[i].empty() || !line.starts_with(names_[i])) continue;
            player = i;
            if (fits(text, line.substr(names_[i].size()))) return true;
        }
        return false;
    }

    std::span<const std::string> names_;
    Obituary found_;
};

}  // namespace

std::optional<Obituary> obituary_of(std::string_view line, std::span<const std::string> names) {
    Matcher matcher(names);
    for (const Phrase& phrase : phrases)
        if (const auto obituary = matcher.match(phrase, line)) return obituary;
    return std::nullopt;
}

}  // namespace camdir::quakeworld
