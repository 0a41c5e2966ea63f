#include "genu/core/least_squares.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace genu {
namespace {

LeastSquaresProblem linear(const MatX& A, const VecX& b) {
  return {
      [=](const VecX& x) { return std::optional<VecX>(A * x - b); }, [=](const VecX&) { return std::optional(A); }, {}};
}

/// Rosenbrock's valley as two residuals.
LeastSquaresProblem rosenbrock() {
  return {[](const VecX& x) { return std::optional<VecX>(Vec2(10 * (x[1] - x[0] * x[0]), 1 - x[0])); },
          [](const VecX& x) { return std::optional<MatX>((MatX(2, 2) << -20 * x[0], 10, -1, 0).finished()); },
          {}};
}

TEST(LeastSquares, ALinearProblemIsTheNormalEquations) {
  MatX A(5, 2);
  A << 1, 0, 1, 1, 1, 2, 1, 3, 1, 4;
  VecX b(5);
  b << 1.1, 2.9, 5.2, 6.8, 9.1;
  const LeastSquaresResult r = least_squares(linear(A, b), Vec2(-30, 50));
  EXPECT_TRUE(converged(r.stop)) << to_string(r.stop);
  const VecX x = (A.transpose() * A).ldlt().solve(A.transpose() * b);
  EXPECT_LT((r.x - x).norm(), 1e-7);
  // The textbook's deviations of a straight line.
  const LeastSquaresUncertainty u = least_squares_uncertainty(r.jacobian, r.residuals, 1e-9);
  const double s2 = (A * x - b).squaredNorm() / 3;
  EXPECT_NEAR(u.deviation[1], std::sqrt(s2 / 10), 1e-9);
  EXPECT_NEAR(u.deviation[0], std::sqrt(s2 * 30 / 50), 1e-9);
  EXPECT_NEAR(u.correlation(0, 1), -10 / std::sqrt(5.0 * 30), 1e-12);
  EXPECT_TRUE(u.undetermined.empty());
}

TEST(LeastSquares, FollowsACurvedValley) {
  const LeastSquaresResult r = least_squares(rosenbrock(), Vec2(-1.2, 1));
  EXPECT_EQ(r.stop, LeastSquaresStop::small_step) << to_string(r.stop);
  EXPECT_LT((r.x - Vec2(1, 1)).norm(), 1e-8);
  EXPECT_LT(r.iterations, 30);
}

TEST(LeastSquares, UnitsOfUnknownsDoNotMatter) {
  const Vec2 unit(1e-6, 1e4);
  const LeastSquaresProblem plain = rosenbrock();
  const LeastSquaresProblem scaled = {
      [&](const VecX& x) { return plain.residuals(x.cwiseProduct(unit)); },
      [&](const VecX& x) { return std::optional<MatX>(*plain.jacobian(x.cwiseProduct(unit)) * unit.asDiagonal()); },
      {}};
  LeastSquaresOptions exact;
  exact.step_tolerance = 0;
  const LeastSquaresResult a = least_squares(plain, Vec2(-1.2, 1), exact);
  const LeastSquaresResult b = least_squares(scaled, Vec2(-1.2, 1).cwiseQuotient(unit), exact);
  EXPECT_LT((b.x.cwiseProduct(unit) - a.x).norm(), 1e-9);
}

TEST(LeastSquares, StepsBackWhereThereAreNoResiduals) {
  // log x - 3, of which there is none for x <= 0: from x = 100 the full step leads to -398.
  const LeastSquaresProblem log = {[](const VecX& x) {
                                     if (!(x[0] > 0)) return std::optional<VecX>();
                                     return std::optional<VecX>(VecX::Constant(1, std::log(x[0]) - 0.1));
                                   },
                                   [](const VecX& x) { return std::optional<MatX>(MatX::Constant(1, 1, 1 / x[0])); },
                                   {}};
  const LeastSquaresResult r = least_squares(log, VecX::Constant(1, 100));
  EXPECT_TRUE(converged(r.stop)) << to_string(r.stop);
  EXPECT_NEAR(r.x[0], std::exp(0.1), 1e-7);
  EXPECT_EQ(least_squares(log, VecX::Constant(1, -1)).stop, LeastSquaresStop::no_start);
}

TEST(LeastSquares, DirectionsOfNoiseAreLeftAlone) {
  MatX A(3, 3);
  A << 1, 1 + 1e-9, 1e-9, 2, 2 - 1e-9, -1e-9, 3, 3, 2e-9;
  const LeastSquaresProblem problem = linear(A, Vec3(1.1, 1.9, 3.05));
  LeastSquaresOptions careful;
  careful.noise = 1e-6;
  const LeastSquaresResult r = least_squares(problem, Vec3(0, 0, 5), careful);
  EXPECT_TRUE(converged(r.stop)) << to_string(r.stop);
  EXPECT_EQ(r.x[2], 5);
  EXPECT_NEAR(r.x[0], r.x[1], 1e-6) << "their difference is not told, and stays";
  EXPECT_NEAR(r.x[0] + r.x[1], (1.1 + 2 * 1.9 + 3 * 3.05) / 14, 1e-6);
}

TEST(LeastSquares, NoStepIsLongerThanAllowed) {
  double longest = 0;
  Vec2 last(-1.2, 1);
  LeastSquaresProblem watched = rosenbrock();
  watched.jacobian = [&](const VecX& x) {
    longest = std::max(longest, (x - last).lpNorm<Eigen::Infinity>());
    last = x;
    return rosenbrock().jacobian(x);
  };
  LeastSquaresOptions careful;
  careful.most_step = 0.1;
  const LeastSquaresResult r = least_squares(watched, last, careful);
  EXPECT_TRUE(converged(r.stop)) << to_string(r.stop);
  EXPECT_LE(longest, 0.1 * (1 + 1e-12));
  EXPECT_LT((r.x - Vec2(1, 1)).norm(), 1e-7);
}

/// Of a linear problem within bounds, which is convex: no unknown that is free, or could come back from its bound, has
/// a gradient that would lower the sum of squares.
TEST(LeastSquares, UnknownsLeaveBoundsThatTheyWereStoppedAt) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto drawn = [&](Eigen::Index rows, Eigen::Index columns) {
    return MatX(MatX::NullaryExpr(rows, columns, [&]() { return uniform(random); }));
  };
  int at_bounds = 0;
  for (int k = 0; k < 300; ++k) {
    const MatX J = drawn(9, 6);
    const VecX y = 2 * drawn(9, 1);
    LeastSquaresProblem problem;
    problem.residuals = [&](const VecX& x) { return std::optional<VecX>(J * x - y); };
    problem.jacobian = [&](const VecX&) { return std::optional<MatX>(J); };
    LeastSquaresOptions options;
    options.lower = VecX::Constant(6, -0.3);
    options.upper = VecX::Constant(6, 0.3);
    const VecX start = 0.3 * drawn(6, 1).cwiseSign();
    const LeastSquaresResult found = least_squares(problem, start, options);
    ASSERT_TRUE(converged(found.stop)) << to_string(found.stop);
    const VecX gradient = J.transpose() * (J * found.x - y);
    for (Eigen::Index i = 0; i < 6; ++i) {
      const bool low = found.x[i]<options.lower[i] + 1e-12, high = found.x[i]> options.upper[i] - 1e-12;
      at_bounds += low || high ? 1 : 0;
      EXPECT_GT(gradient[i], high ? -1e300 : -1e-4) << "problem " << k << ", unknown " << i;
      EXPECT_LT(gradient[i], low ? 1e300 : 1e-4) << "problem " << k << ", unknown " << i;
    }
  }
  EXPECT_GT(at_bounds, 300);
}

