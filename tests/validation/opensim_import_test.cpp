// The published model of Lenhart et al. (2015), imported, at the 251 poses of the published passive flexion: lengths
// and forces of every ligament, areas, depths and forces of both contacts, to the digits printed.
#include <cmath>
#include <cstdio>
#include <regex>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/study/evaluate.h"
#include "genu/study/export_model.h"
#include "genu/study/import_model.h"
#include "genu/study/run_scene.h"
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

/// The imported scene with what the rest of the model exerts: loads and steps of scene-published-flexion.toml, whose
/// tables hold weights, muscles and the iliotibial tract too (ITB1 of the import is left out).
std::string with_published_loads(const std::string& imported) {
  std::string text = std::regex_replace(imported, std::regex("\n(gravity|mass|centre_of_mass) = [^\n]*"), "");
  const auto started = [&](const std::string& joint, const std::string& start) {
    const std::size_t axes = text.find("translations", text.find("[joint." + joint + "]"));
    text.insert(text.find('\n', axes) + 1, "start = { " + start + " }\n");
  };
  started("knee_r", "add = -0.16, rot = -0.23, tx = 2.09, ty = 0.41, tz = -0.33");
  started("pf_r", "flex = 9.4, rot = 0.6, tilt = -3.7, tx = 53.1, ty = 8.57, tz = 4.93");
  const std::string published =
      test::read_text(test::source_folder() + "/meshes/lenhart2015_whole/scene-published-flexion.toml");
  std::string loads = published.substr(published.find("[load.tibia_force_x]"));
  for (const auto& [ours, theirs] : {std::pair("\"knee\\.flexion\"", "\"knee_r.flex\""),
                                     std::pair("body = \"tibia\"", "body = \"tibia_proximal_r\""),
                                     std::pair("body = \"patella\"", "body = \"patella_r\"")})
    loads = std::regex_replace(loads, std::regex(ours), theirs);
  return text.substr(0, text.find("[[step]]")) + loads;
}

TEST_F(PublishedModel, RunsThroughThePublishedPoses) {
  GENU_NEEDS_DATA("lenhart2015/whole_knee_passive_flexion.csv");
  const ImportReport report = import({"knee_r", "pf_r"});
  const std::string scene = folder_.write("knee/run.toml", with_published_loads(test::read_text(report.file)));
  SceneChanges changes;
  changes.without = {"ITB1"};
  Diagnostics out;
  const auto prepared = prepare(SceneSource(scene, changes), out);
  ASSERT_TRUE(prepared.has_value()) << to_string(out.items().front());
  const auto solution = solve_all(*prepared, {}, out);
  ASSERT_TRUE(solution.has_value());
  const test::PublishedTable published("whole_knee_passive_flexion.csv");
  const std::pair<const char*, const char*> kAngles[] = {{"knee_r.add_deg", "knee.adduction_deg"},
                                                         {"knee_r.rot_deg", "knee.rotation_deg"},
                                                         {"pf_r.flex_deg", "pf.flexion_deg"},
                                                         {"pf_r.rot_deg", "pf.rotation_deg"},
                                                         {"pf_r.tilt_deg", "pf.tilt_deg"}},
                                            kPlaces[] = {{"knee_r.tx_mm", "knee.x_mm"}, {"knee_r.ty_mm", "knee.y_mm"},
                                                         {"knee_r.tz_mm", "knee.z_mm"}, {"pf_r.tx_mm", "pf.x_mm"},
                                                         {"pf_r.ty_mm", "pf.y_mm"},     {"pf_r.tz_mm", "pf.z_mm"}};
  ASSERT_EQ(solution->poses.rows(), published.rows());
  double angle = 0, place = 0;
  for (std::size_t row = 0; row < published.rows(); ++row) {
    for (const auto& [ours, theirs] : kAngles)
      raise(angle, solution->poses.number(row, ours) - published.at(row, theirs));
    for (const auto& [ours, theirs] : kPlaces)
      raise(place, solution->poses.number(row, ours) - published.at(row, theirs));
  }
  std::printf("41 poses solved: largest difference %.3f deg, %.3f mm\n", angle, place);
  EXPECT_LT(angle, 0.5);
  EXPECT_LT(place, 0.2);
}

TEST_F(PublishedModel, ComesBackThroughExport) {
  const ImportReport report = import({"knee_r", "pf_r"});
  Diagnostics out;
  const auto exported = export_model({report.file, folder_ / "again", "", ""}, out);
  ASSERT_TRUE(exported.has_value()) << to_string(out.items().front());
  ModelImport asked;
  asked.model = exported->file;
  asked.joints = exported->model.joints;
  asked.folder = folder_ / "knee2";
  const auto back = import_model(asked, out);
  ASSERT_TRUE(back.has_value()) << to_string(out.items().front());
  EvaluateOptions options;
  options.columns.columns = "time=t_s";
  const auto evaluated = [&](const std::string& scene, const char* name) {
    Evaluation found;
    EXPECT_EQ(evaluate_scene(scene, file("lenhart_passive_flexion.csv"), folder_ / name, options, out, &found),
              kExitOk);
    return found.poses;
  };
  const ResultTable first = evaluated(report.file, "out1"), second = evaluated(back->file, "out2");
  ASSERT_EQ(first.columns().size(), second.columns().size());
  double length = 0, tension = 0, area = 0, force = 0;
  for (const std::string& column : first.columns()) {
    const bool force_column = column.ends_with("_N"), contact_column = column.find("_contact.") != std::string::npos;
    double* const worst = column.ends_with(".length_mm")  ? &length
                          : column.ends_with(".area_mm2") ? &area
                          : !force_column                 ? nullptr
                          : contact_column                ? &force
                                                          : &tension;
    if (worst == nullptr) continue;
    ASSERT_TRUE(second.has_column(column)) << column;
    for (std::size_t row = 0; row < first.rows(); ++row)
      if (const double before = first.number(row, column); !std::isnan(before))
        raise(*worst, second.number(row, column) - before);
  }
  std::printf("through export and import: lengths %.2g mm, areas %.2g mm2, contact forces %.2g N, others %.2g N\n",
              length, area, force, tension);
  EXPECT_LT(length, 1e-9);
  EXPECT_LT(area, 1e-9);
  EXPECT_LT(force, 1e-9);
  EXPECT_LT(tension, 1e-8);
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
