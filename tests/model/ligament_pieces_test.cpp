// Lengths over via points, and the piece of its law a ligament is on.
#include "genu/model/ligament_pieces.h"

#include <gtest/gtest.h>

#include "genu/model/linearization.h"
#include "support/scene_model.h"

namespace genu {
namespace {

const std::string kAbdel =
    "law = \"abdel-rahman\"\nstiffness = 5\ntoe_stiffness = 0.25\ntransition_strain = 0.5\nslack_length = 16";

test::SceneModel ropes() {
  return test::scene_model(
      test::bone_on_ground("{ z = 10 }") + test::spring("s", "[0, 0, 0]", "[0, 0, -20]", 1, 20) +
      test::ligament("jump", "[0, 0, 0]", "[0, 0, -20]", kAbdel) +
      test::ligament("over", "[0, 0, 0]", "[30, 0, 0]",
                     "via = [{ body = \"ground\", point = [0, 0, 40] }, { body = \"ground\", "
                     "point = [30, 0, 40] }]\nlaw = \"linear\"\nstiffness = 1000\nreference_strain "
                     "= 0.25"));
}

TEST(LigamentPieces, LengthIsTheSumOfAllLines) {
  const test::SceneModel s = ropes();
  EXPECT_NEAR(s.model.ligaments[2].path.length(s.model.reference_poses), 0.03 + 0.03 + 0.04, 1e-16);
  EXPECT_NEAR(s.model.ligaments[2].law.slack_length(), 0.1 / 1.25, 1e-16) << "reference_strain means the whole";
  const LigamentShown shown = show_ligament(s.model, reference_state(s.model), 2);
  EXPECT_NEAR(shown.force, 250, 1e-11);
  EXPECT_NEAR(shown.strain, 0.25, 1e-15);
}

TEST(LigamentPieces, LengthRateIsTheLengthsDerivative) {
  const test::SceneModel s = ropes();
  State state = reference_state(s.model);
  const Vec6 tilt = (Vec6() << 2e-3, -1e-3, 3e-3, 0.3, -0.2, 0.1).finished();
  state.poses[1] = retract(state.poses[1], tilt);
  VecX twist(6);
  twist << 0.3, -0.5, 0.7, 1.1, -0.9, 0.4;
  double worst = 0;
  for (const auto& l : s.model.ligaments) {
    const auto length = [&](double h) {
      std::vector<Pose> poses = state.poses;
      poses[1] = retract(poses[1], Vec6(h * twist));
      return l.path.length(poses);
    };
    const double h = 1e-6, difference = (length(h) - length(-h)) / (2 * h);
    worst = std::max(worst, std::abs(l.path.length_rate(state.poses, twist) - difference));
  }
  EXPECT_LT(worst, 1e-9);
}

TEST(LigamentPieces, StartWhereTheirLengthsAre) {
  const test::SceneModel s = ropes();
  State state = reference_state(s.model);
  ASSERT_EQ(state.pieces.size(), 2u) << "a spring has none";
  EXPECT_EQ(state.pieces[0].ligament, 1);
  EXPECT_EQ(state.pieces[0].piece, 1) << "30 mm, past 24; the toe's beginning parts no pieces";
  EXPECT_EQ(state.pieces[1].piece, 1);
  // The rope over the pulleys is less than its 80 mm now.
  state.poses[1].p.z() = 0.0301;
  follow_lengths(s.model, state);
  EXPECT_FALSE(state.pieces[0].by_length) << "a law that jumps keeps to its piece";
  EXPECT_TRUE(state.pieces[1].by_length);
  EXPECT_TRUE(fix_pieces(s.model, state));
  EXPECT_FALSE(fix_pieces(s.model, state));
  EXPECT_EQ(state.pieces[1].piece, 0);
}

TEST(LigamentPieces, AHeldOneShowsItsMultiplier) {
  const test::SceneModel s = ropes();
  State state = reference_state(s.model);
  state.pieces[0] = {1, 0, true, false, 18};
  EXPECT_EQ(held_count(state), 1);
  EXPECT_EQ(show_ligament(s.model, state, 1).force, 18);
  EXPECT_EQ(describe_break(s.model, 1, 0), "jump at 24 mm, 16 N below and 20 N above");
}

TEST(LigamentPieces, ChainWrenchIsTheTensionAlongItsOuterLines) {
  const test::SceneModel s = ropes();
  Linearization at;
  State state = reference_state(s.model);
  Target target = test::target_of(s.scene);
  linearize(s.model, state, target, at);
  // Down: the spring 10 N and `jump` 5 N/mm * (30 - 20) mm; up: the rope's 250 N, whose other lines do not move.
  EXPECT_LT((at.wrench.head<3>() - Vec3(0, 0, 250 - 10 - 50)).norm(), 1e-10);
  EXPECT_NEAR(at.stiffness(2, 2), -(1e3 + 5e3 + 1000 / 0.08), 1e-8);
  EXPECT_NEAR(at.stiffness(0, 0), -(10 / 0.03 + 50 / 0.03 + 250 / 0.03), 1e-8);
}

}  // namespace
}  // namespace genu
