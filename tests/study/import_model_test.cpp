#include "genu/study/import_model.h"

#include <gtest/gtest.h>

#include "genu/study/evaluate.h"
#include "support/places.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

class ImportsTheLeg : public testing::Test {
 protected:
  static std::string model() { return test::source_folder() + "/tests/osim/model/leg.osim"; }
  ModelImport asked() const {
    ModelImport import;
    import.model = model();
    import.joints = {"knee_r"};
    import.folder = folder_ / "leg";
    return import;
  }
  /// What is said where an import is refused; nothing may be written.
  std::string refused(const ModelImport& import) {
    Diagnostics out;
    EXPECT_FALSE(import_model(import, out).has_value());
    EXPECT_TRUE(out.has_errors());
    EXPECT_FALSE(fs::exists(folder_ / "leg"));
    std::string text;
    for (const Diagnostic& d : out.items()) text += to_string(d) + "\n";
    return text;
  }
  std::string written(const ModelImport& import) {
    Diagnostics out;
    const auto report = import_model(import, out);
    EXPECT_TRUE(report.has_value()) << (out.items().empty() ? "" : to_string(out.items().front()));
    return report ? test::read_file(report->file) : "";
  }
  test::TemporaryFolder folder_;
};

TEST_F(ImportsTheLeg, IntoASceneThatCanBeEvaluated) {
  const std::string text = written(asked());
  EXPECT_TRUE(test::contains(text, "Geometry/condyle.obj"));
  EXPECT_TRUE(fs::exists(folder_ / "leg/import.csv"));
  const std::string poses = folder_.write(
      "poses.sto",
      "poses\nversion=1\nnRows=2\nnColumns=7\ninDegrees=no\nendheader\ntime\t/jointset/knee_r/knee_flex_r/value\t"
      "/jointset/knee_r/knee_add_r/value\t/jointset/knee_r/knee_rot_r/value\t/jointset/knee_r/knee_tx_r/value\t"
      "/jointset/knee_r/knee_ty_r/value\t/jointset/knee_r/knee_tz_r/"
      "value\n0\t0\t0\t0\t0\t0\t0\n1\t0.1\t0\t0\t0\t0.001\t0\n");
  Diagnostics out;
  Evaluation found;
  EXPECT_EQ(evaluate_scene(folder_ / "leg/scene.toml", poses, folder_ / "out", {}, out, &found), kExitOk)
      << (out.items().empty() ? "" : to_string(out.items().front()));
  ASSERT_EQ(found.poses.rows(), 2u);
  // By hand: from (0, 0, 35) to (-10, -70, 35) mm.
  EXPECT_NEAR(found.poses.number(0, "LCL1.length_mm"), std::hypot(10.0, 70.0), 1e-9);
  // The plateau is 29 mm below, the condyle's lowest vertex 30, those beside it 34/12 mm away on its sphere. The
  // deepest ray starts at a third of a square of 50/12 mm, nearly amid two of them. The file has whole um.
  const double beside = std::sqrt(30 * 30 - 34.0 / 12 * 34 / 12) - 29, share = (50.0 / 36) / (34.0 / 24);
  EXPECT_NEAR(found.poses.number(0, "tf_contact.max_depth_mm"), 1 - share + share * beside, 2e-4);
}

TEST_F(ImportsTheLeg, AtThePoseOfARow) {
  ModelImport import = asked();
  import.pose =
      folder_.write("states.sto",
                    "states\ninDegrees=yes\nendheader\ntime\t/jointset/hip_r/hip_flex_r/value\t"
                    "/jointset/hip_r/hip_flex_r/speed\tknee_flex_r\tknee_ty_r\n0\t0\t5\t0\t0\n1\t90\t5\t20\t0.002\n");
  import.row = 2;
  const std::string text = written(import);
  EXPECT_TRUE(test::contains(text, "gravity = [-9.81, 0, 0]")) << text.substr(0, 900);
  EXPECT_TRUE(test::contains(text, "reference = { flex = 20, tx = 1, ty = 2 }"));
}

TEST_F(ImportsTheLeg, WithTheTensionsOfARow) {
  ModelImport import = asked();
  import.forces = folder_.write(
      "forces.sto", "forces\nendheader\ntime\thamstring\t/forceset/gastrocnemius/actuation\tother\n0\t12.5\t-3\t1\n");
  const std::string text = written(import);
  EXPECT_TRUE(test::contains(text, "magnitude = 12.5"));
  EXPECT_TRUE(test::contains(text, "magnitude = 0"));
}

