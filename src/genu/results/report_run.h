// What report.html is made from: one solved scene, and what its bones, surfaces and contacts look like.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "genu/model/joint_model.h"
#include "genu/results/chart.h"
#include "genu/results/result_table.h"
#include "genu/results/summary.h"

namespace genu {

/// Triangles to be looked at, in the frame of their body's pose. They are never computed with.
struct ReportMesh {
  enum class Kind { surface, bone };
  std::string name;
  int body = 0;  ///< index into JointModel::bodies
  Kind kind = Kind::surface;
  std::vector<Vec3> vertices;  ///< m
  std::vector<std::array<int, 3>> triangles;
  std::size_t triangles_in_full = 0;  ///< what it was made from, where it was thinned out for the page
};

/// Where one contact, or one region of an elastic layer, carries load in each row: in the frame of the second body's
/// pose, NaN where it does not.
struct ReportContact {
  std::string name, surface;  ///< of the second body
  int body_a = 0, body_b = 0;
  std::vector<Vec3> point;  ///< m
  std::vector<Vec3> force;  ///< N, on the second body
};

/// The course of a ligament that wraps round surfaces, in each row: points on bodies, in the frames of their poses.
struct ReportPath {
  int ligament = -1;  ///< index into JointModel::ligaments
  struct Point {
    int body = 0;
    Vec3 p = Vec3::Zero();  ///< m
  };
  std::vector<std::vector<Point>> rows;  ///< empty where there is no pose
};

/// One result. What is pointed at must live until report_html() (report.h) returns.
struct ReportRun {
  const PlacedScene* scene = nullptr;
  const JointModel* model = nullptr;
  const RunSummary* summary = nullptr;
  const ResultTable* poses = nullptr;
  const ResultTable* events = nullptr;
  std::string scene_text;  ///< the file's own
  Chart chart;
  std::vector<std::vector<Pose>> body_poses;  ///< of each row the poses of all bodies; empty where there is none
  std::vector<ReportMesh> meshes;
  std::vector<ReportContact> contacts;
  std::vector<ReportPath> wrapped;
};

}  // namespace genu
