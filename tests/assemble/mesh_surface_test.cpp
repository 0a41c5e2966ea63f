// A surface from the cache is the one that was built: to the last bit, with all that was said of it.
#include "genu/assemble/mesh_surface.h"

#include <filesystem>

#include <gtest/gtest.h>

#include "genu/mesh_care/mesh_damage.h"
#include "genu/mesh_files/mesh_writer.h"
#include "genu/surface/analytic.h"
#include "support/random_points.h"
#include "support/temporary_folder.h"

namespace genu {
namespace {

class CachedSurface : public testing::Test {
 protected:
  CachedSurface() { def_.shape = SurfaceDef::Shape::mesh; }

  void write(const Mesh& mesh) {
    def_.file = folder_ / "mesh.ply";
    ASSERT_EQ(write_ply(mesh, def_.file.text(), 1, ""), "");
  }
  MeshSurface build(bool facets = false) {
    MeshLibrary meshes;
    double seconds = 0;
    return mesh_surface(def_, facets, meshes, seconds, &cache_);
  }
  MeshSurface build_anew(bool facets = false) const {
    MeshLibrary meshes;
    double seconds = 0;
    return mesh_surface(def_, facets, meshes, seconds, nullptr);
  }
  std::size_t entries() const {
    const std::filesystem::path folder = folder_ / "cache";
    if (!std::filesystem::exists(folder)) return 0;
    return static_cast<std::size_t>(
        std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()));
  }
  /// Builds it without the cache, into the cache and from it.
  void expect_same(bool facets = false);

