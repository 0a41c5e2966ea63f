#include "genu/model/load_rates.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "support/finite_difference.h"
#include "support/scene_model.h"

namespace genu {
namespace {

void edit(Load& load, const Parameter& p, double delta) {
  using Kind = Parameter::Kind;
  if (p.kind == Kind::force) load.force[p.component] += delta;
  if (p.kind == Kind::moment) load.moment[p.component] += delta;
  if (p.kind == Kind::point) load.p_A[p.component] += delta;
  if (p.kind == Kind::toward_point) load.p_B[p.component] += delta;
  if (p.kind == Kind::magnitude) load.value += delta;
}

TEST(LoadRates, AreWhatAnEditedLoadExerts) {
  const auto s = test::scene_model(
      test::bone_on_ground() +
      test::load("dead", "force = [3, -10, -20]\nmoment = [0.05, 0.02, 0.01]\npoint = [3, 4, 10]") +
      test::load("follow", "force = [2, 5, -30]\nmoment = [0.02, 0.3, -0.1]\npoint = [-5, 2, 8]\nframe = \"body\"") +
      test::load("pull", "point = [1, 2, 30]\ntoward = { body = \"ground\", point = [5, 40, -60] }\nmagnitude = 15"));
  const Pose X_WA{exp_rotation(Vec3(0.3, -0.2, 0.5)), Vec3(0.01, 0.02, -0.03)},
      X_WB{exp_rotation(Vec3(-0.1, 0.4, 0.2)), Vec3(-0.02, 0.01, 0.01)};
  double worst = 0;
  int compared = 0;
  for (const Parameter& p : parameters_of(s.scene)) {
    if (!p.of_load() || p.kind == Parameter::Kind::factor) continue;
    const Load& load = s.model.loads[static_cast<std::size_t>(p.object)];
    const Vec12 truth = test::derivative(
        [&](double share) {
          Load edited = load;
          edit(edited, p, share * p.change);
          return edited.between(X_WA, X_WB).wrench;
        },
        0.01);
    const double error = (p.change * load_wrench_rate(load, p, X_WA, X_WB) - truth).norm() / truth.norm();
    EXPECT_LT(error, 1e-9) << p.name;
    worst = std::max(worst, error);
    ++compared;
  }
  std::printf("%d rates, worst relative error %.2g\n", compared, worst);
  EXPECT_EQ(compared, 9 + 9 + 7);
}

}  // namespace
}  // namespace genu
