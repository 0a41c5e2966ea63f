// The published model of Lenhart et al. (2015), imported, at the 251 poses of the published passive flexion: lengths
// and forces of every ligament, areas, depths and forces of both contacts, to the digits printed.
#include <cmath>
#include <cstdio>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/study/evaluate.h"
#include "genu/study/import_model.h"
#include "support/published_knee.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

constexpr double kStraightLength = 1e-5;   // mm: half of the last digit published, 1e-8 m, and what poses leave open
constexpr double kWrappedLength = 5e-3;    // mm: OpenSim's lengths round a surface are sums over a polygon
constexpr double kStraightTension = 1e-4;  // N: a length of 1e-5 mm, times up to 10 N/mm
constexpr double kWrappedTension = 0.05;   // N: a length of 5e-3 mm, times up to 10 N/mm
constexpr double kArea = 5e-3 + 1e-9;      // mm2: half of the last digit published
constexpr double kDepth = 1e-5;            // mm
constexpr double kForce = 2e-4;            // N: the femur's vertices are in single precision in the file at hand

/// Of some fibres from the published table, at most over all poses.
struct Difference {
  int fibres = 0;
  double length = 0;   ///< mm
  double tension = 0;  ///< N
};

void raise(double& worst, double off) { worst = std::max(worst, std::isnan(off) ? INFINITY : std::abs(off)); }

class PublishedModel : public testing::Test {
 protected:
  static std::string file(const char* name) { return test::data_path(std::string("lenhart2015/") + name); }

  /// The model calls its meshes otherwise than the files at hand.
  void SetUp() override {
    GENU_NEEDS_DATA("lenhart2015/lenhart2015.osim");
    std::filesystem::create_directory(folder_ / "geometry");
    const std::pair<const char*, const char*> meshes[] = {
        {"ACLC01-R-femur-cart.stl", "lenhart2015-R-femur-cartilage.stl"},
        {"ACLC01-R-tibia-cart.stl", "lenhart2015-R-tibia-cartilage.stl"},
        {"ACLC01-R-patella-cart_shift.stl", "lenhart2015-R-patella-cartilage.stl"}};
    for (const auto& [ours, theirs] : meshes)
      std::filesystem::create_symlink(std::filesystem::absolute(file(ours)), folder_ / "geometry/" + theirs);
  }

  ImportReport import(const std::vector<std::string>& joints) {
    ModelImport asked;
    asked.model = file("lenhart2015.osim");
    asked.joints = joints;
    asked.geometry = folder_ / "geometry";
    asked.folder = folder_ / "knee";
    Diagnostics out;
    auto report = import_model(asked, out);
    EXPECT_FALSE(out.has_errors()) << to_string(out.items().front());
    return report.value_or(ImportReport());
  }

  test::TemporaryFolder folder_;
};

TEST_F(PublishedModel, GivesThePublishedResults) {
  GENU_NEEDS_DATA("lenhart2015/lenhart_passive_flexion.csv");
  const ImportReport report = import({"knee_r", "pf_r"});
  EvaluateOptions options;
  options.columns.columns = "time=t_s";
  Diagnostics out;
  Evaluation found;
  ASSERT_EQ(evaluate_scene(report.file, file("lenhart_passive_flexion.csv"), folder_ / "out", options, out, &found),
            kExitOk);
  ASSERT_EQ(found.poses.rows(), 251u);
  const test::PublishedTable published("lenhart_passive_flexion.csv"),
      ligaments("lenhart_passive_flexion_ligaments.csv");
  std::set<std::string> wraps;
  std::istringstream rows(test::read_text(file("wrapped_fibres_passive_flexion.csv")));
  for (std::string line; std::getline(rows, line);) {
    const std::size_t comma = line.find(',');
    wraps.insert(line.substr(comma + 1, line.find(',', comma + 1) - comma - 1));
  }
  Difference straight, wrapped;
  for (const auto& ligament : test::ligament_names("lenhart_passive_flexion_ligaments.csv")) {
    Difference& worst = wraps.count(ligament) > 0 ? wrapped : straight;
    ++worst.fibres;
    for (std::size_t row = 0; row < 251; ++row) {
      raise(worst.length,
            found.poses.number(row, ligament + ".length_mm") - 1e3 * ligaments.at(row, ligament + "_L_m"));
      raise(worst.tension, found.poses.number(row, ligament + ".force_N") - ligaments.at(row, ligament + "_F_N"));
    }
  }
  double area = 0, depth = 0, force = 0;
  for (const std::string name : {"tf", "pf"})
    for (std::size_t row = 0; row < 251; ++row) {
      const auto here = [&](const std::string& column) { return found.poses.number(row, name + "_contact." + column); };
      area = std::max(area, std::abs(here("area_mm2") - 1e6 * published.at(row, name + "_contact_area_m2")));
      depth = std::max(depth, std::abs(here("max_depth_mm") - 1e3 * published.at(row, name + "_max_prox_m")));
      for (const std::string axis : {"x", "y", "z"})
        force = std::max(force, std::abs(here("force_" + axis + "_N") - published.at(row, name + "_F" + axis)));
    }
  std::printf(
      "fibres: %d straight %.2g mm %.2g N, %d wrapped %.2g mm %.2g N; contact: area %.4g mm2, depth %.2g mm, force "
      "%.2g N\n",
      straight.fibres, straight.length, straight.tension, wrapped.fibres, wrapped.length, wrapped.tension, area, depth,
      force);
  EXPECT_EQ(straight.fibres, 56);
  EXPECT_EQ(wrapped.fibres, 19);
  EXPECT_LT(straight.length, kStraightLength);
  EXPECT_LT(wrapped.length, kWrappedLength);
  EXPECT_LT(straight.tension, kStraightTension);
  EXPECT_LT(wrapped.tension, kWrappedTension);
  EXPECT_LT(area, kArea);
  EXPECT_LT(depth, kDepth);
  EXPECT_LT(force, kForce);
}

TEST_F(PublishedModel, IsCarriedAsFarAsItIsSaid) {
  const ImportReport report = import({"knee_r", "pf_r"});
  std::string text;
  for (const std::string& line : report.scene.summary) text += line + "\n";
  for (const char* line : {"kept       76 Blankevoort1991Ligament", "kept        2 Smith2018ArticularContactForce",
                           "kept       13 Millard2012EquilibriumMuscle", "left out   31 Millard2012EquilibriumMuscle",
                           "kept        2 Body", "frozen     22 Body", "frozen      2 WeldJoint",
                           "frozen     21 CustomJoint", "left out   12 SpringGeneralizedForce", "left out   39 Marker"})
    EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
}

/// Only the knee: the patella is frozen on the femur with its cartilage and ligaments.
TEST_F(PublishedModel, FreezesThePatellaWhereItIsNotAskedFor) {
  const ImportReport report = import({"knee_r"});
  EXPECT_EQ(report.scene.bodies, (std::vector<std::string>{"femur_distal_r", "tibia_proximal_r"}));
  const std::string text = test::read_text(report.file);
  EXPECT_EQ(text.find("pf_contact"), std::string::npos);
  EXPECT_EQ(text.find("lPFL1"), std::string::npos);  // from femur to patella
  EXPECT_NE(text.find("[ligament.PT1]"), std::string::npos);
}

}  // namespace
}  // namespace genu
