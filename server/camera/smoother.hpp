// The one smoother of the planner: values x that stay near goals g and bend little,
//     minimise  sum_i w_i |x_i - g_i|^2  +  stiffness * sum_i |x_(i-1) - 2 x_i + x_(i+1)|^2,
// after two fixed values x_(-2), x_(-1) of history. Its matrix is symmetric, positive definite and has five
// diagonals: factorised as L D L^T in linear time.
#pragma once

#include <array>
#include <cassert>
#include <cstddef>
#include <span>
#include <utility>

namespace camdir::camera {

class Smoother {
  public:
    static constexpr std::size_t capacity = 384;

    // `weights` are positive: one for each value. `stiffness` = (time constant / time step)^4.
    void factorise(std::span<const double> weights, double stiffness) {
        count_ = weights.size();
        stiffness_ = stiffness;
        assert(count_ > 0 && count_ <= capacity);
        double first_before = 0.0;  // L D's: rows' subdiagonals before they are divided by the pivot
        double second_before = 0.0;
        double second_before_last = 0.0;
        for (std::size_t i = 0; i < count_; ++i) {
            const Row row = second_differences(i);
            double diagonal = weights[i] + stiffness * row.diagonal;
            double first = stiffness * row.first;
            const double second = stiffness * row.second;
            if (i >= 1) {
                diagonal -= lower1_[i - 1] * first_before;
                first -= lower2_[i - 1] * first_before;
            }
            if (i >= 2) diagonal -= lower2_[i - 2] * second_before_last;
            inverse_pivot_[i] = 1.0 / diagonal;
            lower1_[i] = first * inverse_pivot_[i];
            lower2_[i] = second * inverse_pivot_[i];
            first_before = first;
            second_before_last = std::exchange(second_before, second);
        }
    }

    // Replaces `values`, which hold w_i g_i, by x. Value: double, or a vector of doubles.
    template <class Value>
    void solve(const Value& before_last, const Value& last, std::span<Value> values) const {
        assert(values.size() == count_);
        values[0] += stiffness_ * (2.0 * last - before_last);
        values[0] += (count_ > 1 ? 2.0 : 0.0) * stiffness_ * last;
        if (count_ > 1) values[1] -= stiffness_ * last;
        // The neighbour, which has only just been computed, comes last.
        for (std::size_t i = 1; i < count_; ++i) {
            if (i >= 2) values[i] -= lower2_[i - 2] * values[i - 2];
            values[i] -= lower1_[i - 1] * values[i - 1];
        }
        for (std::size_t i = count_; i-- > 0;) {
            values[i] *= inverse_pivot_[i];
            if (i + 2 < count_) values[i] -= lower2_[i] * values[i + 2];
            if (i + 1 < count_) values[i] -= lower1_[i] * values[i + 1];
        }
    }

  private:
    struct Row {
        double diagonal, first, second;
    };
    // Of the sum's matrix: value i is the end, the middle and the beginning of a second difference each.
    [[nodiscard]] Row second_differences(std::size_t i) const {
        const bool middle = i + 1 < count_;
        const bool begin = i + 2 < count_;
        return {1.0 + (middle ? 4.0 : 0.0) + (begin ? 1.0 : 0.0),
                (middle ? -2.0 : 0.0) + (begin ? -2.0 : 0.0), begin ? 1.0 : 0.0};
    }

    std::size_t count_ = 0;
    double stiffness_ = 0.0;
    std::array<double, capacity> inverse_pivot_;
    std::array<double, capacity> lower1_;  // L(i + 1, i)
    std::array<double, capacity> lower2_;  // L(i + 2, i)
};

}  // namespace camdir::camera
