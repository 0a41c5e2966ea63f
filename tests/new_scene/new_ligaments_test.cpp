// Ligaments laid on the knees of a statistical shape model, which knows by its vertices where they insert.
#include "genu/new_scene/new_ligaments.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <regex>
#include <sstream>

#include <gtest/gtest.h>

#include "genu/mesh_files/mesh_reader.h"
#include "genu/new_scene/new_scene.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/ply_vertices.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::data_path;
using test::ply_vertices;
using test::TemporaryFolder;

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

struct Meshes {
  Mesh femur, tibia;
};
Meshes meshes_of(const std::string& femur, const std::string& tibia) {
  Diagnostics out;
  auto f = read_mesh(femur, 1e-3, out), t = read_mesh(tibia, 1e-3, out);
  EXPECT_TRUE(f && t) << test::messages(out);
  return {f ? std::move(*f) : Mesh{}, t ? std::move(*t) : Mesh{}};
}

KneeAxes axes_of(const Meshes& meshes) {
  const auto layout = lay_out_knee(meshes.femur, meshes.tibia);
  EXPECT_TRUE(layout);
  if (!layout) return {};
  return {layout->anterior, layout->proximal, layout->right, layout->centre, layout->width, layout->gap};
}

/// How far insertions are from the vertices of a shape model (m), and how many times the error that is stated.
struct Errors {
  std::vector<double> metres, stated;
};
void compare_with_vertices(const FittedKnee& fitted, const std::string& name, Errors& out) {
  const auto truth = vertices_of_fibres();
  ASSERT_EQ(truth.size(), 55u);
  const std::vector<Vec3> femur = ply_vertices(knee_of(name).femur), tibia = ply_vertices(knee_of(name).tibia);
  const auto compare = [&](const Insertion& found, const Vec3& right) {
    out.metres.push_back((found.at - right).norm());
    out.stated.push_back(out.metres.back() / found.error);
  };
  for (std::size_t i = 0; i < reference_knee().fibres.size(); ++i) {
    const ReferenceFibre& fibre = reference_knee().fibres[i];
    const auto [f, t] = truth.at(fibre.name);
    compare(fitted.femur.insertions[i], femur[f]);
    // Those on the fibula, which these meshes have not, are given as a point beside the tibia.
    if (fibre.bundle != "LCL" && fibre.bundle != "PFL") compare(fitted.tibia.insertions[i], tibia[t]);
  }
}

TEST(NewLigaments, InsertWhereTheShapeModelHasThem) {
  GENU_NEEDS_DATA("ssm/mean_ligaments.json");
  Errors bones, cartilage;
  for (const char* name : {"mean", "S001", "S002"}) {
    const Knee knee = knee_of(name);
    const Meshes bone = meshes_of(knee.femur, knee.tibia),
                 joint = meshes_of(knee.femur_cartilage, knee.tibia_cartilage);
    const FittedKnee on_bone = fit_reference_knee(bone.femur, bone.tibia, axes_of(bone)),
                     on_joint = fit_reference_knee(joint.femur, joint.tibia, axes_of(joint));
    EXPECT_FALSE(on_bone.femur.articular || on_bone.tibia.articular) << name;
    EXPECT_TRUE(on_joint.femur.articular && on_joint.tibia.articular) << name;
    Errors own;
    compare_with_vertices(on_bone, name, own);
    EXPECT_LT(share(own.metres, 0.5), 4e-3) << name;
    EXPECT_LT(share(own.metres, 0.95), 9e-3) << name;
    EXPECT_LT(share(own.stated, 0.95), 2.5) << name;  // what is stated is a standard deviation
    compare_with_vertices(on_bone, name, bones);
    compare_with_vertices(on_joint, name, cartilage);
  }
  for (const auto& [from, errors] : {std::pair("bones", bones), std::pair("cartilage alone", cartilage)})
    std::printf("from %s: median %.1f mm, 95 %% %.1f mm\n", from, 1e3 * share(errors.metres, 0.5),
                1e3 * share(errors.metres, 0.95));
  EXPECT_LT(share(cartilage.metres, 0.95), 12e-3);
}

