#include "genu/model/load_rates.h"

#include <cstdio>

#include <gtest/gtest.h>

#include "support/finite_difference.h"
#include "support/number_text.h"
#include "support/scene_model.h"

namespace genu {
namespace {

/// The load of an edited scene.
Load edited(PlacedScene scene, const Parameter& p, double delta) {
  *parameter_number(scene, p) += delta;
  std::string why;
  return make_load(scene, scene.loads[static_cast<std::size_t>(p.object)], why).value_or(Load{});
}

/// A load of a kind with every number that it can have.
std::string all_numbers(const std::string& name, int kind) {
  const ChosenUnits chosen{units::kMillimetre, 1, "mm", "rad"};
  const std::string head = kind < 2 ? "body = \"bone\"\n" : kind == 2 ? "on = \"j.a\"\n" : "on = \"j.x\"\n";
  const std::string end = kind == 1 ? "[load." + name + ".toward]\nbody = \"ground\"\n" +
                                          test::number_text(kLoadKinds[kind], chosen, "toward")
                                    : "";
  return "[load." + name + "]\n" + head + test::number_text(kLoadKinds[kind], chosen) + end;
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
        [&](double share) { return edited(s.scene, p, share * p.change).between(X_WA, X_WB).wrench; }, 0.01);
    const double error =
        (p.change * load_wrench_rate(load, load_change(s.scene, p), X_WA, X_WB) - truth).norm() / truth.norm();
    EXPECT_LT(error, 1e-9) << p.name;
    worst = std::max(worst, error);
    ++compared;
  }
  std::printf("%d rates, worst relative error %.2g\n", compared, worst);
  EXPECT_GE(compared, 9 + 9 + 7);
}

/// load_change() holds for loads that are affine in each of their numbers.
TEST(LoadRates, LoadsAreAffineInEachNumber) {
  const auto s = test::scene_model(
      test::bone_on_ground() + test::load("follow", "force = [2, 5, -30]\npoint = [-5, 2, 8]\nframe = \"body\"") +
      all_numbers("dead", 0) + all_numbers("pull", 1) + all_numbers("turn", 2) + all_numbers("shift", 3) +
      "[load.cable]\nfrom = { body = \"ground\", point = [50, 1, 2] }\nto = { body = \"bone\", point = [1, 2, 3] }\n"
      "magnitude = 20\nactivation = 0.7\n");
  int compared = 0;
  for (const Parameter& p : parameters_of(s.scene)) {
    if (!p.of_load() || p.kind == Parameter::Kind::factor) continue;
    const Load at = edited(s.scene, p, 0), change = load_change(s.scene, p);
    for (const double delta : {-0.7, 0.3, 40.0}) {
      const Load there = edited(s.scene, p, delta);
      const auto expect = [&](const auto& now, const auto& before, const auto& slope) {
        EXPECT_LT((now - before - delta * slope).norm(), 1e-12) << p.name << " by " << delta;
      };
      expect(there.force, at.force, change.force);
      expect(there.moment, at.moment, change.moment);
      expect(there.p_A, at.p_A, change.p_A);
      expect(there.p_B, at.p_B, change.p_B);
      EXPECT_NEAR(there.value - at.value, delta * change.value, 1e-12) << p.name << " by " << delta;
      ++compared;
    }
  }
  int expected = 9;  // of the follower
  for (const KindOf<LoadDef>& kind : kLoadKinds) expected += test::number_count(kind);
  EXPECT_EQ(compared, 3 * expected);
}

}  // namespace
}  // namespace genu
