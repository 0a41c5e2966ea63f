#include "genu/study/fit_scene.h"

#include <gtest/gtest.h>

#include "support/judged.h"
#include "support/meshed_scene.h"

namespace genu {
namespace {

TEST(FitScene, GivesTheKneeBack) {
  const test::TemporaryFolder folder;
  FitSceneRequest request;
  request.file = test::meshed_scene(folder);
  Diagnostics out;
  const auto fits = fit_scene(request, folder / "fitted", out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(fits);
  ASSERT_EQ(fits->fits.size(), 4u);
  for (const NamedFit& f : fits->fits) {
    EXPECT_FALSE(f.contacts.empty());
    EXPECT_LT(f.fit.residual.rms, 1e-5) << f.name;
  }
  const auto prepared = prepare(folder.write("fitted.toml", fits->scene), out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  ASSERT_TRUE(prepared);
  ContactField field(prepared->model);
  const Solution solution = test::judged(*prepared, solve(*prepared, field, {}));
  EXPECT_EQ(solution.summary.exit_code, kExitOk);
  for (const auto& [name, worst] : pose_differences(prepared->scene, fits->solution.poses, solution.poses)) {
    std::printf("  %-20s %.2e\n", name.c_str(), worst);
    EXPECT_LT(worst, 0.1) << name;
  }
  EXPECT_NE(fits->scene.find("[load.drawer]"), std::string::npos);
  EXPECT_EQ(fits->scene.find("shape = \"mesh\""), std::string::npos);
}

TEST(FitScene, ASceneWithoutMeshesHasNothingToFit) {
  FitSceneRequest request;
  request.file = test::kWismans;
  Diagnostics out;
  EXPECT_FALSE(fit_scene(request, "out", out));
  EXPECT_TRUE(out.has_errors());
}

}  // namespace
}  // namespace genu
