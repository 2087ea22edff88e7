// Four floats that are computed side by side. Every operation rounds as the scalar one does. Needs the vector
// extensions of GCC or Clang; SSE2 is used where it is there.
#pragma once

#include <cmath>
#include <cstdint>
#include <cstring>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace camdir {

inline constexpr int lane_count = 4;
using Float4 = float __attribute__((vector_size(16)));
using Mask4 = std::int32_t __attribute__((vector_size(16)));  // all bits of a lane set, or none

inline Float4 broadcast(float value) {
    return Float4{value, value, value, value};
}

inline Float4 load(const float* values) {
    Float4 loaded;
    std::memcpy(&loaded, values, sizeof loaded);
    return loaded;
}

inline void store(Float4 values, float* to) {
    std::memcpy(to, &values, sizeof values);
}

inline Float4 square_root(Float4 x) {
#if defined(__SSE2__)
    return reinterpret_cast<Float4>(_mm_sqrt_ps(reinterpret_cast<__m128>(x)));
#else
    return Float4{std::sqrt(x[0]), std::sqrt(x[1]), std::sqrt(x[2]), std::sqrt(x[3])};
#endif
}

// Where one of the two is NaN, the second is taken.
inline Float4 smaller(Float4 a, Float4 b) {
#if defined(__SSE2__)
    return reinterpret_cast<Float4>(_mm_min_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
#else
    return a < b ? a : b;
#endif
}
inline Float4 larger(Float4 a, Float4 b) {
#if defined(__SSE2__)
    return reinterpret_cast<Float4>(_mm_max_ps(reinterpret_cast<__m128>(a), reinterpret_cast<__m128>(b)));
#else
    return a > b ? a : b;
#endif
}

// Bit k is set if lane k is.
inline unsigned bits(Mask4 mask) {
#if defined(__SSE2__)
    return static_cast<unsigned>(_mm_movemask_ps(reinterpret_cast<__m128>(mask)));
#else
    return (mask[0] & 1) | (mask[1] & 2) | (mask[2] & 4) | (mask[3] & 8);
#endif
}

// The largest of the four.
inline float largest(Float4 x) {
    const Float4 pairs = larger(x, __builtin_shufflevector(x, x, 2, 3, 0, 1));
    return larger(pairs, __builtin_shufflevector(pairs, pairs, 1, 0, 3, 2))[0];
}

// Converts four rows of four std::int8_t at `rows`, which need not be aligned.
inline void convert(const void* rows, Float4 (&converted)[4]) {
#if defined(__SSE2__)
    const __m128i bytes = _mm_loadu_si128(static_cast<const __m128i*>(rows));
    // Every number to the top of a lane, from where it is shifted down with its sign.
    const __m128i low = _mm_unpacklo_epi8(bytes, bytes);
    const __m128i high = _mm_unpackhi_epi8(bytes, bytes);
    const auto floats = [](__m128i tops) {
        return reinterpret_cast<Float4>(_mm_cvtepi32_ps(_mm_srai_epi32(tops, 24)));
    };
    converted[0] = floats(_mm_unpacklo_epi16(low, low));
    converted[1] = floats(_mm_unpackhi_epi16(low, low));
    converted[2] = floats(_mm_unpacklo_epi16(high, high));
    converted[3] = floats(_mm_unpackhi_epi16(high, high));
#else
    std::int8_t numbers[4][lane_count];
    std::memcpy(numbers, rows, sizeof numbers);
    for (int row = 0; row < 4; ++row)
        for (int k = 0; k < lane_count; ++k)
            converted[row][k] = numbers[row][k];
#endif
}

// Transposes the 4 x 4 matrix of rows a, b, c, d in place.
inline void transpose(Float4& a, Float4& b, Float4& c, Float4& d) {
    const Float4 ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
    const Float4 ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
    const Float4 cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
    const Float4 cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
    a = __builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5);
    b = __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7);
    c = __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5);
    d = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7);
}

}  // namespace camdir
