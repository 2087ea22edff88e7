#include "camera/smoother.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <random>
#include <vector>

#include "base/geometry.hpp"

namespace camdir::camera {
namespace {

struct Problem {
    std::vector<double> weights;
    std::vector<double> goals;
    double stiffness;
    double before_last;
    double last;
};

Problem random_problem(std::mt19937& random, std::size_t count) {
    std::uniform_real_distribution<double> place(-200.0, 200.0);
    std::uniform_real_distribution<double> exponent(-2.0, 6.0);
    Problem problem;
    problem.stiffness = std::pow(10.0, exponent(random));
    problem.before_last = place(random);
    problem.last = place(random);
    for (std::size_t i = 0; i < count; ++i) {
        problem.weights.push_back(std::pow(10.0, 0.3 * exponent(random)));
        problem.goals.push_back(place(random));
    }
    return problem;
}

// The normal equations of the whole least-squares problem, dense.
Eigen::VectorXd dense_solution(const Problem& problem) {
    const auto count = static_cast<Eigen::Index>(problem.weights.size());
    Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(2 * count, count);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(2 * count);
    const double bend = std::sqrt(problem.stiffness);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double weight = std::sqrt(problem.weights[static_cast<std::size_t>(i)]);
        rows(i, i) = weight;
        right(i) = weight * problem.goals[static_cast<std::size_t>(i)];
        const double factors[] = {1.0, -2.0, 1.0};
        for (Eigen::Index k = 0; k < 3; ++k) {
            const Eigen::Index at = i - 2 + k;
            const double factor = bend * factors[k];
            if (at >= 0)
                rows(count + i, at) += factor;
            else
                right(count + i) -= factor * (at == -1 ? problem.last : problem.before_last);
        }
    }
    return rows.colPivHouseholderQr().solve(right);
}

TEST(Smoother, IsTheDenseLeastSquaresSolution) {
    std::mt19937 random(7);
    Smoother smoother;
    for (const std::size_t count : {1U, 2U, 3U, 4U, 17U, 60U}) {
        for (int round = 0; round < 20; ++round) {
            const Problem problem = random_problem(random, count);
            std::vector<double> values(count);
            for (std::size_t i = 0; i < count; ++i)
                values[i] = problem.weights[i] * problem.goals[i];
            smoother.factorise(problem.weights, problem.stiffness);
            smoother.solve(problem.before_last, problem.last, std::span(values));
            const Eigen::VectorXd expected = dense_solution(problem);
            for (std::size_t i = 0; i < count; ++i)
                EXPECT_NEAR(values[i], expected(static_cast<Eigen::Index>(i)),
                            1e-6 * (1.0 + expected.cwiseAbs().maxCoeff()))
                    << count << " values, stiffness " << problem.stiffness;
        }
    }
}

TEST(Smoother, SolvesVectorsAsItsComponents) {
    std::mt19937 random(11);
    constexpr std::size_t count = 25;
    const Problem x = random_problem(random, count);
    Problem y = random_problem(random, count);
    Smoother smoother;
    smoother.factorise(x.weights, x.stiffness);
    std::vector<double> xs(count);
    std::vector<double> ys(count);
    std::vector<Vec3d> both(count);
    for (std::size_t i = 0; i < count; ++i) {
        xs[i] = x.weights[i] * x.goals[i];
        ys[i] = x.weights[i] * y.goals[i];
        both[i] = {xs[i], ys[i], 0.0};
    }
    smoother.solve(x.before_last, x.last, std::span(xs));
    smoother.solve(y.before_last, y.last, std::span(ys));
    smoother.solve(Vec3d(x.before_last, y.before_last, 0.0), Vec3d(x.last, y.last, 0.0), std::span(both));
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_EQ(both[i], Vec3d(xs[i], ys[i], 0.0));
}

TEST(Smoother, KeepsUniformMotion) {
    constexpr std::size_t count = 40;
    Smoother smoother;
    const std::vector<double> weights(count, 1.0);
    smoother.factorise(weights, 2000.0);
    std::vector<double> values(count);
    for (std::size_t i = 0; i < count; ++i)
        values[i] = 3.0 * static_cast<double>(i) + 5.0;
    smoother.solve(-1.0, 2.0, std::span(values));
    for (std::size_t i = 0; i < count; ++i)
        EXPECT_NEAR(values[i], 3.0 * static_cast<double>(i) + 5.0, 1e-9);
}

}  // namespace
}  // namespace camdir::camera
