// A looser tolerance of the solver: never slower, and nothing is lost by it.
#include "genu/study/solve_path.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "genu/study/tolerances.h"
#include "support/knee_scene.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

Solved path_with(Prepared& prepared, double tolerance) {
  prepared.scene.solver.tolerance = tolerance;
  ContactField field(prepared.model);
  return solve_path(prepared, field, {});
}

/// Forces and poses to the last bit.
bool same_rows(const Solved& a, const Solved& b) {
  return std::equal(a.records.begin(), a.records.end(), b.records.begin(), b.records.end(),
                    [](const PoseRecord& x, const PoseRecord& y) {
                      const State &s = x.point.pose.state, &t = y.point.pose.state;
                      for (std::size_t k = 0; k < s.poses.size(); ++k)
                        if (s.poses[k].p != t.poses[k].p || s.poses[k].R != t.poses[k].R) return false;
                      return x.pair_gap == y.pair_gap && s.contacts.size() == t.contacts.size();
                    });
}

void expect_no_loss(const std::string& file) {
  SCOPED_TRACE(file);
  Diagnostics out;
  auto prepared = prepare(file, out);
  ASSERT_TRUE(prepared) << test::messages(out);
  const Solved fine = path_with(*prepared, SolverDef{}.tolerance), loosest = path_with(*prepared, kLoosestTolerance);
  ASSERT_GT(fine.solved(), 10);
  for (const double tolerance : {1e-8, 1e-5, 1e-3}) {
    const Solved loose = path_with(*prepared, tolerance);
    EXPECT_EQ(loose.solved(), fine.solved());
    EXPECT_EQ(loose.events.size(), fine.events.size());
    EXPECT_LE(loose.path.iterations, fine.path.iterations);
    EXPECT_LE(loose.path.substeps, 1.02 * fine.path.substeps);
    EXPECT_LE(loose.path.worst_residual, kLoosestTolerance);
    EXPECT_TRUE(same_rows(loose, loosest));
  }
}

TEST(SolvePath, ALooserToleranceIsNeverSlower) {
  for (const char* scene : {"dortmans1984/scene", "lenhart_polynomial/scene", "joints/jaw", "joints/finger"})
    expect_no_loss(test::source_folder() + "/meshes/" + scene + ".toml");
}

TEST(SolvePath, ALooserToleranceIsNeverSlowerOnAMeasuredKneeAndItsLayers) {
  GENU_NEEDS_DATA("lenhart2015/ACLC01-R-femur-cart.stl");
  const test::TemporaryFolder folder;
  expect_no_loss(folder.write("scene.toml", test::lenhart_scene("", 0, 90, 90)));
  expect_no_loss(test::source_folder() + "/meshes/clouthier2019/mean.toml");
}

}  // namespace
}  // namespace genu