  test::TemporaryFolder folder_;
  DiskCache cache_{folder_ / "cache"};
  SurfaceDef def_;
};

void expect_equal(const Mesh& x, const Mesh& y) {
  EXPECT_EQ(x.vertices, y.vertices);
  EXPECT_EQ(x.triangles, y.triangles);
}

void expect_equal(const MeshSurface& x, const MeshSurface& y) {
  EXPECT_EQ(x.text, y.text);
  EXPECT_EQ(x.space, y.space);
  ASSERT_EQ(x.found.items().size(), y.found.items().size());
  for (std::size_t k = 0; k < x.found.items().size(); ++k)
    EXPECT_EQ(to_string(x.found.items()[k]), to_string(y.found.items()[k]));
  ASSERT_EQ(x.report.has_value(), y.report.has_value());
  EXPECT_EQ(x.report->edge_length, y.report->edge_length);
  EXPECT_EQ(x.report->box.high, y.report->box.high);
  EXPECT_EQ(x.report->boundary_loops, y.report->boundary_loops);
  ASSERT_EQ(x.steps.has_value(), y.steps.has_value());
  if (x.steps) {
    EXPECT_EQ(x.steps->height, y.steps->height);
  }
  ASSERT_EQ(x.blend != nullptr, y.blend != nullptr);
  ASSERT_EQ(x.facets != nullptr, y.facets != nullptr);
  const Surface& a = x.blend ? static_cast<const Surface&>(*x.blend) : *x.facets;
  const Surface& b = y.blend ? static_cast<const Surface&>(*y.blend) : *y.facets;
  expect_equal(a.triangles(0, Vec3::Zero(), 0), b.triangles(0, Vec3::Zero(), 0));
  ASSERT_EQ(a.doubtful().size(), b.doubtful().size());
  for (std::size_t k = 0; k < a.doubtful().size(); ++k) {
    EXPECT_EQ(a.doubtful()[k].what, b.doubtful()[k].what);
    EXPECT_EQ(a.doubtful()[k].points, b.doubtful()[k].points);
    EXPECT_EQ(a.doubtful()[k].reach, b.doubtful()[k].reach);
    EXPECT_EQ(a.doubtful()[k].missing, b.doubtful()[k].missing);
  }
  if (!x.blend) return;
  EXPECT_EQ(x.blend->facts().why, y.blend->facts().why);
  EXPECT_EQ(x.blend->facts().noise.rms, y.blend->facts().noise.rms);
  EXPECT_EQ(x.blend->facts().uncertainty.curvature, y.blend->facts().uncertainty.curvature);
  const SampleSet p = a.samples(0, Vec3::Zero(), 0), q = b.samples(0, Vec3::Zero(), 0);
  EXPECT_EQ(p.points, q.points);
  EXPECT_EQ(p.normals, q.normals);
  EXPECT_EQ(p.areas, q.areas);
  EXPECT_EQ(p.neighbours, q.neighbours);
  test::RandomPoints random(3);
  for (const Vec3& node : p.points) {
    const Vec3 near = node + random.in_ball(1e-3);
    ASSERT_EQ(a.gap(near), b.gap(near));
    ASSERT_EQ(a.edge_distance(node), b.edge_distance(node));
    SurfacePoint u, v;
    ASSERT_EQ(a.project(near, u), b.project(near, v));
    if (a.project(near, u)) {
      ASSERT_EQ(u.S, v.S);
    }
  }
}

void CachedSurface::expect_same(bool facets) {
  const MeshSurface fresh = build_anew(facets), first = build(facets);
  ASSERT_EQ(entries(), 1u);
  const auto written = std::filesystem::last_write_time(folder_ / "cache");  // changes with each new file in it
  const MeshSurface again = build(facets);
  EXPECT_EQ(entries(), 1u);
  EXPECT_EQ(std::filesystem::last_write_time(folder_ / "cache"), written) << "built again";
  expect_equal(fresh, first);
  expect_equal(fresh, again);
}

/// A sheet with an edge: the upper part of a ball.
Mesh cap() {
  Mesh mesh = make_sphere({}, 0.02, false)->triangles(1.5e-3, Vec3::Zero(), 1);
  std::erase_if(mesh.triangles, [&](const auto& t) {
    return mesh.vertices[at(t[0])].z() < 0.01 || mesh.vertices[at(t[1])].z() < 0.01 ||
           mesh.vertices[at(t[2])].z() < 0.01;
  });
  return mesh;
}

TEST_F(CachedSurface, SheetWithAnEdgeInItsBodysFrame) {
  write(cap());
  def_.placement = {exp_rotation({1, 2, 3}), {0.1, 0, -0.02}};
  def_.fit_radius = 5e-3;
  expect_same();
}

TEST_F(CachedSurface, FlawsAndWarnings) {
  const Mesh ball = make_sphere({}, 0.02, false)->triangles(1.5e-3, Vec3::Zero(), 1);
  Mesh damaged_ball = damaged_near(ball, MeshDamage::crossing, {0, 0, 0.02}, 3e-3);
  damaged_ball = damaged_near(damaged_ball, MeshDamage::hole, {0.02, 0, 0}, 3e-3);
  write(damaged(damaged_ball, MeshDamage::noise, 5e-5));
  ASSERT_GT(build_anew().found.items().size(), 0u);
  ASSERT_GT(build_anew().blend->doubtful().size(), 1u);
  expect_same();
}

TEST_F(CachedSurface, CreasesPartTheSheetsAsBefore) {
  Mesh box;
  for (int k = 0; k < 8; ++k) box.vertices.emplace_back(0.02 * (k & 1), 0.03 * (k >> 1 & 1), 0.025 * (k >> 2));
  box.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                   {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
  write(damaged(damaged(damaged(box, MeshDamage::subdivide, 4), MeshDamage::shift, 0, {1e-3, 0, 0}),
                MeshDamage::inside_out, 0));
  ASSERT_GT(build_anew().blend->facts().sheet_count, 1);
  expect_same();
}

TEST_F(CachedSurface, TrianglesAsTheyAre) {
  write(damaged_near(cap(), MeshDamage::hole, {0, 0, 0.02}, 2e-3));
  expect_same(true);
}

TEST_F(CachedSurface, PiecesInSeveralFiles) {
  for (const bool left : {true, false}) {
    Mesh half = cap();
    std::erase_if(half.triangles, [&](const auto& t) {
      const double middle = half.vertices[at(t[0])].x() + half.vertices[at(t[1])].x() + half.vertices[at(t[2])].x();
      return (middle < 0) != left;
    });
    const std::string file = folder_ / (left ? "left.ply" : "right.ply");
    ASSERT_EQ(write_ply(half, file, 1, ""), "");
    def_.file.paths.push_back(file);
  }
  ASSERT_NE(build_anew().text.find("left.ply"), std::string::npos) << build_anew().text;
  expect_same();
}

TEST_F(CachedSurface, WhateverItDependsOnMakesItAnother) {
  write(cap());
  std::size_t count = 0;
  const auto expect_new = [&](const char* what, bool facets = false) {
    const MeshSurface cached = build(facets);
    EXPECT_EQ(entries(), ++count) << what;
    expect_equal(build_anew(facets), cached);
  };
  expect_new("first");
  def_.fit_radius = 6e-3;
  expect_new("fit radius");
  def_.degree = 4;
  expect_new("degree");
  def_.placement.p.x() = 1e-9;
  expect_new("placement");
  def_.inside = true;
  expect_new("inside");
  def_.file_unit = 2;
  expect_new("unit");
  expect_new("facets", true);
  Mesh other = cap();
  other.vertices[3] += Vec3(0, 0, 1e-6);
  write(other);
  expect_new("content");
  std::filesystem::copy_file(folder_ / "mesh.ply", folder_ / "copy.ply");
  def_.file = folder_ / "copy.ply";  // messages name it
  expect_new("name");
}

TEST_F(CachedSurface, MeshesInMemoryAndFaultyOnesAreNotKept) {
  write(cap());
  MeshLibrary meshes;
  meshes.put(def_.file.text(), make_sphere({}, 0.03, false)->triangles(2e-3, Vec3::Zero(), 1));
  double seconds = 0;
  const MeshSurface ball = mesh_surface(def_, false, meshes, seconds, &cache_);
  EXPECT_EQ(entries(), 0u);
  EXPECT_EQ(ball.report->boundary_loops, 0u);
  def_.file = folder_ / "none.ply";
  EXPECT_TRUE(build().found.has_errors());
  def_.file = folder_.write("broken.ply", "ply\n");
  EXPECT_TRUE(build().found.has_errors());
  EXPECT_EQ(entries(), 0u);
}

}  // namespace
}  // namespace genu