/// Without the triangles that have a vertex above or below a height of the file.
Mesh cut(const Mesh& mesh, double from, double to) {
  Mesh out = mesh;
  std::erase_if(out.triangles, [&](const auto& t) {
    return std::any_of(t.begin(), t.end(),
                       [&](int k) { return !(mesh.vertices[at(k)].z() > from) || !(mesh.vertices[at(k)].z() < to); });
  });
  return out;
}

TEST(NewLigaments, InsertThereOnBonesCutShortToo) {
  GENU_NEEDS_DATA("ssm/mean_ligaments.json");
  for (const char* name : {"S001", "S002"}) {
    const Knee knee = knee_of(name);
    Meshes bone = meshes_of(knee.femur, knee.tibia);
    bone.femur = cut(bone.femur, -1, 0.025);
    bone.tibia = cut(bone.tibia, -0.06, 1);
    const FittedKnee fitted = fit_reference_knee(bone.femur, bone.tibia, axes_of(bone));
    EXPECT_FALSE(fitted.femur.articular || fitted.tibia.articular) << name;
    Errors errors;
    compare_with_vertices(fitted, name, errors);
    EXPECT_LT(share(errors.metres, 0.5), 4e-3) << name;
  }
}

TEST(NewLigaments, OfBonesAskewToTheirFilesAreDoubted) {
  GENU_NEEDS_DATA("ssm/S001_Femur.ply");
  const Knee knee = knee_of("S001");
  Meshes bone = meshes_of(knee.femur, knee.tibia);
  const auto turned = [&]() {
    return ligaments_of(bone.femur, bone.tibia, nullptr, *lay_out_knee(bone.femur, bone.tibia), false, true).turned;
  };
  EXPECT_FALSE(turned());
  const Mat3 turn = Eigen::AngleAxisd(0.44, Vec3(1, 1, 0.3).normalized()).toRotationMatrix();
  for (Mesh* mesh : {&bone.femur, &bone.tibia})
    for (Vec3& p : mesh->vertices) p = turn * p;
  ASSERT_TRUE(turned());
  EXPECT_TRUE(test::contains(*turned(), "turned by about 2")) << *turned();
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

/// A fibre that is 30 mm long in extension and 39 mm at the end of a flexion.
ResultTable poses_to(double flexion, const std::string& name) {
  ResultTable poses;
  poses.add_column("knee.flexion_deg");
  poses.add_column(name + ".length_mm");
  for (const auto& [angle, length] : {std::pair(0.0, 30.0), std::pair(flexion, 39.0)}) {
    poses.add_row();
    poses.set("knee.flexion_deg", angle);
    poses.set(name + ".length_mm", length);
  }
  return poses;
}

/// The longest that it is strains as its bundle should; what is said of it is a slack length then.
TEST(NewLigaments, SettleByTheirLongest) {
  const std::string name = "MCLs1";
  std::map<std::string, std::string> lengths = {{"length of " + name, "reference_strain = 0.1"}};
  EXPECT_TRUE(settle_ligaments(poses_to(90, name), 0, lengths));
  EXPECT_EQ(lengths.begin()->second, "slack_length = 36.79");  // 39 mm at a strain of 0.06
  EXPECT_FALSE(settle_ligaments(poses_to(90, name), 1, lengths));
  EXPECT_TRUE(settle_ligaments(poses_to(110, name), 2, lengths));
  EXPECT_EQ(lengths.begin()->second, "slack_length = 36.11");  // beyond 100 deg at 0.08
  std::map<std::string, std::string> none;
  EXPECT_FALSE(settle_ligaments(poses_to(90, name), 0, none));
}

/// The reference pose is the first that was found.
TEST(NewLigaments, ReferToTheFirstPose) {
  ResultTable poses;
  for (const char* column : {"knee.adduction_deg", "knee.rotation_deg", "knee.x_mm", "knee.y_mm", "knee.z_mm"})
    poses.add_column(column);
  EXPECT_EQ(balanced_reference(poses), "");
  for (const double shift : {1.23456, 7.0}) {
    poses.add_row();
    poses.set("knee.adduction_deg", -0.001);
    poses.set("knee.rotation_deg", 5.0);
    poses.set("knee.x_mm", shift);
    poses.set("knee.y_mm", -2.5);
    poses.set("knee.z_mm", 0.126);
  }
  EXPECT_EQ(balanced_reference(poses), "adduction = 0, rotation = 5, x = 1.23, y = -2.5, z = 0.13");
}

}  // namespace
}  // namespace genu
