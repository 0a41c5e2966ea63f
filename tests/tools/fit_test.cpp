// genu fit, run as a user runs it, and what genu mesh makes of its surfaces.
#include <cmath>
#include <numbers>

#include "genu/assemble/surface_fits.h"
#include "genu/mesh/mesh_topology.h"
#include "genu/mesh_files/mesh_reader.h"
#include "genu/scene/reader.h"
#include "support/data.h"
#include "support/places.h"
#include "tools/cli_scenes.h"

namespace genu::test {
namespace {

const std::string kKnee = genu::test::source_folder() + "/meshes/lenhart_polynomial/scene.toml";

SurfaceDef surface_of(const std::string& file, const std::string& name) {
  Diagnostics out;
  const auto scene = read_surface_file(file, out);
  for (const Diagnostic& d : out.items()) ADD_FAILURE() << to_string(d);
  if (scene)
    for (const SurfaceDef& s : scene->surfaces)
      if (s.name == name) return s;
  ADD_FAILURE() << "no " << name << " in " << file;
  return {};
}

TEST(FitCommand, RoundTripThroughFilesKeepsTheCoefficients) {
  TemporaryFolder folder;
  for (const std::string name : {"femur_cartilage_medial", "tibia_cartilage_lateral"}) {
    ASSERT_EQ(genu("mesh " + kKnee + " " + name + " --edge 0.5 --format ply --out " + (folder / "m")).exit_code, 0);
    const Outcome fit = genu("fit " + (folder / "m/" + name) + ".ply --like " + kKnee + ":" + name +
                             " --body femur --out " + (folder / "f"));
    ASSERT_EQ(fit.exit_code, 0) << fit.err;
    for (const char* file : {"surfaces.toml", "coverage.svg", "summary.json"})
      EXPECT_TRUE(std::filesystem::exists(folder / "f/" + file)) << file;
    const SurfaceDef first = surface_of(kKnee, name), again = surface_of(folder / "f/surfaces.toml", name);
    ASSERT_EQ(first.terms.size(), again.terms.size());
    const ChartBox patch = known_patch(first)->patch;
    double worst = 0;
    for (std::size_t k = 0; k < first.terms.size(); ++k)
      worst = std::max(worst, std::abs(first.terms[k].c - again.terms[k].c) * std::pow(patch.u1, first.terms[k].i) *
                                  std::pow(patch.v1, first.terms[k].j));
    // Relative to the patch's half side.
    std::printf("%s: coefficients change by %.1e of the patch\n", name.c_str(), worst / patch.v1);
    EXPECT_LT(worst / patch.v1, 1e-11);
  }
}

TEST(FitCommand, SaysTheSameTwice) {
  TemporaryFolder folder;
  ASSERT_EQ(genu("mesh " + kKnee + " --edge 1 --out " + (folder / "a")).exit_code, 0);
  ASSERT_EQ(genu("mesh " + kKnee + " --edge 1 --out " + (folder / "b")).exit_code, 0);
  EXPECT_EQ(read_file(folder / "a/femur_cartilage_medial.stl"), read_file(folder / "b/femur_cartilage_medial.stl"));
  const std::string fit = "fit " + (folder / "a/femur_cartilage_medial.stl") + " --out ";
  ASSERT_EQ(genu(fit + (folder / "c")).exit_code, 0);
  ASSERT_EQ(genu(fit + (folder / "d")).exit_code, 0);
  for (const char* file : {"surfaces.toml", "coverage.svg", "summary.json"})
    EXPECT_EQ(read_file(folder / "c/" + file), read_file(folder / "d/" + file)) << file;
}

TEST(FitCommand, SolidsAreClosed) {
  TemporaryFolder folder;
  for (const std::string format : {"stl", "ply", "obj"}) {
    ASSERT_EQ(
        genu("mesh " + kKnee + " --edge 2 --thickness 2 --format " + format + " --out " + (folder / "m")).exit_code, 0);
    Diagnostics out;
    const auto mesh = read_mesh(folder / "m/femur_cartilage_lateral." + format, 1e-3, out);
    ASSERT_TRUE(mesh);
    for (const MeshEdge& e : mesh_edges(*mesh)) ASSERT_EQ(e.count, 2) << format;
  }
  const Outcome thick = genu("mesh " + kKnee + " --edge 2 --thickness 60 --out " + (folder / "n"));
  EXPECT_EQ(thick.exit_code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder / "n"));
}

TEST(FitCommand, FitsMeasuredCartilageOfOtherKnees) {
  GENU_NEEDS_DATA("ssm/S002_Femur_Cartilage.ply");
  TemporaryFolder folder;
  for (const std::string bone : {"Femur", "Tibia"}) {
    const Outcome fit =
        genu("fit " + data_path("ssm/S002_" + bone + "_Cartilage.ply") + " --name s --out " + (folder / "f"));
    ASSERT_EQ(fit.exit_code, 0) << fit.err;
    std::printf("%s", fit.out.c_str());
    for (const char* name : {"s_1", "s_2"}) {
      const SurfaceDef def = surface_of(folder / "f/surfaces.toml", name);
      EXPECT_EQ(def.shape == SurfaceDef::Shape::cylindrical_polynomial, bone == "Femur");
    }
    EXPECT_NE(read_file(folder / "f/coverage.svg").find("s_2"), std::string::npos);
  }
}

/// A folder is replaced as a whole: what is read must not lie in it.
TEST(FitCommand, LosesNoInput) {
  TemporaryFolder folder;
  ASSERT_EQ(genu("mesh " + kKnee + " tibia_cartilage_medial --edge 2 --out " + (folder / "m")).exit_code, 0);
  const std::string mesh = folder / "m/tibia_cartilage_medial.stl", out = folder / "f";
  ASSERT_EQ(genu("fit " + mesh + " --out " + out).exit_code, 0);
  const std::string inside = folder / "f/b.stl", like = folder / "f/surfaces.toml", before = read_file(like);
  std::filesystem::copy_file(mesh, inside);
  const std::string ball = folder.write("f/ball.toml", kBall);
  for (const std::string& arguments : {inside, mesh + " --like " + like, "--scene " + ball}) {
    const Outcome refused = genu("fit " + arguments + " --out " + out);
    EXPECT_EQ(refused.exit_code, 2) << arguments;
    EXPECT_NE(refused.err.find("would be lost"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(read_file(inside), read_file(mesh));
  EXPECT_EQ(read_file(like), before);
  EXPECT_EQ(read_file(ball), kBall);
}

/// Whatever a file or a surface is called, what is written reads back.
TEST(FitCommand, WritesWhatReadsBackWhateverTheNames) {
  TemporaryFolder folder;
  ASSERT_EQ(genu("mesh " + kKnee + " tibia_cartilage_medial --edge 2 --out " + (folder / "m")).exit_code, 0);
  int number = 0;
  for (const std::string name : {"with space", "quo\"te\\", "3\xc3\xbcn\xef\xbc\x8f", "bad\xff\xc3", "new\nline",
                                 "-dash", "tab\t\x7f", "[table]", "#"}) {
    const std::string mesh = folder / name + ".stl", out = folder / ("f" + std::to_string(++number));
    std::filesystem::copy_file(folder / "m/tibia_cartilage_medial.stl", mesh);
    const Outcome fit = genu("fit '" + mesh + "' --out " + out);
    ASSERT_EQ(fit.exit_code, 0) << name << "\n" << fit.err;
    Diagnostics problems;
    const auto scene = read_surface_file(out + "/surfaces.toml", problems);
    ASSERT_TRUE(scene) << name << "\n"
                       << to_string(problems.items()[0]) << read_file(out + "/surfaces.toml").substr(0, 300);
    EXPECT_EQ(scene->surfaces.size(), 1u);
  }
  const std::string mesh = folder / "m/tibia_cartilage_medial.stl";
  for (const std::string option : {"--name", "--body"})
    for (const std::string bad : {"'a b'", "'a\"'", "3", "'x\n[body.y]'", "a.b", "\xc3\xbc"}) {
      const Outcome refused = genu("fit " + mesh + " " + option + " " + bad + " --out " + (folder / "g"));
      EXPECT_EQ(refused.exit_code, 2) << option << " " << bad;
      EXPECT_NE(refused.err.find(option), std::string::npos) << refused.err;
    }
}

TEST(FitCommand, SaysTheUnitItGuessedAndWhatIsDoubtful) {
  TemporaryFolder folder;
  ASSERT_EQ(genu("mesh " + kKnee + " tibia_cartilage_medial --edge 1 --out " + (folder / "m")).exit_code, 0);
  const std::string mesh = folder / "m/tibia_cartilage_medial.stl";
  const Outcome good = genu("fit " + mesh + " --out " + (folder / "f"));
  EXPECT_EQ(good.err, "") << "lengths are not told in a unit that was not known yet";
  EXPECT_NE(good.out.find("units mm (guessed from the size"), std::string::npos) << good.out;
  EXPECT_EQ(good.out.find("DOUBTFUL"), std::string::npos) << good.out;
  ASSERT_EQ(genu("mesh " + kKnee + " femur_cartilage_lateral --edge 1 --out " + (folder / "m")).exit_code, 0);
  const Outcome bad = genu("fit " + (folder / "m/femur_cartilage_lateral.stl") +
                           " --chart cartesian --degree 2 --out " + (folder / "g"));
  ASSERT_EQ(bad.exit_code, 0) << bad.err;
  EXPECT_NE(bad.out.find("DOUBTFUL: the vertices lie"), std::string::npos) << bad.out;
  EXPECT_NE(read_file(folder / "g/surfaces.toml").find("# DOUBTFUL: the vertices lie"), std::string::npos);
  EXPECT_NE(read_file(folder / "g/summary.json").find("\"doubts\": [\"the vertices lie"), std::string::npos);
}

TEST(FitCommand, RefusesWithExitCode2) {
  TemporaryFolder folder;
  ASSERT_EQ(genu("mesh " + kKnee + " --edge 3 --thickness 2 --out " + (folder / "solid")).exit_code, 0);
  ASSERT_EQ(genu("mesh " + kKnee + " --edge 3 --out " + (folder / "sheet")).exit_code, 0);
  const std::string solid = folder / "solid/tibia_cartilage_medial.stl",
                    sheet = folder / "sheet/tibia_cartilage_medial.stl";
  const std::string flat = folder.write("flat.obj",
                                        "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 20 0 0\nv 20 10 0\n"
                                        "f 1 2 3\nf 1 3 4\nf 2 5 6\nf 2 6 3\n");
  const std::string ball = folder.write("ball.toml", kBall), text = folder.write("notes.stl", "no mesh");
  const std::pair<std::string, const char*> bad[] = {
      {"fit " + (folder / "none.stl"), "none.stl"},
      {"fit " + text, "notes.stl"},
      {"fit " + flat, "flat"},
      {"fit " + solid, "closed"},
      {"fit " + sheet + " --region 'x > 1000'", "leave nothing"},
      {"fit " + sheet + " --region 'x ! 3'", "conditions"},
      {"fit " + sheet + " --facing up", "--facing"},
      {"fit " + sheet + " --facing nan,0,1", "--facing"},
      {"fit " + sheet + " --degree 12", "too few"},
      {"fit " + sheet + " --degree 13", "degree"},
      {"fit " + sheet + " --degree 0", "degree"},
      {"fit " + sheet + " --units feet", "units"},
      {"fit " + sheet + " --units m", "mm"},
      {"fit " + sheet + " --like " + kKnee, "several"},
      {"fit " + sheet + " --like " + kKnee + ":none", "none"},
      {"fit " + sheet + " --like " + ball + ":ball", "polynomial"},
      {"fit --scene " + ball, "nothing to fit"},
      {"fit --scene " + (folder / "none.toml"), "none.toml"},
      {"fit " + sheet + " --scene " + ball, "scene"},
      {"fit", "name a mesh file"},
  };
  for (const auto& [arguments, said] : bad) {
    const Outcome refused = genu(arguments + " --out " + (folder / "out"));
    EXPECT_EQ(refused.exit_code, 2) << arguments << "\n" << refused.out << refused.err;
    EXPECT_NE(refused.err.find(said), std::string::npos) << arguments << "\n" << refused.err;
    EXPECT_FALSE(std::filesystem::exists(folder / "out")) << arguments;
  }
  EXPECT_EQ(genu("fit " + sheet).exit_code, 2);
  EXPECT_EQ(genu("fit " + sheet + " --out " + text).exit_code, 2);
  EXPECT_EQ(genu("fit " + solid + " --facing y --out " + (folder / "out")).exit_code, 0);
}

}  // namespace
}  // namespace genu::test
