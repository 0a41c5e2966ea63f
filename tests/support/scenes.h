// The Dortmans knee of meshes/, and the same knee written in another unit or another place.
#pragma once

#include <string>

#include <gtest/gtest.h>

#include "genu/model/build_model.h"
#include "genu/scene/centre_bodies.h"
#include "genu/scene/reader.h"
#include "genu/study/run_scene.h"
#include "support/judged.h"
#include "support/places.h"
#include "support/temporary_folder.h"

namespace genu::test {

inline std::string dortmans_file() { return genu::test::source_folder() + "/meshes/dortmans1984/scene.toml"; }

inline std::string messages(const Diagnostics& out) {
  std::string text;
  for (const Diagnostic& d : out.items()) text += to_string(d) + "\n";
  return text;
}

/// Solves a scene that has to be good.
inline Solution solved(const Scene& scene) {
  Diagnostics out;
  const auto p = prepare(scene, std::make_shared<MeshLibrary>(), out);
  EXPECT_TRUE(p.has_value()) << messages(out);
  if (!p) return {};
  ContactField field(p->model);
  Solution solution = solve(*p, field, {});
  expect_judged_ok(scene, solution.poses);
  return solution;
}

/// Solves a scene that has to be good, from its text.
inline Solution solution_of(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << messages(out);
  return scene ? solved(*scene) : Solution{};
}

/// The poses of a scene that has to be solved throughout, from its text.
inline ResultTable table_of(const std::string& text) {
  Diagnostics out;
  const auto scene = parse_scene(text, "scene.toml", out);
  EXPECT_TRUE(scene.has_value()) << messages(out);
  if (!scene) return {};
  const Solution solution = solved(*scene);
  EXPECT_TRUE(all_solved(solution.summary.exit_code));
  return solution.poses;
}

inline std::string word(const ResultTable& t, std::size_t row, const std::string& column) {
  return std::get<std::string>(t.at(row, t.column_index(column)));
}

/// The largest difference of a column in two tables of equal length; infinity where one has no number.
inline double worst_difference(const ResultTable& a, const ResultTable& b, const std::string& column) {
  double worst = a.rows() == b.rows() && a.rows() > 0 ? 0 : INFINITY;
  for (std::size_t row = 0; row < std::min(a.rows(), b.rows()); ++row) {
    const double difference = std::abs(a.number(row, column) - b.number(row, column));
    worst = difference >= 0 ? std::max(worst, difference) : INFINITY;
  }
  return worst;
}

}  // namespace genu::test
