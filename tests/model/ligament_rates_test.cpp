#include "genu/model/ligament_rates.h"

#include <cmath>
#include <cstdio>

#include <gtest/gtest.h>

#include "support/finite_difference.h"
#include "support/scene_model.h"

namespace genu {
namespace {

using test::derivative;

struct Case {
  const char* law;
  double share;  ///< of the slack length the ligament is stretched to at the pose
};

constexpr Case kCases[] = {
    {"law = \"quadratic\"\nstiffness = 20000\n", 1.05},
    {"law = \"linear\"\nstiffness = 900\n", 1.04},
    {"law = \"blankevoort\"\nstiffness = 2000\ntransition_strain = 0.06\n", 1.03},
    {"law = \"blankevoort\"\nstiffness = 2000\ntransition_strain = 0.06\n", 1.09},
    {"law = \"abdel-rahman\"\nstiffness = 30\ntoe_stiffness = 6\ntransition_strain = 0.05\n", 1.03},
    {"law = \"abdel-rahman\"\nstiffness = 30\ntoe_stiffness = 6\ntransition_strain = 0.05\n", 1.08},
    {"law = \"spring\"\nstiffness = 3\n", 1.1},
    {"law = \"spring\"\nstiffness = 3\n", 0.9},
    {"law = \"table\"\npoints = [[0, 0], [0.02, 10], [0.06, 40], [0.2, 150]]\n", 1.04},
    {"law = \"quadratic\"\nstiffness = 20000\n", 0.9},
};

/// The ends 60 mm apart in the reference pose; at the pose 60 mm times `stretch`, the bodies turned.
constexpr double kLength = 60e-3;
const Pose kReference{exp_rotation(Vec3(0.1, -0.2, 0.3)), Vec3(0.01, 0.02, 0.03)};

void edit(LigamentDef& def, const Parameter& p, double delta) {
  using Kind = Parameter::Kind;
  if (p.kind == Kind::law_number) def.numbers[static_cast<std::size_t>(p.number)].value += delta;
  if (p.kind == Kind::slack_length || p.kind == Kind::reference_strain || p.kind == Kind::reference_force)
    def.rest_value += delta;
  if (p.kind == Kind::from_point) def.from.point[p.component] += delta;
  if (p.kind == Kind::to_point) def.to.point[p.component] += delta;
}

/// on_a, on_b, length, strain, force
using Shown = Eigen::Matrix<double, 15, 1>;

struct Bench {
  PlacedScene scene;
  Pose reference_A, reference_B = kReference, X_WA{exp_rotation(Vec3(-0.2, 0.1, 0.4)), Vec3(0.02, -0.01, 0.01)}, X_WB;

  /// On [a; b], in the bodies 0 and 1.
  LigamentRate rate(const LigamentDef& def, const LigamentLaw& law, const Parameter& p) const {
    JointModel::Ligament between{def.name, LigamentPath({{0, def.from.point, 0}, {1, def.to.point, 1}}), law};
    between.path.move_with({0, 1});
    const std::vector<Pose> reference{reference_A, reference_B}, poses{X_WA, X_WB};
    const Wraps none;
    return ligament_rate({def, between, reference, poses, none, none, 2}, p, {});
  }

  std::optional<LigamentLaw> made(const LigamentDef& def) const {
    std::string why;
    const double length = (reference_B * def.to.point - reference_A * def.from.point).norm();
    const auto law = make_law(def, length, why);
    if (!law) ADD_FAILURE() << why;
    return law;
  }
  Shown shown(const LigamentDef& def) const {
    TwoBodyWrench w;
    evaluate_straight_wrench(*made(def), {def.from.point, def.to.point}, X_WA, X_WB, w);
    return (Shown() << w.on_a, w.on_b, w.length, w.strain, w.force).finished();
  }
};

Bench bench(const Case& c, const std::string& rest) {
  Bench b;
  b.scene =
      test::scene_model(test::bone_on_ground() + test::ligament("l", "[10, 5, -8]", "[1, 2, 3]", c.law + rest)).scene;
  LigamentDef& def = b.scene.ligaments[0];
  def.to.point = b.reference_B.inverse() * (b.reference_A * def.from.point + kLength * Vec3(1, 2, -2) / 3);
  return b;
}

TEST(LigamentRates, AreWhatAnEditedLigamentShows) {
  double worst = 0;
  int compared = 0;
  for (const Case& c : kCases) {
    for (const char* rest : {"slack_length = 58", "reference_strain = 0.035", "reference_force = 17"}) {
      Bench b = bench(c, rest);
      const LigamentDef& def = b.scene.ligaments[0];
      const auto ligament = b.made(def);
      ASSERT_TRUE(ligament);
      const double length = c.share * ligament->slack_length();
      b.X_WB = {exp_rotation(Vec3(0.3, 0.5, -0.1)), Vec3::Zero()};
      b.X_WB.p = b.X_WA * def.from.point + length * Vec3(2, -1, 2) / 3 - b.X_WB.R * def.to.point;
      for (const Parameter& p : parameters_of(b.scene)) {
        if (!p.of_ligament()) continue;
        const LigamentRate rate = b.rate(def, *ligament, p);
        const Shown exact =
            p.change * (Shown() << (rate.wrench.size() == 0 ? Vec12(Vec12::Zero()) : Vec12(rate.wrench)), rate.length,
                        rate.strain, rate.force)
                           .finished();
        const Shown truth = derivative(
            [&](double share) {
              LigamentDef edited = def;
              edit(edited, p, share * p.change);
              return b.shown(edited);
            },
            0.01);
        for (Eigen::Index i = 0; i < 15; ++i) {
          const double scale = std::max(std::abs(truth[i]), i < 12 ? 1e-3 : 1e-6);
          const double error = std::abs(exact[i] - truth[i]) / scale;
          EXPECT_LT(error, 1e-7) << c.law << rest << " " << p.name << " " << i << ": " << exact[i] << " " << truth[i];
          worst = std::max(worst, error);
          ++compared;
        }
      }
    }
  }
  std::printf("%d derivatives, worst relative error %.2g\n", compared, worst);
  EXPECT_GT(compared, 3000);
}

TEST(LigamentRates, OfASpringWithoutLength) {
  Bench b = bench({"law = \"spring\"\nstiffness = 3\n", 1}, "slack_length = 0");
  LigamentDef& def = b.scene.ligaments[0];
  def.to.point = def.from.point;
  const auto ligament = b.made(def);
  b.X_WA = b.X_WB = Pose();  // the ends meet
  Parameter end;
  end.kind = Parameter::Kind::to_point;
  end.component = 1;
  const LigamentRate rate = b.rate(def, *ligament, end);
  EXPECT_NEAR((rate.wrench.head<3>() - 3000 * Vec3::UnitY()).norm(), 0, 1e-9);
  EXPECT_FALSE(std::isfinite(rate.length));
}

TEST(LigamentRates, AReferenceForceOfZeroHasNoDerivativeOfAFlatLaw) {
  Bench b = bench(kCases[0], "reference_force = 0");
  const LigamentDef& def = b.scene.ligaments[0];
  const auto ligament = b.made(def);
  b.X_WB = {Mat3::Identity(), b.X_WA * def.from.point + Vec3(0.07, 0, 0) - def.to.point};
  for (const Parameter& p : parameters_of(b.scene)) {
    if (!p.of_ligament()) continue;
    const LigamentRate rate = b.rate(def, *ligament, p);
    EXPECT_EQ(std::isfinite(rate.force), p.kind != Parameter::Kind::reference_force) << p.name;
  }
}

}  // namespace
}  // namespace genu