TEST_F(ImportsTheLeg, AtOneMomentOfBothFiles) {
  ModelImport import = asked();
  import.pose = folder_.write("states.sto", "s\nendheader\ntime\thip_flex_r\n0\t0\n0.01\t0.1\n");
  import.forces = folder_.write("forces.sto", "f\nendheader\ntime\thamstring\n5\t10\n0.0100000001\t-20\n");
  const std::string text = refused(import);
  EXPECT_TRUE(test::contains(text, "forces.sto:4:1: time = 5: is not the time of row 1 of " + import.pose + ", 0"))
      << text;
  import.row = 2;
  EXPECT_TRUE(test::contains(written(import), "[load.hamstring]"));
  EXPECT_TRUE(test::contains(test::read_file(folder_ / "leg/import.csv"), "WARNING: it would push with 20 N"));
}

TEST_F(ImportsTheLeg, OnlyWhereNothingIs) {
  fs::create_directory(folder_ / "leg");
  folder_.write("leg/notes.txt", "mine");
  Diagnostics out;
  EXPECT_FALSE(import_model(asked(), out).has_value());
  EXPECT_TRUE(out.has_errors());
  EXPECT_EQ(test::read_file(folder_ / "leg/notes.txt"), "mine");
  EXPECT_TRUE(test::contains(to_string(out.items().front()), "leg: has content, so it will not be replaced"));
}

TEST_F(ImportsTheLeg, UnlessMeshesAreMissing) {
  ModelImport import = asked();
  import.model = folder_.write("leg.osim", test::read_file(model()));
  import.geometry = folder_ / "elsewhere";
  const std::string text = refused(import);
  for (const char* file : {"condyle.obj", "condyle-bone.obj", "plateau.obj"}) {
    EXPECT_TRUE(test::contains(text, folder_ / "elsewhere/" + file)) << text;
    EXPECT_TRUE(test::contains(text, folder_ / "Geometry/" + file)) << text;
  }
  EXPECT_FALSE(test::contains(text, "never-looked-for.vtp"));
  // A folder of links, as model libraries have them.
  fs::create_directory(folder_ / "elsewhere");
  for (const char* file : {"condyle.obj", "condyle-bone.obj", "plateau.obj"})
    fs::create_symlink(test::source_folder() + "/tests/osim/model/Geometry/" + file, folder_ / "elsewhere/" + file);
  EXPECT_TRUE(test::contains(written(import), "condyle-bone.obj"));
}

TEST_F(ImportsTheLeg, UnlessMeshesAreStretched) {
  std::string text = test::read_file(model());
  text.replace(text.rfind("<scale_factors>1 1 1"), 20, "<scale_factors>1 1 2");
  ModelImport import = asked();
  import.model = folder_.write("leg.osim", text);
  import.geometry = test::source_folder() + "/tests/osim/model/Geometry";
  EXPECT_TRUE(test::contains(refused(import), "stretched by scale_factors"));
}

TEST_F(ImportsTheLeg, UnlessATableIsWrong) {
  ModelImport import = asked();
  import.pose = folder_.write("states.sto", "s\nendheader\ntime\thip_flex_r\n0\t1\n");
  import.row = 2;
  EXPECT_TRUE(test::contains(refused(import), "--row = 2: must be a row of"));
  import.row = 0;
  EXPECT_TRUE(test::contains(refused(import), "--row = 0"));
  import.row = 1;
  import.pose = folder_.write("nan.sto", "s\nendheader\ntime\thip_flex_r\n0\tnan\n");
  EXPECT_TRUE(test::contains(refused(import), "nan.sto:4:3: hip_flex_r = nan: is no finite number"));
  import.pose = folder_.write("other.sto", "s\nendheader\ntime\telbow\n0\t1\n");
  EXPECT_TRUE(test::contains(refused(import), "has no column that is a coordinate of"));
  import.pose = folder_ / "nowhere.sto";
  EXPECT_FALSE(refused(import).empty());
  import.pose.clear();
  import.forces = folder_.write("none.sto", "s\nendheader\ntime\telbow\n0\t1\n");
  EXPECT_TRUE(test::contains(refused(import), "has no column that is a muscle of"));
}

}  // namespace
}  // namespace genu
