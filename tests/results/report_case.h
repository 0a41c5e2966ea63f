// A small result to be shown: one body on another, two rows, the second of them not solved.
#pragma once

#include "genu/results/report.h"

namespace genu::test {

struct ReportCase {
  PlacedScene scene;
  JointModel model;
  RunSummary summary;
  ResultTable poses, events;

  ReportCase() {
    scene.file = "dir/knee.toml";
    scene.bodies.resize(2);
    scene.bodies[1].mass = 2;
    scene.bodies[1].centre_of_mass = Vec3(0, 0, 0.003);
    model.bodies = {{"femur", -1}, {"tibia", 0, Vec3(0.5, 0, 0)}};
    model.moving_count = 1;
    model.reference_poses = {Pose{}, Pose{Mat3::Identity(), Vec3(1000, 0, 0)}};
    LigamentDef l;
    l.name = "ACL1";
    l.from = {0, Vec3(0.001, 0, 0)};
    l.to = {1, Vec3(0, 0.002, 0)};
    scene.ligaments.push_back(l);
    summary.scene_file = scene.file;
    summary.title = "knee";
    summary.version = "1.2.3";
    summary.poses_asked = 2;
    summary.poses_solved = 1;
    summary.exit_code = 3;
    summary.verdict = {"1 of 2 poses are solved."};
    summary.effects.push_back({"ligaments", 1, "no unknowns", 21, 0.5});
    summary.seconds.emplace_back("solving", 0.25);
    for (const char* name : {"status", "knee.x_mm"}) poses.add_column(name);
    poses.add_row();
    poses.set("status", std::string("ok"));
    poses.set("knee.x_mm", 2.0);
    poses.add_row();
    poses.set("status", std::string("no_equilibrium"));
  }

  ReportRun run() const {
    ReportRun r;
    r.scene = &scene;
    r.model = &model;
    r.summary = &summary;
    r.poses = &poses;
    r.events = &events;
    r.scene_text = "format = 1\n";
    r.chart.x_title = "row of results.csv";
    r.chart.x = {1, 2};
    r.body_poses = {{Pose{}, Pose{Mat3::Identity(), Vec3(1000.002, 0, 0)}}, {}};
    r.meshes = {{"plate", 1, ReportMesh::Kind::bone, {{0, 0, 0}, {0.01, 0, 0}, {0, 0.01, 0}}, {{0, 1, 2}}, 7}};
    return r;
  }
};

}  // namespace genu::test
