// The patella of a new knee, on the knees of a statistical shape model, which knows by its vertices where ligaments
// insert. Its patellae have frames of their own: here each is put before its femur, as in a scan.
#include "genu/new_scene/new_patella.h"

#include <algorithm>
#include <fstream>
#include <regex>

#include <gtest/gtest.h>

#include "genu/atlas/fitted_patella.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/mesh_files/stl_writer.h"
#include "genu/new_scene/new_edit.h"
#include "genu/new_scene/new_scene.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/drawn_knee.h"
#include "support/places.h"
#include "support/ply_vertices.h"
#include "support/scenes.h"
#include "support/temporary_folder.h"
#include "support/text.h"

namespace genu {
namespace {

using test::contains;
using test::data_path;
using test::ply_vertices;
using test::TemporaryFolder;

Mesh mesh_in(const std::string& file) {
  Diagnostics out;
  auto mesh = read_mesh(file, 1e-3, out);
  EXPECT_TRUE(mesh) << test::messages(out);
  return mesh ? std::move(*mesh) : Mesh{};
}

std::string ssm(const std::string& name, const std::string& part) {
  return data_path("ssm/") + name + "_" + part + ".ply";
}

/// The patella's own frame in the files' (x lateral, y anterior, z proximal), near where hand-made scenes settle in
/// extension. m
const Eigen::Isometry3d kBeforeTheFemur =
    Eigen::Translation3d(0.0045, 0.051, 0.0105) * Eigen::AngleAxisd(-0.2, Vec3::UnitX());

void put(const std::string& from, const std::string& to, const Eigen::Isometry3d& where) {
  Mesh mesh = mesh_in(from);
  for (Vec3& vertex : mesh.vertices) vertex = where * vertex;
  EXPECT_TRUE(write_stl(mesh, to, 1e-3, "patella").empty());
}

/// Of each fibre of the patella the vertices of its ends, in the order of its bodies.
std::map<std::string, std::array<std::size_t, 2>> vertices_of_bands() {
  const std::string text = test::read_file(data_path("ssm/mean_ligaments.json"));
  const std::regex fibre(R"~("name":"(\w+)".*?"segment":\["\w+","\w+"\].*?"node":\[(\d+),(\d+)\])~");
  std::map<std::string, std::array<std::size_t, 2>> out;
  std::istringstream records(text);
  for (std::string record; std::getline(records, record, '}');)
    if (std::smatch m; contains(record, "patella_r") && std::regex_search(record, m, fibre))
      out[m[1]] = {std::stoul(m[2]), std::stoul(m[3])};
  return out;
}

/// Half of the insertions within 4 mm of where the model has them, 95 % within 9 mm, as of the other ligaments; on
/// the femur and the patella. (The tendon's end on these tibiae lies below what the reference has of one.)
TEST(NewPatella, InsertsWhereTheShapeModelHasIt) {
  GENU_NEEDS_DATA("ssm/mean_ligaments.json");
  const auto truth = vertices_of_bands();
  ASSERT_EQ(truth.size(), 20u);
  std::vector<double> off;
  for (const std::string name : {"mean", "S001", "S002"}) {
    const std::string shifted = name == "mean" ? "Tibia_shifted" : "Tibia";
    const Mesh femur = mesh_in(ssm(name, "Femur")), tibia = mesh_in(ssm(name, shifted)),
               patella = mesh_in(ssm(name, "Patella")), cartilage = mesh_in(ssm(name, "Patella_Cartilage"));
    const auto layout = lay_out_knee(femur, tibia);
    ASSERT_TRUE(layout);
    const FittedKnee knee = fit_reference_knee(
        femur, tibia, {layout->anterior, layout->proximal, layout->right, layout->centre, layout->width, layout->gap});
    const FittedPatella fitted = fit_reference_patella({cartilage, patella, femur, tibia}, knee);
    EXPECT_FALSE(fitted.poor()) << name;
    const std::vector<Vec3> on_femur = ply_vertices(ssm(name, "Femur")),
                            on_patella = ply_vertices(ssm(name, "Patella"));
    for (std::size_t i = 0; i < fitted.fibres.size(); ++i) {
      const PatellaFibre& fibre = reference_knee().patella.fibres[i];
      const auto [first, second] = truth.at(fibre.name);
      off.push_back((fitted.fibres[i].patella.at - on_patella[fibre.to_tibia ? first : second]).norm());
      if (!fibre.to_tibia) off.push_back((fitted.fibres[i].bone.at - on_femur[first]).norm());
    }
  }
  std::sort(off.begin(), off.end());
  std::printf("median %.1f mm, 95 %% %.1f mm\n", 1e3 * off[off.size() / 2], 1e3 * off[95 * off.size() / 100]);
  EXPECT_LT(off[off.size() / 2], 4e-3);
  EXPECT_LT(off[95 * off.size() / 100], 9e-3);
}

/// From 0 to 120 deg it is solved, glides down the groove, and its ligaments strain no more than others of the knee.
TEST(NewPatella, MakesAKneeThatBends) {
  GENU_NEEDS_DATA("ssm/mean_Patella.ply");
  const TemporaryFolder folder;
  put(ssm("mean", "Patella"), folder / "patella.stl", kBeforeTheFemur);
  Diagnostics out;
  const auto report = write_new_scene({.kind = NewScene::Kind::stl,
                                       .folder = folder / "knee",
                                       .femur_any = ssm("mean", "Femur"),
                                       .tibia_any = ssm("mean", "Tibia_shifted"),
                                       .patella_any = folder / "patella.stl"},
                                      out);
  ASSERT_TRUE(report) << test::messages(out);
  EXPECT_EQ(report->poses_solved, 130);
  EXPECT_EQ(report->poses_asked, 130);
  Diagnostics said;
  Solution found;
  EXPECT_EQ(run_scene(report->file, folder / "out", {}, said, &found), kExitOk) << test::messages(said);
  const ResultTable& t = found.poses;
  ASSERT_EQ(t.rows(), 130u);
  EXPECT_EQ(found.summary.verdict_class, RunSummary::Class::solved) << found.summary.verdict.front();
  // Patellofemoral flexion is some 0.7 of the knee's (Amis et al. 2006: 0.6 to 0.7 up to 90 deg).
  const double turned = t.number(99, "patella.gs.flexion_deg") - t.number(9, "patella.gs.flexion_deg");
  EXPECT_GT(turned, 50);
  EXPECT_LT(turned, 80);
  for (std::size_t row = 9; row < t.rows(); ++row) {
    EXPECT_LT(std::abs(t.number(row, "patella.gs.lateral_shift_mm")), 10) << row;
    EXPECT_GT(t.number(row, "patellofemoral.force_N"), 30) << row;
    for (const char* fibre : {"mPFL1", "mPFL4", "lPFL2", "lPFL4"})
      EXPECT_LT(t.number(row, std::string(fibre) + ".strain"), 0.1) << fibre << " in row " << row;
  }
}

/// What is refused, by what it is called.
std::string why_refused(const PieceFiles& patella) {
  const TemporaryFolder folder;
  NewScene asked = test::drawn_knee_in(folder / "knee");
  asked.patella_any = patella;
  Diagnostics out;
  EXPECT_FALSE(write_new_scene(asked, out));
  EXPECT_FALSE(std::filesystem::exists(folder / "knee"));
  return test::messages(out);
}

TEST(NewPatella, OtherMeshesAreNamed) {
  EXPECT_TRUE(contains(why_refused(test::kLeskovar + "tibia.stl"), "is it the patella?"));
  EXPECT_TRUE(contains(why_refused(PieceFiles("nothing.stl")), "nothing.stl"));
  const TemporaryFolder folder;
  put(test::kLeskovar + "patella.stl", folder / "behind.stl", Eigen::Isometry3d(Eigen::Translation3d(-0.1, 0, 0)));
  EXPECT_TRUE(contains(why_refused(folder / "behind.stl"), "mm behind the middle of the tibia's plateau"));
  put(test::kLeskovar + "patella.stl", folder / "far.stl", Eigen::Isometry3d(Eigen::Translation3d(0.1, 0, 0)));
  EXPECT_TRUE(contains(why_refused(folder / "far.stl"), "mm from the femur: is it the patella, in the frame"));
}

/// Written again without its patella, a scene would keep changes of tables that are gone.
TEST(NewPatella, IsAskedForAgain) {
  const TemporaryFolder folder;
  std::filesystem::create_directory(folder / "knee");
  const NewSceneFiles files{folder / "knee", "knee"};
  const std::string scene = test::read_file(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml");
  std::ofstream(files.scene()) << scene;
  std::ofstream(files.written()) << written_copy(scene + "\n[body.patella]\n");
  Diagnostics out;
  EXPECT_FALSE(read_earlier(files, {}, out));
  EXPECT_TRUE(contains(test::messages(out), "has a patella: give --patella again")) << test::messages(out);
  Diagnostics nothing;
  NewScene with;
  with.patella.paths = {"patella.stl"};
  EXPECT_TRUE(read_earlier(files, with, nothing)) << test::messages(nothing);
}

/// Only those between femur and patella that strain too much get a length: their longest, strained by 0.08.
TEST(NewPatella, ItsLigamentsSettleByTheirLongest) {
  ResultTable poses;
  for (const PatellaFibre& fibre : reference_knee().patella.fibres)
    for (const char* column : {".length_mm", ".strain"}) poses.add_column(fibre.name + column);
  poses.add_column("status");
  for (const double stretched : {0.0, 0.2}) {
    poses.add_row();
    poses.set("status", std::string("ok"));
    for (const PatellaFibre& fibre : reference_knee().patella.fibres) {
      const double strain = fibre.name == "lPFL4" || fibre.to_tibia ? stretched : 0.01;
      poses.set(fibre.name + ".length_mm", 40 * (1 + strain));
      poses.set(fibre.name + ".strain", strain);
    }
  }
  std::map<std::string, std::string> lengths;
  EXPECT_TRUE(settle_patella(poses, lengths));
  ASSERT_EQ(lengths.size(), 1u);
  EXPECT_EQ(lengths.begin()->second, "slack_length = 44.44");
  EXPECT_FALSE(settle_patella(poses, lengths));
}

}  // namespace
}  // namespace genu
