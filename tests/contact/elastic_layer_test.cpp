// From the sum in the casting body's axes to both bodies in the world.
#include "genu/contact/elastic_layer.h"

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

const LayerLaw kLaw{LayerLaw::Kind::linear, 38e6};

ElasticLayer ball_on_sheet(bool ball_casts, double damping = 0) {
  const Mesh ball = test::ball(0.02, 1.2e-3), sheet = test::sheet(0.02, 31);
  const auto target = std::make_shared<TriangleTree>(ball_casts ? sheet : ball);
  return ElasticLayer(
      {{ball_casts, 1.0,
        std::make_shared<TriangleLayer>(ball_casts ? ball : sheet, target, 5e-3, kLaw, LayerThickness{6e-3, {}, {}})}},
      {}, damping);
}

const Pose kBall{exp_rotation({0.5, -0.3, 0.2}), {0.1, -0.05, 0.2}};
/// The sheet where the ball overlaps it by about a millimetre.
Pose sheet_under() {
  const Pose X_sheet_ball{exp_rotation({0.1, -0.05, 0.3}), {1e-3, 2e-3, 0.0189}};
  return kBall * X_sheet_ball.inverse();
}

TEST(ElasticLayer, ActionAndReaction) {
  for (const bool ball_casts : {true, false}) {
    LayerWrench out;
    ElasticLayer::Memory memory;
    const Pose X_b = sheet_under();
    ball_on_sheet(ball_casts).evaluate(kBall, X_b, memory, out);
    const Vec3 on_a = out.wrench.segment<3>(0), on_b = out.wrench.segment<3>(6);
    EXPECT_GT(on_a.norm(), 100);
    EXPECT_LT((on_a + on_b).norm(), 1e-12 * on_a.norm());
    const Vec3 moment = out.wrench.segment<3>(3) + kBall.p.cross(on_a) + out.wrench.segment<3>(9) + X_b.p.cross(on_b);
    EXPECT_LT(moment.norm(), 1e-12 * on_a.norm());
    EXPECT_GT((X_b.R * Vec3::UnitZ()).dot(on_a), 0) << "the sheet pushes the ball out";
  }
}

TEST(ElasticLayer, StiffnessIsTheDerivativeToBothTwists) {
  for (const bool ball_casts : {true, false}) {
    const ElasticLayer layer = ball_on_sheet(ball_casts);
    const Pose poses[] = {kBall, sheet_under()};
    LayerWrench here;
    ElasticLayer::Memory memory;
    layer.evaluate(poses[0], poses[1], memory, here);
    double worst = 0;
    for (int i = 0; i < 12; ++i) {
      Vec6 twist = Vec6::Zero();
      twist[i % 6] = i % 6 < 3 ? 1e-8 : 5e-7;
      LayerWrench side[2];
      for (int s = 0; s < 2; ++s) {
        Pose moved[] = {poses[0], poses[1]};
        moved[i / 6] = retract(moved[i / 6], s == 0 ? twist : Vec6(-twist));
        layer.evaluate(moved[0], moved[1], memory, side[s]);
      }
      const Vec12 expected = (side[0].wrench - side[1].wrench) / (2 * twist[i % 6]);
      worst = std::max(worst, (here.stiffness.col(i) - expected).norm() / expected.norm());
    }
    EXPECT_LT(worst, 2e-5);
  }
}

TEST(ElasticLayer, BothTogetherTurnNothing) {
  // A motion of both bodies as one turns the wrenches with them and changes nothing else.
  LayerWrench here;
  ElasticLayer::Memory memory;
  const Pose X_b = sheet_under();
  ball_on_sheet(true).evaluate(kBall, X_b, memory, here);
  const Vec3 w(0.3, -0.2, 0.5), v(1, 2, -1);
  Vec12 twists;
  twists << v + w.cross(kBall.p), w, v + w.cross(X_b.p), w;
  Vec12 expected;
  for (int i = 0; i < 4; ++i) expected.segment<3>(3 * i) = w.cross(here.wrench.segment<3>(3 * i));
  EXPECT_LT((here.stiffness * twists - expected).norm(), 1e-9 * (here.stiffness.cwiseAbs() * twists.cwiseAbs()).norm());
}

Vec12 some_twists() { return (Vec12() << 0.1, -0.2, -0.3, 2, 1, -1, 0.05, 0.1, 0.02, 0.3, -0.5, 0.4).finished(); }

/// Every ray looked for at two moments beside each other: p (1 + c d') of what that tells of d'.
TEST(ElasticLayer, DampsByHowFastDepthsGrow) {
  constexpr double kDamping = 0.7, kStep = 1e-6;
  const Mesh ball = test::ball(0.02, 1.2e-3), sheet = test::sheet(0.02, 31);
  const auto at_time = [&](double t) {
    const Vec12 v = t * some_twists();
    return retract(sheet_under(), Vec6(v.tail<6>())).inverse() * retract(kBall, Vec6(v.head<6>()));
  };
  Vec6 expected = Vec6::Zero();
  for (const auto& t : ball.triangles) {
    const auto v = [&](std::size_t i) -> const Vec3& { return ball.vertices[static_cast<std::size_t>(t[i])]; };
    const Vec3 area = 0.5 * (v(1) - v(0)).cross(v(2) - v(0)), x = (v(0) + v(1) + v(2)) / 3;
    double d[3];
    int k = 0;
    for (const double time : {0.0, kStep, -kStep}) {
      const Pose X = at_time(time);
      d[k++] = test::leaving_by_all(sheet, X * x, -(X.R * area.normalized()), 5e-3).distance;
    }
    if (d[0] == 0 || d[1] == 0 || d[2] == 0) continue;
    const Vec3 force = -kLaw.at(d[0], 6e-3).p * std::max(0.0, 1 + kDamping * (d[1] - d[2]) / (2 * kStep)) * area;
    expected.head<3>() += force;
    expected.tail<3>() += x.cross(force);
  }
  LayerWrench out, still;
  ElasticLayer::Memory memory;
  const Vec12 twists = some_twists(), none = Vec12::Zero();
  const ElasticLayer layer = ball_on_sheet(true, kDamping);
  layer.evaluate(kBall, sheet_under(), memory, out, 0, &twists);
  EXPECT_LT((kBall.R.transpose() * out.wrench.head<3>() - expected.head<3>()).norm(), 1e-6 * expected.norm());
  EXPECT_LT((kBall.R.transpose() * out.wrench.segment<3>(3) - expected.tail<3>()).norm(), 1e-6 * expected.norm());
  layer.evaluate(kBall, sheet_under(), memory, still, 0, &none);
  EXPECT_EQ(still.damped, 0);
  EXPECT_NEAR(out.damped, -(out.wrench - still.wrench).dot(twists), 1e-12 * out.damped);
  EXPECT_GT(out.damped, 0);
}

TEST(ElasticLayer, NeverPullsHoweverFastItIsLeft) {
  Vec12 away = Vec12::Zero();
  away.tail<6>().head<3>() = -(sheet_under().R * Vec3::UnitZ());  // 1 m/s
  for (const bool ball_casts : {true, false}) {
    LayerWrench out;
    ElasticLayer::Memory memory;
    ball_on_sheet(ball_casts, 10).evaluate(kBall, sheet_under(), memory, out, 0, &away);
    EXPECT_EQ(out.wrench.norm(), 0);
    EXPECT_GT(out.damped, 0) << "what the layer had stored is lost";
  }
}

}  // namespace
}  // namespace genu