TEST(LeastSquares, EveryReasonToStop) {
  LeastSquaresOptions few;
  few.most_iterations = 2;
  EXPECT_EQ(least_squares(rosenbrock(), Vec2(-1.2, 1), few).stop, LeastSquaresStop::most_iterations);
  LeastSquaresProblem wrong = rosenbrock();
  wrong.jacobian = [](const VecX& x) { return std::optional<MatX>(-*rosenbrock().jacobian(x)); };
  EXPECT_EQ(least_squares(wrong, Vec2(-1.2, 1)).stop, LeastSquaresStop::no_progress);
  wrong.jacobian = [](const VecX&) { return std::optional<MatX>(); };
  EXPECT_EQ(least_squares(wrong, Vec2(-1.2, 1)).stop, LeastSquaresStop::no_derivatives);
  wrong = rosenbrock();
  wrong.cancelled = [] { return true; };
  EXPECT_EQ(least_squares(wrong, Vec2(-1.2, 1)).stop, LeastSquaresStop::cancelled);
  EXPECT_EQ(least_squares(linear(MatX::Zero(3, 1), Vec3(1, 2, 3)), VecX::Zero(1)).stop, LeastSquaresStop::flat);
}

TEST(LeastSquares, IsLeftWhereTheProblemAsksForIt) {
  LeastSquaresProblem p = rosenbrock();
  p.leave = [](const VecX& x) { return x[0] > -1; };
  const LeastSquaresResult on_the_way = least_squares(p, Vec2(-1.2, 1));
  EXPECT_EQ(on_the_way.stop, LeastSquaresStop::left);
  EXPECT_FALSE(converged(on_the_way.stop));
  EXPECT_GT(on_the_way.x[0], -1);
  EXPECT_GT(on_the_way.iterations, 0);
  const LeastSquaresResult at_once = least_squares(p, Vec2(0, 1));
  EXPECT_EQ(at_once.stop, LeastSquaresStop::left);
  EXPECT_EQ(at_once.iterations, 0);
  EXPECT_EQ(at_once.x, VecX(Vec2(0, 1)));
}

