// Angles and directions, four at a time: within 4e-7 of the exact ones, and the same on every machine.
#pragma once

#include <numbers>

#include "base/float4.hpp"

namespace camdir::camera {

// By minimax polynomials.
struct SineCosine {
    Float4 sine, cosine;
};

// Of angles up to some hundred turns.
inline SineCosine sine_cosine(Float4 angle) {
    // Quarter turns, rounded: what is added leaves no room for a fraction.
    constexpr float no_fraction = 12582912.0F;  // 1.5 * 2^23
    const Float4 shifted = angle * (2.0F * std::numbers::inv_pi_v<float>)+no_fraction;
    const Float4 quarters = shifted - no_fraction;
    // Half of pi in three parts, of which the first ones have few digits.
    const Float4 x =
        ((angle - quarters * 1.5703125F) - quarters * 4.83751297e-4F) - quarters * 7.54978995e-8F;
    const Float4 x2 = x * x;
    const Float4 sine = x + x * x2 * (-0.166666368F + x2 * (0.00833158460F + x2 * -0.000194621169F));
    const Float4 cosine = 0.999999972F + x2 * (-0.499998567F + x2 * (0.0416550269F + x2 * -0.00135859085F));
    const auto quarter = reinterpret_cast<Mask4>(shifted);
    const Mask4 odd = (quarter & 1) != 0;
    const Float4 s = odd ? cosine : sine;
    const Float4 c = odd ? sine : cosine;
    return {(quarter & 2) != 0 ? -s : s, ((quarter + 1) & 2) != 0 ? -c : c};
}

// The angle of (x, y) from the x axis, -pi .. pi; 0 for (0, 0).
inline Float4 arc_tangent(Float4 y, Float4 x) {
    const Float4 width = larger(x, -x);
    const Float4 height = larger(y, -y);
    const Float4 longer = larger(width, height);
    const Float4 ratio = longer > 0.0F ? smaller(width, height) / longer : Float4{};
    const Float4 r2 = ratio * ratio;
    const Float4 high = 0.0964219443F + r2 * (-0.0559122924F + r2 * (0.0218629368F + r2 * -0.00405456197F));
    const Float4 low = -0.333298607F + r2 * (0.199465653F + r2 * (-0.139086282F + r2 * high));
    Float4 angle = 0.999999336F * ratio + ratio * r2 * low;
    angle = height > width ? 0.5F * std::numbers::pi_v<float> - angle : angle;
    angle = x < 0.0F ? std::numbers::pi_v<float> - angle : angle;
    return y < 0.0F ? -angle : angle;
}

// Of length 1.
struct Directions {
    Float4 x, y, z;
};

// The directions of four looks (view.hpp).
inline Directions directions_of(Float4 yaw, Float4 pitch) {
    const SineCosine round = sine_cosine(yaw);
    const SineCosine up = sine_cosine(pitch);
    return {up.cosine * round.cosine, up.cosine * round.sine, up.sine};
}

}  // namespace camdir::camera
