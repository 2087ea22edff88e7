#include "camera/group/cut_plan.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

namespace camdir::camera {
namespace {

struct CutProblem {
    std::vector<CutPlace> places;
    std::vector<float> times;
    std::vector<float> weights;
};

constexpr float shortest = 0.8F;

// By trying everything.
float best_from(const CutProblem& problem, std::size_t begin) {
    float best = -std::numeric_limits<float>::infinity();
    for (const CutPlace& place : problem.places) {
        float shown = -place.cost;
        for (std::size_t end = begin;; ++end) {
            const bool is_over = end == problem.times.size();
            if (is_over) best = std::max(best, shown);
            if (is_over) break;
            if (problem.times[end] - problem.times[begin] > shortest - 0.01F)
                best = std::max(best, shown + best_from(problem, end));
            if ((place.shows >> end & 1U) != 0) shown += problem.weights[end];
        }
    }
    return best;
}

CutProblem random_problem(std::mt19937_64& random, std::size_t instants, float tick, float first_tick) {
    CutProblem problem;
    for (std::size_t i = 0; i < instants; ++i) {
        problem.times.push_back(i == 0 ? 0.0F : first_tick + tick * static_cast<float>(i - 1));
        problem.weights.push_back(i == 0 ? first_tick : i + 1 == instants ? 0.6F : tick);
    }
    const std::size_t places = 1 + random() % 4;
    for (std::uint32_t i = 0; i < places; ++i)
        problem.places.push_back(
            {i, static_cast<Shows>(random() & random()), 0.01F * static_cast<float>(random() % 30)});
    return problem;
}

void expect_the_best(const CutProblem& problem) {
    std::vector<float> best(problem.times.size());
    plan_cuts(problem.places, problem.times, problem.weights, shortest, best);
    for (std::size_t begin = 0; begin < best.size(); ++begin)
        EXPECT_NEAR(best[begin], best_from(problem, begin), 1e-4F) << "from instant " << begin;
}

TEST(CutPlan, IsAsGoodAsTheBestOfAllSequences) {
    std::mt19937_64 random(5);
    for (int i = 0; i < 60; ++i) {
        expect_the_best(
            random_problem(random, Members::most, 0.05F, 0.05F - 0.005F * static_cast<float>(i % 10)));
        expect_the_best(random_problem(random, 4, 0.2F, 0.2F));
        expect_the_best(random_problem(random, 1 + random() % 9, 0.3F, 0.3F));
    }
}

TEST(CutPlan, CutsThereAndBackWhereThatIsWorthIt) {
    CutProblem problem;
    for (int i = 0; i < 24; ++i) {
        problem.times.push_back(0.1F * static_cast<float>(i));
        problem.weights.push_back(0.1F);
    }
    problem.places = {{0, 0xFF00FF, 0.2F}, {1, 0x00FF00, 0.2F}};
    std::vector<float> best(24);
    plan_cuts(problem.places, problem.times, problem.weights, shortest, best);
    EXPECT_NEAR(best[0], 2.4F - 3 * 0.2F, 1e-4F);
    problem.places[1].cost = 0.7F;
    plan_cuts(problem.places, problem.times, problem.weights, shortest, best);
    EXPECT_NEAR(best[0], 1.6F - 0.2F, 1e-4F) << "there and back costs more than it shows";
}

}  // namespace
}  // namespace camdir::camera
