extern "C" {
#include "settings.h"

#include "engine.h"
}

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <limits>
#include <string>

namespace camdir::halflife {
namespace {

std::array<cvar*, 16> registered;
std::size_t registered_count;

void register_cvar(cvar* each) {
    registered.at(registered_count++) = each;
}

cvar* find_cvar(const char* name) {
    for (std::size_t i = 0; i < registered_count; ++i)
        if (std::string(registered.at(i)->name) == name) return registered.at(i);
    return nullptr;
}

class HalfLifeSettings : public testing::Test {
  protected:
    HalfLifeSettings() {
        std::array<engine_function, engine_call_count> table{};
        table[call_register_cvar] = reinterpret_cast<engine_function>(register_cvar);
        table[call_find_cvar] = reinterpret_cast<engine_function>(find_cvar);
        static const engine_globals globals{};
        engine_connect(table.data(), &globals);
        registered_count = 0;
        settings_register();
        for (const char* name : {"director_match", "director_directors"})
            set(name, "");
        set("director_domain", "0");
        set("director_max_rate", "100");
    }

    static match_settings read_with(const char* name, const std::string& value) {
        set(name, value.c_str());
        return settings_read();
    }

  private:
    static void set(const char* name, const char* value) {
        find_cvar(name)->text = value;
        find_cvar(name)->value = std::strtof(value, nullptr);
    }
};

TEST_F(HalfLifeSettings, ADomainThatIsNoneIsNotAnotherOne) {
    EXPECT_EQ(read_with("director_domain", "230").domain, 230U);
    for (const char* text : {"231", "", "-1", "abc", "1.5"}) {
        const match_settings read = read_with("director_domain", text);
        EXPECT_EQ(read.domain, std::numeric_limits<std::uint32_t>::max()) << text;
        EXPECT_EQ(read.error, "director_domain '" + std::string(text) + "': expected a number from 0 to 230");
    }
}

TEST_F(HalfLifeSettings, AValueThatDoesNotFitIsAnError) {
    const std::string longest(63, 'm'), too_long(64, 'm');
    EXPECT_STREQ(read_with("director_match", longest).error, "");
    EXPECT_STREQ(read_with("director_match", too_long).error, "director_match is longer than 63 bytes");
}

TEST_F(HalfLifeSettings, ARateOutOfRangeIsAnError) {
    EXPECT_STREQ(read_with("director_max_rate", "1000").error, "");
    for (const char* text : {"0", "-5", "1001", "nan", "fast"})
        EXPECT_STREQ(read_with("director_max_rate", text).error, "director_max_rate must be 1 to 1000")
            << text;
}

}  // namespace
}  // namespace camdir::halflife
