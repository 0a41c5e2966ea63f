// Rows of a pressure map add up to the columns of results.csv, for both ways to sum a layer.
#include "genu/results/pressure_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

#include "support/scene_model.h"

namespace genu {
namespace {

test::SceneModel soft_ball(const std::string& quadrature) {
  return test::scene_model(test::bone_on_ground("{ z = 19 }") + test::surface("ball", "bone", "sphere", "radius = 20") +
                           test::surface("floor", "ground", "plane") +
                           "[contact.foot]\nsurfaces = [\"ball\", \"floor\"]\nmodel = \"cartilage\"\nmodulus = 5\n"
                           "poisson = 0.4\nthickness = 4\n" +
                           quadrature + test::step(""));
}

struct Row {
  std::string surface;
  std::map<std::string, double> of;
};

std::vector<Row> parsed(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line, cell;
  std::vector<std::string> names;
  std::vector<Row> rows;
  while (std::getline(lines, line)) {
    std::istringstream cells(line);
    if (names.empty()) {
      while (std::getline(cells, cell, ',')) names.push_back(cell);
      continue;
    }
    rows.emplace_back();
    for (const std::string& name : names) {
      std::getline(cells, cell, ',');
      if (name == "surface")
        rows.back().surface = cell;
      else
        rows.back().of[name] = std::stod(cell);
    }
  }
  return rows;
}

TEST(PressureMap, AddsUpToTheColumns) {
  for (const std::string quadrature :
       {"quadrature = \"triangles\"\ncast_from = \"ball\"\n", "quadrature = \"triangles\"\ncast_from = \"floor\"\n",
        "quadrature = \"smooth\"\n"}) {
    const test::SceneModel scene = soft_ball(quadrature);
    std::vector<PoseRecord> records;
    for (int k = 0; k < 4; ++k) {
      PoseRecord r;
      r.point.step = 1;
      r.point.report.status = PoseStatus::ok;
      r.point.pose.state = reference_state(scene.model);
      // The second pose was not solved; the last is out of contact.
      if (k == 1) r.point.pose.state.poses.clear();
      if (k != 1)
        r.point.pose.state.poses[1] = {exp_rotation(Vec3(0.1 * k, 0.2, -0.3)),
                                       Vec3(1e-3 * k, 0, k == 3 ? 0.03 : 0.019)};
      r.point.pose.state.layer_levels = {k == 2 ? 1 : 0};
      records.push_back(r);
    }
    std::vector<StepPlan> steps(1);
    const ResultTable table = pose_table(scene.scene, scene.model, steps, records);
    const std::vector<Row> rows = parsed(pressure_map(scene.scene, scene.model, 0, records));
    double worst = 0;
    for (const std::size_t row : {0, 2}) {
      double area = 0, peak = 0, depth = 0, strain = 0, points = 0;
      Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
      for (const Row& r : rows) {
        if (r.of.at("row") != static_cast<double>(row + 1)) continue;
        const Vec3 f(r.of.at("force_x_N"), r.of.at("force_y_N"), r.of.at("force_z_N"));
        Vec3 x(r.of.at("x_mm"), r.of.at("y_mm"), r.of.at("z_mm"));
        if (r.surface == "ball") x = 1e3 * (records[row].point.pose.state.poses[1] * Vec3(1e-3 * x));
        force += f, moment += 1e-3 * x.cross(f), area += r.of.at("area_mm2"), ++points;
        peak = std::max(peak, r.of.at("pressure_MPa")), depth = std::max(depth, r.of.at("depth_mm"));
        strain = std::max(strain, r.of.at("strain"));
        EXPECT_NEAR(Vec3(r.of.at("normal_x"), r.of.at("normal_y"), r.of.at("normal_z")).norm(), 1, 1e-12);
        // Of a triangle (not of a node, which shares in its neighbours' pressure) the force is pressure times area.
        if (quadrature.find("triangles") != std::string::npos) {
          EXPECT_NEAR(f.norm(), r.of.at("pressure_MPa") * r.of.at("area_mm2"), 1e-12 * f.norm());
        }
      }
      ASSERT_GT(points, 100);
      const auto compare = [&](const std::string& column, double sum, double size) {
        worst = std::max(worst, std::abs(table.number(row, "foot." + column) - sum) / size);
      };
      compare("force_N", force.norm(), force.norm());
      for (Eigen::Index i = 0; i < 3; ++i) {
        compare(std::string("force_") + "xyz"[i] + "_N", force[i], force.norm());
        compare(std::string("moment_") + "xyz"[i] + "_Nm", moment[i], 0.01 * force.norm());
      }
      compare("area_mm2", area, area);
      compare("max_pressure_MPa", peak, peak);
      compare("max_depth_mm", depth, depth);
      compare("max_strain", strain, strain);
      compare("points", points, points);
    }
    EXPECT_LT(worst, 1e-12) << quadrature;
    for (const Row& r : rows) EXPECT_TRUE(r.of.at("row") == 1 || r.of.at("row") == 3);
  }
}

TEST(PressureMap, AFileForEachLayer) {
  const test::SceneModel scene = soft_ball("");
  const auto files = pressure_maps(scene.scene, scene.model, {});
  ASSERT_EQ(files.size(), 1u);
  EXPECT_EQ(files[0].first, "pressures_foot.csv");
  EXPECT_EQ(std::count(files[0].second.begin(), files[0].second.end(), '\n'), 1);
}

}  // namespace
}  // namespace genu
