// Dortmans' simplified knee, two tori on two planes, against an independent implementation of the same equations.
#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "genu/study/run_scene.h"
#include "support/data.h"
#include "support/judged.h"
#include "support/places.h"

namespace genu {
namespace {

using Columns = std::vector<std::string>;

struct Csv {
  Columns names;
  std::vector<std::vector<double>> rows;
};

Csv read_csv(const std::string& path) {
  Csv csv;
  std::ifstream in(path);
  std::string line, cell;
  const auto next = [&] {
    const bool read = static_cast<bool>(std::getline(in, line));
    if (!line.empty() && line.back() == '\r') line.pop_back();
    return read;
  };
  next();
  for (std::istringstream header(line); std::getline(header, cell, ',');) csv.names.push_back(cell);
  while (next()) {
    auto& row = csv.rows.emplace_back();
    for (std::istringstream cells(line); std::getline(cells, cell, ',');) row.push_back(std::stod(cell));
  }
  return csv;
}

/// A column of the reference in genu's table: its name and the factor to the reference's unit.
struct Counterpart {
  std::string column;
  double factor = 1;
};

std::map<std::string, Counterpart> counterparts() {
  std::map<std::string, Counterpart> of{{"flexion", {"knee.flexion_deg"}},
                                        {"adduction", {"knee.adduction_deg"}},
                                        {"rotation", {"knee.rotation_deg"}},
                                        {"tx", {"knee.x_mm"}},
                                        {"ty", {"knee.y_mm"}},
                                        {"tz", {"knee.z_mm"}},
                                        {"torque_Nmm", {"knee.flexion.reaction_Nm", 1e3}},
                                        {"eig1", {"stability.min_eigenvalue_Nmm"}}};
  for (const std::string side : {"medial", "lateral"}) {
    of["N_" + side] = {side + ".force_N"};
    for (const std::string axis : {"x", "y", "z"}) {
      of[side + "_tib_" + axis] = {side + ".tibia_" + side + "." + axis + "_mm"};
      of[side + "_fem_" + axis] = {side + ".femur_" + side + "." + axis + "_mm"};
    }
  }
  for (const std::string name : {"AAC", "PAC", "APC", "PPC", "LC", "AMC", "PMC"}) {
    of[name + "_L"] = {name + ".length_mm"};
    of[name + "_strain"] = {name + ".strain"};
    of[name + "_F"] = {name + ".force_N"};
  }
  return of;
}

/// Row of the table with this flexion; rows() where there is none.
std::size_t row_at(const ResultTable& table, double flexion) {
  std::size_t row = 0;
  while (row < table.rows() && std::abs(table.number(row, "knee.flexion_deg") - flexion) > 1e-9) ++row;
  return row;
}

TEST(DortmansKnee, OneRunGivesEveryColumnOfTheReference) {
  GENU_NEEDS_DATA("../reference/dortmans_knee_10deg.csv")
  constexpr double kTolerance = 1e-8;  // of max(1, |value|) in the reference's units: mm, deg, N, N mm
  const Csv reference = read_csv(test::data_path("../reference/dortmans_knee_10deg.csv"));
  ASSERT_EQ(reference.rows.size(), 8u);

  Diagnostics problems;
  const auto prepared = prepare(genu::test::source_folder() + "/meshes/dortmans1984/scene.toml", problems);
  ASSERT_TRUE(prepared) << to_string(problems.items().front());
  ContactField field(prepared->model);
  const Solution solution = test::judged(*prepared, solve(*prepared, field, {}));
  EXPECT_EQ(solution.summary.exit_code, kExitOk);
  EXPECT_EQ(solution.poses.rows(), 71u);

  const auto known = counterparts();
  for (std::size_t c = 0; c < reference.names.size(); ++c) {
    const std::string& name = reference.names[c];
    ASSERT_TRUE(known.contains(name)) << "the reference has a column that this test does not know: " << name;
    const auto& [column, factor] = known.at(name);
    ASSERT_TRUE(solution.poses.has_column(column)) << column;
    double worst = 0, where = 0;
    for (const auto& values : reference.rows) {
      const std::size_t row = row_at(solution.poses, values[0]);
      ASSERT_LT(row, solution.poses.rows()) << "no row at flexion " << values[0];
      const double found = factor * solution.poses.number(row, column);
      const double error = std::abs(found - values[c]) / std::max(1.0, std::abs(values[c]));
      if (!(error <= worst)) worst = error, where = values[0];
    }
    EXPECT_LE(worst, kTolerance) << name << " at " << where << " deg";
    fmt::print("  {:<16} {:<28} worst {:.1e} at {:.0f} deg\n", name, column, worst, where);
  }
}

}  // namespace
}  // namespace genu
