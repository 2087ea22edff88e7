#include "camera/programme.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <random>
#include <vector>

namespace camdir::camera {
namespace {

constexpr std::size_t yaws = DirectionGrid::yaws;
constexpr float infinity = std::numeric_limits<float>::infinity();

struct Instance {
    std::vector<DirectionCosts> direction_costs;  // by knot
    std::vector<DirectionCosts> lengths;
    ProgrammeCosts costs;
};

// Few directions in a patch of the grid that wraps round, so that all paths can be tried.
Instance random_instance(std::mt19937& random, std::size_t knots, float blocked) {
    std::uniform_real_distribution<float> share(0.0F, 1.0F);
    Instance instance;
    const std::size_t first_yaw = random() % yaws;
    const std::size_t first_elevation = random() % 7;
    instance.direction_costs.resize(knots);
    instance.lengths.resize(knots);
    for (std::size_t knot = 0; knot < knots; ++knot) {
        instance.direction_costs[knot].fill(2.0F * forbidden);
        for (std::size_t bin = 0; bin < DirectionGrid::size; ++bin)
            instance.lengths[knot][bin] = share(random) < blocked ? 120.0F * share(random) : 120.0F;
        for (std::size_t k = 0; k < 8; ++k) {
            const std::size_t yaw = (first_yaw + k % 4) % yaws;
            const std::size_t bin = (first_elevation + k / 4) * yaws + yaw;
            instance.direction_costs[knot][bin] = 4.0F * share(random);
        }
    }
    instance.costs.start_length = share(random) < 0.5F ? -1.0F : 120.0F * share(random);
    return instance;
}

float own_cost(const Instance& instance, std::size_t knot, std::size_t bin) {
    const ProgrammeCosts& costs = instance.costs;
    const float length = instance.lengths[knot][bin];
    const float missing = (costs.length - length) / (0.5F * costs.length);
    return instance.direction_costs[knot][bin] + costs.shortage * missing * missing +
           (length < ProgrammeCosts::close_share * costs.length ? costs.close : 0.0F);
}

float step_cost(const Instance& instance, std::size_t knot, std::size_t from, std::size_t to) {
    const int turn = std::abs(static_cast<int>(from % yaws) - static_cast<int>(to % yaws));
    const int turned = std::min(turn, static_cast<int>(yaws) - turn);
    const int rise = std::abs(static_cast<int>(from / yaws) - static_cast<int>(to / yaws));
    if (turned > 2 || rise > 1) return infinity;
    const float change =
        (instance.lengths[knot + 1][to] - instance.lengths[knot][from]) / (0.5F * instance.costs.length);
    return instance.costs.turn * static_cast<float>(turned * turned + rise * rise) +
           instance.costs.stretch * change * change;
}

float cost_of(const Instance& instance, const std::vector<std::size_t>& path) {
    float cost = 0.0F;
    if (instance.costs.start_length >= 0.0F) {
        const float change =
            (instance.lengths[0][path[0]] - instance.costs.start_length) / (0.5F * instance.costs.length);
        cost += instance.costs.stretch * change * change;
    }
    for (std::size_t knot = 0; knot < path.size(); ++knot) {
        cost += own_cost(instance, knot, path[knot]);
        if (knot + 1 < path.size()) cost += step_cost(instance, knot, path[knot], path[knot + 1]);
    }
    return cost;
}

float least_cost_of_all(const Instance& instance, std::vector<std::size_t>& path) {
    if (path.size() == instance.direction_costs.size()) return cost_of(instance, path);
    float least = infinity;
    for (std::size_t bin = 0; bin < DirectionGrid::size; ++bin) {
        if (instance.direction_costs[path.size()][bin] >= forbidden) continue;
        path.push_back(bin);
        least = std::min(least, least_cost_of_all(instance, path));
        path.pop_back();
    }
    return least;
}

TEST(Programme, FindsTheLeastOfAllPaths) {
    std::mt19937 random(3);
    const auto programme = std::make_unique<Programme>();
    for (int round = 0; round < 60; ++round) {
        const std::size_t knots = 1 + static_cast<std::size_t>(round) % 5;
        const Instance instance = random_instance(random, knots, round % 3 == 0 ? 0.0F : 0.6F);
        const auto choices =
            programme->solve(instance.direction_costs, instance.costs,
                             [&](std::size_t knot, std::size_t bin) { return instance.lengths[knot][bin]; });
        ASSERT_EQ(choices.size(), knots);
        std::vector<std::size_t> path;
        for (std::size_t knot = 0; knot < knots; ++knot) {
            path.push_back(choices[knot].bin);
            EXPECT_EQ(choices[knot].length, instance.lengths[knot][choices[knot].bin]);
        }
        std::vector<std::size_t> none;
        EXPECT_NEAR(cost_of(instance, path), least_cost_of_all(instance, none), 1e-3F) << "round " << round;
    }
}

TEST(Programme, AsksForALengthOnceAndForFewWhereNothingIsInTheWay) {
    const auto programme = std::make_unique<Programme>();
    std::vector<DirectionCosts> direction_costs(10);
    for (auto& costs : direction_costs) {
        for (std::size_t bin = 0; bin < costs.size(); ++bin)
            costs[bin] = 0.1F * static_cast<float>(bin % yaws + bin / yaws);
    }
    std::vector<DirectionCosts> asked(10);
    for (auto& row : asked)
        row.fill(0.0F);
    int total = 0;
    const auto choices = programme->solve(direction_costs, {}, [&](std::size_t knot, std::size_t bin) {
        ++total;
        EXPECT_EQ(asked[knot][bin]++, 0.0F);
        return 120.0F;
    });
    EXPECT_EQ(choices.size(), 10U);
    EXPECT_EQ(total, 10);
}

TEST(Programme, HasNoPathThroughForbiddenKnots) {
    const auto programme = std::make_unique<Programme>();
    std::vector<DirectionCosts> direction_costs(3);
    for (auto& costs : direction_costs)
        costs.fill(0.0F);
    direction_costs[1].fill(2.0F * forbidden);
    const auto length = [](std::size_t, std::size_t) { return 120.0F; };
    EXPECT_TRUE(programme->solve(direction_costs, {}, length).empty());
}

}  // namespace
}  // namespace camdir::camera
