// Ligaments laid on the knees of a statistical shape model, which knows by its vertices where they insert.
#include "genu/study/new_ligaments.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/study/new_scene.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::data_path;
using test::TemporaryFolder;

/// Vertices of a binary PLY file of x y z, some with normals, in its own order. m.
std::vector<Vec3> ply_vertices(const std::string& file) {
  const std::string bytes = test::read_file(file);
  const std::size_t body = bytes.find("end_header\n") + 11, count = std::stoul(bytes.substr(bytes.find("vertex ") + 7));
  const std::size_t numbers = bytes.substr(0, body).find("property float nx") == std::string::npos ? 3 : 6;
  std::vector<Vec3> out(count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      float x = 0;
      std::memcpy(&x, bytes.data() + body + 4 * (numbers * i + k), 4);
      out[i][static_cast<Eigen::Index>(k)] = 1e-3 * static_cast<double>(x);
    }
  return out;
}

/// Of each fibre between femur and tibia its two vertices.
std::map<std::string, std::array<std::size_t, 2>> vertices_of_fibres() {
  const std::string text = test::read_file(data_path("ssm/mean_ligaments.json"));
  const std::regex fibre(
      "\"name\":\"(\\w+)\".*?\"segment\":\\[\"femur_distal_r\",\"tibia_proximal_r\"\\].*?\"node\":\\[(\\d+),(\\d+)\\]");
  std::map<std::string, std::array<std::size_t, 2>> out;
  std::istringstream records(text);
  for (std::string record; std::getline(records, record, '}');) {
    std::smatch m;
    if (std::regex_search(record, m, fibre)) out[m[1]] = {std::stoul(m[2]), std::stoul(m[3])};
  }
  return out;
}

struct Knee {
  std::string femur, tibia, femur_cartilage, tibia_cartilage;
};
Knee knee_of(const std::string& name) {
  const std::string folder = data_path("ssm/") + name, shifted = name == "mean" ? "_shifted" : "";
  return {folder + "_Femur.ply", folder + "_Tibia" + shifted + ".ply", folder + "_Femur_Cartilage.ply",
          folder + "_Tibia_Cartilage" + shifted + ".ply"};
}

double share(std::vector<double> x, double part) {
  std::sort(x.begin(), x.end());
  return x[static_cast<std::size_t>(part * static_cast<double>(x.size() - 1))];
}

TEST(NewLigaments, InsertWhereTheShapeModelHasThem) {
  GENU_NEEDS_DATA("ssm/mean_ligaments.json");
  const auto truth = vertices_of_fibres();
  ASSERT_EQ(truth.size(), 55u);
  for (const char* name : {"mean", "S001", "S002"}) {
    const Knee knee = knee_of(name);
    Diagnostics out;
    const auto femur = read_mesh(knee.femur, 1e-3, out), tibia = read_mesh(knee.tibia, 1e-3, out);
    ASSERT_TRUE(femur && tibia);
    const auto layout = lay_out_knee(*femur, *tibia);
    ASSERT_TRUE(layout);
    const FittedKnee fitted = fit_reference_knee(
        *femur, *tibia,
        {layout->anterior, layout->proximal, layout->right, layout->centre, layout->width, layout->gap});
    const std::vector<Vec3> femur_points = ply_vertices(knee.femur), tibia_points = ply_vertices(knee.tibia);
    std::vector<double> errors, shares;
    for (std::size_t i = 0; i < reference_knee().fibres.size(); ++i) {
      const ReferenceFibre& fibre = reference_knee().fibres[i];
      const auto [f, t] = truth.at(fibre.name);
      const auto compare = [&](const Insertion& found, const Vec3& right) {
        errors.push_back((found.at - right).norm());
        shares.push_back(errors.back() / found.error);
      };
      compare(fitted.femur.insertions[i], femur_points[f]);
      // Those on the fibula, which these meshes have not, are given as a point beside the tibia.
      if (fibre.bundle != "LCL" && fibre.bundle != "PFL") compare(fitted.tibia.insertions[i], tibia_points[t]);
    }
    EXPECT_LT(share(errors, 0.5), 4e-3) << name;
    EXPECT_LT(share(errors, 0.95), 9e-3) << name;
    EXPECT_LT(share(shares, 0.95), 2.5) << name;  // what is stated is a standard deviation
  }
}

/// Bone and cartilage in, a knee out that bends to 120 deg as knees do.
TEST(NewLigaments, MakeAKneeThatBends) {
  GENU_NEEDS_DATA("ssm/mean_Femur.ply");
  for (const char* name : {"mean", "S001"}) {
    const Knee knee = knee_of(name);
    const TemporaryFolder folder;
    const NewScene asked{.kind = NewScene::Kind::stl,
                         .folder = folder / "knee",
                         .femur = knee.femur_cartilage,
                         .tibia = knee.tibia_cartilage,
                         .femur_bone = knee.femur,
                         .tibia_bone = knee.tibia};
    Diagnostics out;
    const auto report = write_new_scene(asked, out);
    ASSERT_TRUE(report.has_value());
    EXPECT_EQ(report->poses_solved, 130);
    Diagnostics said;
    Solution found;
    EXPECT_EQ(run_scene(report->file, folder / "out", {}, said, &found), kExitOk) << name;
    ASSERT_EQ(found.poses.rows(), 130u);
    EXPECT_EQ(found.summary.poses_stable, 130);
    for (std::size_t row = 0; row < 130; ++row) {
      const double flexion = found.poses.number(row, "knee.flexion_deg");
      EXPECT_LT(std::abs(found.poses.number(row, "knee.gs.external_rotation_deg")), flexion <= 30 ? 20 : 30)
          << name << " " << flexion;
    }
  }
}

TEST(NewLigaments, TellALeftKneeByItsShape) {
  GENU_NEEDS_DATA("ssm/mean_Femur.ply");
  const Knee knee = knee_of("mean");
  Diagnostics out;
  const auto femur = read_mesh(knee.femur, 1e-3, out), tibia = read_mesh(knee.tibia, 1e-3, out);
  ASSERT_TRUE(femur && tibia);
  EXPECT_EQ(fits_left(*femur, *tibia, *lay_out_knee(*femur, *tibia)), false);
  Mesh mirrored[2] = {*femur, *tibia};
  for (Mesh& mesh : mirrored) {
    for (Vec3& p : mesh.vertices) p.x() = -p.x();  // sideways in these files
    for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  }
  EXPECT_EQ(fits_left(mirrored[0], mirrored[1], *lay_out_knee(mirrored[0], mirrored[1])), true);
}

}  // namespace
}  // namespace genu
