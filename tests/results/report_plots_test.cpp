#include "genu/results/report_plots.h"

#include <cmath>

#include <gtest/gtest.h>

#include "genu/results/moment_arm_columns.h"

namespace genu {
namespace {

const ChartPanel* panel_titled(const Chart& chart, const std::string& title) {
  for (const ChartPanel& p : chart.panels)
    if (p.title == title) return &p;
  return nullptr;
}

TEST(ReportPlots, ShowTheMeanStrainOfLigamentsWhoseForceIsDrawn) {
  PlacedScene scene;
  for (const char* name : {"ACL1", "ACL2", "PCL", "spring"}) {
    LigamentDef l;
    l.name = name;
    scene.ligaments.push_back(l);
  }
  ResultTable poses;
  for (const char* column : {"ACL1.strain", "ACL2.strain", "PCL.strain", "spring.strain"}) poses.add_column(column);
  for (const double strain : {0.01, 0.02}) {
    poses.add_row();
    poses.set("ACL1.strain", strain);
    poses.set("ACL2.strain", 3 * strain);
    poses.set("PCL.strain", -strain);
  }
  Chart chart;
  chart.panels = {{"Ligament force [N]", {{"PCL", {0, 0}}, {"ACL", {1, 2}}, {"spring", {3, 3}}}}, {"last", {}}};
  add_report_plots(scene, poses, chart);
  ASSERT_EQ(chart.panels.size(), 3u);
  const ChartPanel& strain = chart.panels[1];
  EXPECT_EQ(strain.title, "Ligament strain, mean of fibres [%]");
  ASSERT_EQ(strain.series.size(), 2u);  // a spring of no slack length has no strain
  EXPECT_EQ(strain.series[0].name, "PCL");
  EXPECT_DOUBLE_EQ(strain.series[0].y[1], -2);
  EXPECT_EQ(strain.series[1].name, "ACL");
  EXPECT_DOUBLE_EQ(strain.series[1].y[0], 2);
}

TEST(ReportPlots, ShowMomentArmsThatASceneAsksFor) {
  PlacedScene scene;
  for (const char* name : {"ACL1", "ACL2", "PFL"}) {
    LigamentDef l;
    l.name = name;
    scene.ligaments.push_back(l);
  }
  LoadDef muscle;
  muscle.name = "muscle";
  scene.loads.push_back(muscle);
  JointDef knee;
  knee.name = "knee";
  knee.rotations[0].name = "flexion";
  scene.joints.push_back(knee);
  scene.moment_arms = {{0, 0}};
  ResultTable poses;
  for (const std::string path : {"ACL1", "ACL2", "PFL", "muscle"})
    poses.add_column(moment_arm_column(scene, path, {0, 0}));
  poses.add_row();
  poses.set("ACL1.moment_arm.knee.flexion_mm", 1.0);
  poses.set("ACL2.moment_arm.knee.flexion_mm", 4.0);
  poses.set("PFL.moment_arm.knee.flexion_mm", 1e-13);  // none about this coordinate
  poses.set("muscle.moment_arm.knee.flexion_mm", -30.0);
  Chart chart;
  add_report_plots(scene, poses, chart);
  const ChartPanel* panel = panel_titled(chart, "Moment arms about knee.flexion, mean of fibres [mm]");
  ASSERT_NE(panel, nullptr);
  ASSERT_EQ(panel->series.size(), 2u);
  EXPECT_EQ(panel->series[0].name, "ACL");
  EXPECT_DOUBLE_EQ(panel->series[0].y[0], 2.5);
  EXPECT_EQ(panel->series[1].name, "muscle");
  EXPECT_DOUBLE_EQ(panel->series[1].y[0], -30);
}

TEST(ReportPlots, ShowLayersJointForcesAndTheClinicalDescription) {
  PlacedScene scene;
  JointDef knee;
  knee.name = "knee";
  knee.grood_suntay = GroodSuntayDef{};
  scene.joints.push_back(knee);
  LayerDef layer;
  layer.pair.name = "cartilage";
  layer.pair.regions = {{"medial", {}}};
  scene.layers.push_back(layer);
  ResultTable poses;
  for (const char* column :
       {"knee.gs.flexion_deg", "knee.gs.anterior_mm", "cartilage.area_mm2", "cartilage.medial.area_mm2",
        "knee.reaction.force_x_N", "knee.reaction.force_y_N", "knee.reaction.force_z_N"})
    poses.add_column(column);
  poses.add_row();
  poses.set("knee.gs.flexion_deg", 30.0);
  poses.set("cartilage.area_mm2", 120.0);
  poses.set("knee.reaction.force_x_N", 3.0);
  poses.set("knee.reaction.force_y_N", 4.0);
  poses.set("knee.reaction.force_z_N", 12.0);
  Chart chart;
  add_report_plots(scene, poses, chart);
  const ChartPanel* clinical = panel_titled(chart, "Grood and Suntay: rotations [deg]");
  ASSERT_NE(clinical, nullptr);
  EXPECT_EQ(clinical, &chart.panels.front()) << "words of the field before names of the scene";
  EXPECT_EQ(clinical->series[0].name, "flexion");
  EXPECT_EQ(clinical->series[0].y[0], 30);
  EXPECT_EQ(clinical->series[0].column, "knee.gs.flexion_deg");
  const ChartPanel* area = panel_titled(chart, "Contact area [mm2]");
  ASSERT_NE(area, nullptr);
  ASSERT_EQ(area->series.size(), 2u);
  EXPECT_EQ(area->series[0].name, "medial");
  EXPECT_EQ(area->series[0].column, "cartilage.medial.area_mm2");
  EXPECT_TRUE(std::isnan(area->series[0].y[0]));
  EXPECT_EQ(area->series[1].y[0], 120);
  const ChartPanel* force = panel_titled(chart, "Joint force [N]");
  ASSERT_NE(force, nullptr);
  EXPECT_DOUBLE_EQ(force->series[0].y[0], 13);
  EXPECT_EQ(force->series[0].column, "");
  EXPECT_EQ(panel_titled(chart, "Largest contact pressure [MPa]"), nullptr);
}

TEST(ReportPlots, ShowThePatellaInPanelsOfItsOwn) {
  PlacedScene scene;
  scene.bodies.resize(3);
  JointDef pf;
  pf.name = "pf";
  pf.grood_suntay = GroodSuntayDef{};
  pf.grood_suntay->patella = true;
  pf.grood_suntay->femur.body = 0;
  pf.grood_suntay->tibia.body = 2;
  scene.joints.push_back(pf);
  LoadDef muscle;
  muscle.name = "rectus";
  muscle.kind = LoadDef::Kind::toward;
  muscle.body = 2;
  muscle.toward_body = 0;
  scene.loads.push_back(muscle);
  LigamentDef tendon;
  tendon.name = "PT";
  tendon.from.body = 2;
  tendon.to.body = 1;
  scene.ligaments.push_back(tendon);
  ResultTable poses;
  for (const char* column : {"pf.gs.lateral_tilt_deg", "pf.gs.lateral_shift_mm", "pf.quadriceps.force_N",
                             "pf.patellar_tendon.force_N", "pf.tendon_to_quadriceps"})
    poses.add_column(column);
  poses.add_row();
  poses.set("pf.gs.lateral_tilt_deg", 7.0);
  poses.set("pf.tendon_to_quadriceps", 0.9);
  Chart chart;
  add_report_plots(scene, poses, chart);
  EXPECT_EQ(panel_titled(chart, "Grood and Suntay: rotations [deg]"), nullptr);
  const ChartPanel* tilt = panel_titled(chart, "Patella: rotations [deg]");
  ASSERT_NE(tilt, nullptr);
  EXPECT_EQ(tilt->series[0].name, "lateral_tilt");
  EXPECT_EQ(tilt->series[0].y[0], 7);
  ASSERT_NE(panel_titled(chart, "Patella: translations [mm]"), nullptr);
  const ChartPanel* forces = panel_titled(chart, "Extensor mechanism [N]");
  ASSERT_NE(forces, nullptr);
  ASSERT_EQ(forces->series.size(), 2u);
  EXPECT_EQ(forces->series[1].name, "patellar tendon");
  const ChartPanel* ratio = panel_titled(chart, "Force of the patellar tendon per force of the quadriceps");
  ASSERT_NE(ratio, nullptr);
  EXPECT_EQ(ratio->series[0].y[0], 0.9);
}

}  // namespace
}  // namespace genu
