// A knee made of meshes approaches the same knee in closed form with the order that its surfaces promise.
//
// GENU_ACCURACY_TABLE=FILE writes the tables there as well (tools/accuracy-table).
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "accuracy_table.h"
#include "mesh_study.h"
#include "support/places.h"

namespace genu {
namespace {

using test::MeshRoute;
using test::MeshStudy;
using test::MeshStudyOptions;
using test::MeshStudyRow;

// A blend of degree 3 promises order 4 in position; what is left is for the fit over four lengths.
constexpr double kOrder = 3.5;
const std::vector<double> kEdges{1.4e-3, 1.0e-3, 0.7e-3, 0.5e-3};  // m

struct Study {
  std::vector<MeshStudyRow> rows;
  double position = 0, rotation = 0, force = 0;  ///< observed orders
};

Study run(const MeshStudy& knee, const MeshStudyOptions& options) {
  Study study;
  for (const double edge : kEdges) study.rows.push_back(knee.measure(edge, options));
  study.position = test::observed_order(study.rows, [](const MeshStudyRow& r) { return r.position_error; });
  study.rotation = test::observed_order(study.rows, [](const MeshStudyRow& r) { return r.rotation_error; });
  study.force = test::observed_order(study.rows, [](const MeshStudyRow& r) { return r.force_error; });
  return study;
}

/// A table in Markdown.
std::string to_table(const Study& study) {
  std::string out =
      "| edge mm | triangles a torus | position mm | rotation deg | contact force N | build s | ms a pose |\n"
      "|---:|---:|---:|---:|---:|---:|---:|\n";
  for (const MeshStudyRow& r : study.rows)
    out += fmt::format("| {:.2f} | {} | {:.2e} | {:.2e} | {:.2e} | {:.2f} | {:.2f} |\n", 1e3 * r.edge, r.triangles,
                       1e3 * r.position_error, r.rotation_error / units::kDegree, r.force_error, r.build_seconds,
                       1e3 * r.pose_seconds);
  return out + fmt::format("| observed order | | {:.1f} | {:.1f} | {:.1f} | | |\n", study.position, study.rotation,
                           study.force);
}

const MeshStudy& knee() {
  static const MeshStudy study(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  return study;
}

void expect_order(const std::string& title, const MeshStudyOptions& options) {
  ASSERT_TRUE(knee().good());
  const Study study = run(knee(), options);
  test::write_down(title, to_table(study));
  for (const MeshStudyRow& r : study.rows) EXPECT_EQ(r.failure, "") << "edge " << 1e3 * r.edge << " mm";
  EXPECT_GE(study.position, kOrder);
}

TEST(MeshConvergence, ToriFromFiles) {
  expect_order("Tori from STL files on planes in closed form, default options", {});
}

TEST(MeshConvergence, ToriInMemory) {
  expect_order("The same tori without the STL's single precision", {MeshRoute::memory, false, 3});
}

TEST(MeshConvergence, ToriAndPlanesFromFiles) {
  expect_order("Tori and planes from STL files", {MeshRoute::file, true, 3});
}

}  // namespace
}  // namespace genu
