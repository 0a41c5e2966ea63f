// A looser tolerance of the solver: never slower, and nothing is lost by it.
#include "genu/study/solve_path.h"

#include <memory>
#include <stdexcept>

#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "genu/scene/tolerances.h"
#include "support/knee_scene.h"
#include "support/places.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

Solved path_with(const std::string& file, const std::string& tolerance) {
  Diagnostics out;
  auto scene = parse_scene(test::read_file(file) + "\n[solver]\ntolerance = " + tolerance + "\n", file, out);
  if (!scene) throw std::runtime_error(test::messages(out));
  auto prepared = prepare(std::move(*scene), std::make_shared<MeshLibrary>(), out);
  if (!prepared) throw std::runtime_error(test::messages(out));
  ContactField field(prepared->model);
  return solve_path(*prepared, field, {});
}

void expect_no_loss(const std::string& file) {
  SCOPED_TRACE(file);
  const Solved fine = path_with(file, "1e-12"), loose = path_with(file, "1e-3");
  ASSERT_GT(fine.solved(), 10);
  EXPECT_EQ(loose.solved(), fine.solved());
  EXPECT_EQ(loose.events.size(), fine.events.size());
  EXPECT_LE(loose.path.iterations, fine.path.iterations);
  EXPECT_LE(loose.path.substeps, 1.02 * fine.path.substeps);
  EXPECT_LE(loose.path.worst_residual, kLoosestSolverTolerance);
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
