// The anterior laxity at 25 deg of the whole knee as OpenSim-JAM published it: 24 poses, under the loads that the rest
// of that model (muscles, gravity, the drawer force) exerts on tibia and patella.
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/scene/reader.h"
#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/published_knee.h"
#include "support/scenes.h"

namespace genu {
namespace {

constexpr double kDegree = M_PI / 180;

/// `start` of a joint at a row; angles in rad, lengths in m.
std::string start_of(const test::PublishedTable& table, const std::string& joint,
                     const std::array<std::string, 3>& angles) {
  std::string keys;
  for (const std::string& angle : angles)
    keys += fmt::format("{} = {}, ", angle, kDegree * table.at(0, joint + "." + angle + "_deg"));
  for (const std::string axis : {"x", "y", "z"})
    keys += fmt::format("{} = {}{}", axis, 1e-3 * table.at(0, joint + "." + axis + "_mm"), axis == "z" ? "" : ", ");
  return "start = { " + keys + " }\n";
}

/// The scene of the published poses with the published loads, row after row.
std::string loaded_knee(const test::PublishedTable& table) {
  std::string text = test::published_scene(test::data_path("lenhart2015/ACLC01-R-femur-cart.stl"));
  text.resize(text.find("[[step]]"));
  text = test::replaced(text, "[joint.knee]\n",
                        "[joint.knee]\n" + start_of(table, "knee", {"flexion", "adduction", "rotation"}));
  text = test::replaced(text, "[joint.pf]\n", "[joint.pf]\n" + start_of(table, "pf", {"flexion", "rotation", "tilt"}));
  std::vector<std::pair<std::string, std::string>> loads;  // name, column
  for (const std::string body : {"tibia", "patella"})
    for (const auto& [kind, unit] : {std::pair("force", "N"), std::pair("moment", "Nm")})
      for (int axis = 0; axis < 3; ++axis) {
        const char letter = "xyz"[axis];
        loads.emplace_back(fmt::format("{}_{}_{}", body, kind, letter),
                           fmt::format("{}.external_{}_{}_{}", body, kind, letter, unit));
        text += fmt::format("[load.{}]\nbody = \"{}\"\n{} = [{}, {}, {}]\n", loads.back().first, body, kind,
                            axis == 0 ? 1 : 0, axis == 1 ? 1 : 0, axis == 2 ? 1 : 0);
      }
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const std::size_t before = row == 0 ? 0 : row - 1;
    std::string factors;
    for (const auto& [name, column] : loads)
      factors += fmt::format("{}{} = [{}, {}]", factors.empty() ? "" : ", ", name, table.at(before, column),
                             table.at(row, column));
    text += fmt::format("[[step]]\nprescribe = {{ \"knee.flexion\" = [{}, {}] }}\nload = {{ {} }}\n",
                        kDegree * table.at(before, "knee.flexion_deg"), kDegree * table.at(row, "knee.flexion_deg"),
                        factors);
  }
  return text;
}

TEST(PublishedLaxity, TheWholeKneeFollowsTheAnteriorForce) {
  GENU_NEEDS_DATA("lenhart2015/whole_knee_anterior_laxity.csv");
  const test::PublishedTable table("whole_knee_anterior_laxity.csv");
  Diagnostics out;
  auto scene = parse_scene(loaded_knee(table), "laxity.toml", out);
  ASSERT_TRUE(scene) << test::messages(out);
  const auto prepared = prepare(std::move(*scene), std::make_shared<MeshLibrary>(), out);
  ASSERT_TRUE(prepared) << test::messages(out);
  ContactField field(prepared->model);
  const Solution found = solve(*prepared, field, {});
  ASSERT_EQ(found.solved(), static_cast<int>(table.rows()) + 1);
  double worst_mm = 0, worst_deg = 0;
  for (std::size_t row = 0; row < table.rows(); ++row)
    for (const std::string& column : found.poses.columns()) {
      const double published = table.at(row, column);
      if (std::isnan(published) || column.find('.') != column.rfind('.')) continue;
      const double off = std::abs(found.poses.number(row + 1, column) - published);
      if (column.ends_with(".x_mm") || column.ends_with(".y_mm") || column.ends_with(".z_mm"))
        worst_mm = std::max(worst_mm, off);
      if (column.ends_with("_deg")) worst_deg = std::max(worst_deg, off);
    }
  fmt::print("whole knee, anterior force 0 to 98 N at 25 deg: within {:.3f} mm and {:.3f} deg of the published poses\n",
             worst_mm, worst_deg);
  EXPECT_LT(worst_mm, 0.06);
  EXPECT_LT(worst_deg, 0.12);
  EXPECT_GT(worst_mm, 0) << "something was compared";
}

}  // namespace
}  // namespace genu