/// The minimum of |x| + y at an edge, x = 0, beyond which residuals have other derivatives: steps along it become
/// short.
TEST(LeastSquares, CreepingAlongAnEdgeIsNoConvergence) {
  LeastSquaresProblem p;
  p.residuals = [](const VecX& x) { return std::optional<VecX>(Vec2(10 * std::abs(x[0] - x[1]) + 1, x[1] - 3)); };
  p.jacobian = [](const VecX& x) {
    const double side = x[0] > x[1] ? 10 : -10;
    MatX J(2, 2);
    J << side, -side, 0, 1;
    return std::optional<MatX>(J);
  };
  LeastSquaresOptions how;
  how.most_iterations = 1000;
  const LeastSquaresResult all = least_squares(p, Vec2(1, 0), how);
  how.most_creeping = 5;
  const LeastSquaresResult r = least_squares(p, Vec2(1, 0), how);
  EXPECT_FALSE(converged(r.stop)) << to_string(r.stop);
  EXPECT_LE(r.trials, all.trials);
  std::printf("%s: %d trials; without: %s, %d trials\n", to_string(r.stop), r.trials, to_string(all.stop), all.trials);
  EXPECT_TRUE(converged(least_squares(rosenbrock(), Vec2(-1.2, 1), how).stop)) << "a curved valley is no edge";
}

TEST(LeastSquares, SaysWhatIsNotDetermined) {
  // Only x + y and z are; u is in nothing.
  MatX A(4, 4);
  A << 1, 1, 0, 0, 2, 2, 1, 0, 3, 3, 0, 0, 0, 0, 2, 0;
  VecX b(4);
  b << 1, 2.1, 3, 0.2;
  const LeastSquaresResult r = least_squares(linear(A, b), VecX::Zero(4));
  EXPECT_TRUE(converged(r.stop)) << to_string(r.stop);
  EXPECT_NEAR(r.x[3], 0, 1e-12) << "stays where it started";
  const LeastSquaresUncertainty u = least_squares_uncertainty(r.jacobian, r.residuals, 1e-9);
  ASSERT_EQ(u.undetermined.size(), 2u);
  EXPECT_FALSE(std::isfinite(u.deviation[0]));
  EXPECT_FALSE(std::isfinite(u.deviation[1]));
  EXPECT_TRUE(std::isfinite(u.deviation[2]));
  EXPECT_FALSE(std::isfinite(u.deviation[3]));
  for (const VecX& v : u.undetermined) EXPECT_LT((A * v).norm(), 1e-12);
  EXPECT_FALSE(std::isfinite(least_squares_uncertainty(MatX::Identity(2, 2), Vec2(0, 0), 1e-9).deviation[0]))
      << "no residuals are left to tell by";
}

}  // namespace
}  // namespace genu
