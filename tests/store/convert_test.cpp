// What is written for OpenSim is read again by `genu evaluate`; times and folders of both kinds.
#include "genu/store/convert.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/study/evaluate.h"
#include "support/scenes.h"

namespace genu {
namespace {

namespace fs = std::filesystem;

class Converted {
 public:
  Converted() {
    Diagnostics out;
    EXPECT_EQ(run_scene(test::dortmans_file(), folder / "run", {}, out, nullptr), kExitOk) << test::messages(out);
    const std::string file = folder / "run/results.csv";
    read = read_results(test::dortmans_file(), test::read_file(file), file, out);
    EXPECT_TRUE(read.has_value()) << test::messages(out);
  }
  int convert(const ConvertOptions& options) {
    said = {};
    found = {};
    return convert_results(*read, options, said, found);
  }

  test::TemporaryFolder folder;
  std::optional<ResultsRead> read;
  Diagnostics said;
  ConvertFound found;
};

TEST(Convert, AMotionEvaluatedAgainGivesTheRunsNumbers) {
  Converted c;
  ASSERT_EQ(c.convert({.to = ConvertTo::motion, .out = c.folder / "knee.mot", .names = {"", "r"}}), kExitOk);
  EXPECT_EQ(c.found.time, "time_s");
  Diagnostics out;
  Evaluation again;
  ASSERT_EQ(evaluate_scene(test::dortmans_file(), c.folder / "knee.mot", c.folder / "again", {}, out, &again), kExitOk)
      << test::messages(out);
  const ResultTable& was = c.read->solution.poses;
  ASSERT_EQ(again.poses.rows(), was.rows());
  for (std::size_t row = 0; row < was.rows(); ++row)
    for (const std::string& column : was.columns()) {
      const bool coordinate = column.starts_with("knee.") && !column.ends_with("_Nm");
      if (!coordinate && !column.ends_with(".strain") && !column.ends_with("C.force_N")) continue;
      EXPECT_NEAR(again.poses.number(row, column), was.number(row, column), coordinate ? 1e-12 : 1e-9) << column;
    }
}

TEST(Convert, ContactForcesForOpenSimHoldTheKneeWithItsLigaments) {
  Converted c;
  ASSERT_EQ(c.convert({.to = ConvertTo::opensim, .out = c.folder / "osim"}), kExitOk) << test::messages(c.said);
  EXPECT_TRUE(fs::exists(c.folder / "osim/motion.mot"));
  EXPECT_EQ(c.found.files, 3u);
  // Both surfaces of the tibia are planes z = 0: forces along -z, moments from the points' places, in the file's words.
  Diagnostics out;
  const auto file = read_pose_file(c.folder / "osim/forces.sto", out);
  ASSERT_TRUE(file.has_value()) << test::messages(out);
  const auto number = [&](std::size_t row, const std::string& name) {
    for (std::size_t k = 0; k < file->names.cells.size(); ++k)
      if (file->names.cells[k].text == name) return std::stod(file->rows[row].cells[k].text);
    ADD_FAILURE() << name;
    return 0.0;
  };
  const ResultTable& t = c.read->solution.poses;
  for (const std::size_t row : {0u, 35u, 70u}) {
    EXPECT_NEAR(number(row, "medial.contact_force_z"), -t.number(row, "medial.force_N"), 1e-9);
    EXPECT_NEAR(number(row, "medial.contact_force_x"), 0, 1e-9);
    EXPECT_NEAR(number(row, "medial.contact_moment_x"),
                -1e-3 * t.number(row, "medial.tibia_medial.y_mm") * t.number(row, "medial.force_N"), 1e-9);
    EXPECT_EQ(number(row, "AAC.force_total"), t.number(row, "AAC.force_N"));
    EXPECT_EQ(number(row, "knee_flex_r_moment"), t.number(row, "knee.flexion.reaction_Nm"));
  }
}

TEST(Convert, ASeriesTakesItsTimesFromAnyColumnThatGrows) {
  Converted c;
  ConvertOptions options{.to = ConvertTo::vtk, .out = c.folder / "vtk", .time = "knee.flexion_deg", .every = 35};
  ASSERT_EQ(c.convert(options), kExitOk) << test::messages(c.said);
  EXPECT_EQ(c.found.rows, 3u);
  const std::string list = test::read_file(c.folder / "vtk/poses.pvd");
  EXPECT_NE(list.find("timestep=\"70"), std::string::npos) << list;
  EXPECT_TRUE(fs::exists(c.folder / "vtk/vtp/femur_medial.36.vtp"));
  options.time = "row";
  ASSERT_EQ(c.convert(options), kExitOk) << "an earlier one is replaced: " << test::messages(c.said);
  EXPECT_NE(test::read_file(c.folder / "vtk/poses.pvd").find("timestep=\"71\""), std::string::npos);
  options.time = "knee.adduction_deg";
  EXPECT_EQ(c.convert(options), kExitRefused);
  EXPECT_NE(test::messages(c.said).find("must grow from row to row"), std::string::npos);
  options.time = "knee.flexoin_deg";
  EXPECT_EQ(c.convert(options), kExitRefused);
  EXPECT_NE(test::messages(c.said).find("did you mean \"knee.flexion_deg\"?"), std::string::npos);
  EXPECT_TRUE(fs::exists(c.folder / "vtk/poses.pvd")) << "what stood there stands";
}

TEST(Convert, WhatCannotBeWrittenFailsAndLeavesNothing) {
  Converted c;
  EXPECT_EQ(c.convert({.to = ConvertTo::motion, .out = c.folder / "none/x.mot"}), kExitFailed);
  EXPECT_TRUE(c.said.has_errors());
  c.folder.write("mine.txt", "kept");
  EXPECT_EQ(c.convert({.to = ConvertTo::vtk, .out = c.folder / "mine.txt"}), kExitFailed);
  EXPECT_EQ(test::read_file(c.folder / "mine.txt"), "kept");
}

}  // namespace
}  // namespace genu
