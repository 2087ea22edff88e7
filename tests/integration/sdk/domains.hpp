// DDS domains of these tests. Ports of domains below 100 lie below those that the system gives out itself.
#pragma once

#include <cstdint>

namespace camdir::test {

// Cases that talk within their process share this one, each with a match of its own.
inline constexpr std::uint32_t shared_domain = 84;
// Cases that need a director's well-known port take the first free of these.
inline constexpr std::uint32_t first_director_domain = 85;
inline constexpr std::uint32_t last_director_domain = 99;

}  // namespace camdir::test
