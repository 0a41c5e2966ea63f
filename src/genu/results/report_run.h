// What report.html is made from: one solved scene, and what its bones, surfaces and contacts look like.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "genu/model/joint_model.h"
#include "genu/results/chart.h"
#include "genu/results/result_table.h"
#include "genu/results/summary.h"

namespace genu {

/// Triangles to be looked at, in the frame of their body's pose. They are never computed with.
struct ReportMesh {
  enum class Kind { surface, bone, wrapped };  ///< wrapped: it guides paths alone and must not hide bones
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

/// The course of a ligament or cable that wraps round surfaces, in each row: points on bodies, in the frames of their
/// poses.
struct ReportPath {
  int ligament = -1;  ///< index into JointModel::ligaments; -1 for a cable
  struct Point {
    int body = 0;
    Vec3 p = Vec3::Zero();  ///< m
  };
  std::vector<std::vector<Point>> rows;  ///< empty where there is no pose
};

/// Where the casting surface of an elastic layer carries load in each row, to be coloured. Its sites are triangles of a
/// mesh that is shown, or places of a lattice.
struct ReportPressure {
  std::string contact, surface;  ///< the surface is the one that casts
  int body = 0;                  ///< of the surface
  int mesh = -1;                 ///< index into ReportRun::meshes of `triangles`; -1 where sites are `places`
  std::vector<int> triangles;    ///< of each site, in that mesh
  std::vector<Vec3> places;      ///< m, of each site, in the frame of the body's pose
  std::vector<double> radii;     ///< m, of the disc with the area of a site
  struct Sample {
    int site = 0;
    double pressure = 0;  ///< Pa
  };
  std::vector<std::vector<Sample>> rows;  ///< a site at most once in each
  std::size_t every = 1;                  ///< rows from one that has samples to the next: those between were left out
};

/// A measured or published table to be drawn beside the computed one: points over any of its columns.
struct ReportBeside {
  std::string name;  ///< of the file, without folders
  struct Column {
    std::string column;           ///< of results.csv, with its unit
    std::string in_file;          ///< what the file calls it
    std::vector<double> numbers;  ///< of each row of the file, NaN where nothing was measured
  };
  std::vector<Column> columns;
  std::size_t every = 1;  ///< of how many rows of the file one is shown
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
  std::vector<ReportPath> wrapped;  ///< of ligaments
  std::vector<ReportPath> cables;   ///< not drawn: they tell where surfaces are touched
  std::vector<ReportPressure> pressures;
  std::vector<ReportBeside> beside;
  std::vector<std::string> coordinates;        ///< columns of `poses` that may be the axis of curves
  std::string main_coordinate;                 ///< the one of them that the scene is about; empty: rows
  std::size_t rows_in_full = 0;                ///< of results.csv, where rows are left out
  std::size_t every = 1;                       ///< of how many rows of results.csv one is shown
  std::size_t events_in_full = 0;              ///< of the run, where events are left out of `chart`
  std::size_t text_in_full = 0;                ///< bytes of the scene file, where its end is left out
  std::vector<std::string> left_out;           ///< in words: what the page shows less of
  std::shared_ptr<const ResultTable> thinned;  ///< what `poses` points at, where rows are left out
};

}  // namespace genu
