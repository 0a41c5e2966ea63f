// The stability of many bodies beside all eigenvalues of the dense stiffness.
#include "genu/equilibrium/stability_by_blocks.h"

#include <gtest/gtest.h>
#include <Eigen/Dense>

#include "support/solved.h"

namespace genu {
namespace {

/// Bodies in a chain on bushings; `more` of the last one's load and of steps.
std::string chain(int n, const std::string& more) {
  std::string text = "format = 1\nunits = { length = \"mm\", angle = \"deg\" }\n[body.b0]\nfixed = true\n";
  for (int i = 1; i <= n; ++i) {
    const std::string k = std::to_string(i), before = std::to_string(i - 1);
    text +=
        "[body.b" + k + "]\n[joint.j" + k + "]\ntype = \"free\"\nparent = \"b" + before + "\"\nchild = \"b" + k +
        "\"\nrotations = [\"a z\", \"b x\", \"c y\"]\ntranslations = [\"x\", \"y\", \"z\"]\nreference = { x = 5 }\n" +
        "[bushing.k" + k + "]\nfrom = { body = \"b" + before + "\" }\nto = { body = \"b" + k +
        "\" }\nstiffness = [300, 100, 100]\nrotation_stiffness = [0.1, 0.2, 0.3]\n";
  }
  return text + more;
}

std::string pull(int n, const std::string& force) {
  return "[load.pull]\nbody = \"b" + std::to_string(n) + "\"\nforce = " + force +
         "\n[[step]]\nload = { pull = [0, 1] }\nincrements = 2\n";
}

/// At the last pose of a path.
struct SolvedChain {
  test::SceneModel scene;
  test::Followed path;
  Linearization at;

  explicit SolvedChain(const std::string& text) : scene(test::scene_model(text)), path(test::follow(scene)) {
    EXPECT_TRUE(path.result.complete) << path.story();
    linearize(scene.model, path.points.back().pose.state, path.points.back().target, at);
  }
  double length() const { return scene.model.scales.length; }
};

TEST(StabilityByBlocks, GivesTheSmallestOfAllEigenvalues) {
  for (const char* step : {"", "prescribe = { \"j7.a\" = 0.5, \"j12.b\" = 0.1 }\n"}) {
    const SolvedChain s(chain(14, pull(14, "[0, 0.1, 0.05]") + step));
    const auto found = stable_by_blocks(s.at, s.length());
    ASSERT_TRUE(found);
    const FreeStiffness free = free_stiffness(s.at, s.length());
    const MatX K = free.basis.transpose() * free.stiffness * free.basis;
    const Eigen::SelfAdjointEigenSolver<MatX> all((K + K.transpose()) / 2);
    EXPECT_NEAR(found->smallest / all.eigenvalues()[0], 1, 1e-9);
    EXPECT_EQ(found->free_motions, free.basis.cols());
    const VecX mode = free.basis * all.eigenvectors().col(0);
    EXPECT_NEAR(std::abs(found->mode.dot(mode)), 1, 1e-9);
    EXPECT_EQ(found->verdict, Stability::Verdict::stable);
    EXPECT_EQ(found->neutral.cols(), 0);
    EXPECT_TRUE(found->redundant.empty());
  }
}

TEST(StabilityByBlocks, SaysNothingOfOtherPoses) {
  const std::string free_body =
      "[body.c]\n[joint.c]\ntype = \"free\"\nparent = \"b0\"\nchild = \"c\"\nrotations = [\"a z\", \"b x\", \"c y\"]\n"
      "translations = [\"x\", \"y\", \"z\"]\n";
  const auto s = test::scene_model(chain(12, free_body));
  Linearization at;
  linearize(s.model, reference_state(s.model), test::target_of(s.scene), at);
  EXPECT_FALSE(stable_by_blocks(at, s.model.scales.length)) << "a body that nothing holds";
  const Stability dense = assess_stability(at, s.model.scales.length);
  EXPECT_EQ(dense.verdict, Stability::Verdict::neutral);
  EXPECT_EQ(dense.neutral.cols(), 6);

  // A column under more than its buckling load.
  const auto column = test::scene_model(chain(12, "[load.push]\nbody = \"b12\"\nforce = [-60, 0, 0]\n"));
  State state = reference_state(column.model);
  Newton newton(column.model);
  ASSERT_TRUE(newton.solve(state, test::target_of(column.scene), {}).converged());
  EXPECT_FALSE(stable_by_blocks(newton.linearization(), column.model.scales.length));
  EXPECT_EQ(assess_stability(newton.linearization(), column.model.scales.length).verdict, Stability::Verdict::unstable);
}

TEST(StabilityByBlocks, LoadsWithoutAPotentialAreLeftToAllEigenvalues) {
  const SolvedChain s(chain(12, "[load.follower]\nbody = \"b12\"\nframe = \"body\"\nforce = [0, 0.2, 0]\n"));
  EXPECT_FALSE(stable_by_blocks(s.at, s.length()));
}

}  // namespace
}  // namespace genu
