// A line a question: the number and the verdict for meshes with one thing wrong.
#include "genu/mesh_care/mesh_examination.h"

#include <algorithm>
#include <cstdio>

#include <gtest/gtest.h>

#include "genu/mesh/mesh_check.h"
#include "support/blend_meshes.h"
#include "support/dirt.h"

namespace genu {
namespace {

using test::Dirt;
using Verdict = MeshFinding::Verdict;

MeshExamination examined(const Mesh& mesh, double unit = 1e-3) {
  return examine_mesh(mesh, {mesh.vertices.size(), mesh.triangles.size(), {}, 0}, unit);
}

MeshFinding finding(const MeshExamination& e, const std::string& question) {
  const auto it =
      std::find_if(e.findings.begin(), e.findings.end(), [&](const auto& f) { return f.question == question; });
  EXPECT_NE(it, e.findings.end()) << question;
  return it == e.findings.end() ? MeshFinding{} : *it;
}

const Mesh kTorus = test::jittered_torus(15e-3, 5e-3, 0.8e-3);

TEST(MeshExamination, OfACleanMeshIsGood) {
  const MeshExamination e = examined(kTorus);
  EXPECT_FALSE(e.bad());
  for (const MeshFinding& f : e.findings) {
    EXPECT_EQ(f.verdict, Verdict::good) << f.question << " " << f.number << " " << f.why;
    EXPECT_FALSE(f.number.empty());
  }
}

TEST(MeshExamination, SizesHaveDigitsHoweverSmallTheMesh) {
  Mesh small = kTorus;
  for (Vec3& v : small.vertices) v *= 1e-4;
  const MeshExamination e = examined(small), large = examined(kTorus);
  for (const char* question : {"edges 5/50/95 %", "thickness 5/50/95 %"}) {
    double a[3], b[3];
    ASSERT_EQ(std::sscanf(finding(e, question).number.c_str(), "%lf / %lf / %lf mm", &a[0], &a[1], &a[2]), 3);
    ASSERT_EQ(std::sscanf(finding(large, question).number.c_str(), "%lf / %lf / %lf mm", &b[0], &b[1], &b[2]), 3);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(a[k] / b[k], 1e-4, 1e-6) << finding(e, question).number;
  }
  double small_fit = 0, large_fit = 0;
  ASSERT_EQ(std::sscanf(finding(e, "noise").why.c_str(), "fit radius %lf mm", &small_fit), 1);
  ASSERT_EQ(std::sscanf(finding(large, "noise").why.c_str(), "fit radius %lf mm", &large_fit), 1);
  EXPECT_NEAR(small_fit / large_fit, 1e-4, 1e-6);
}

TEST(MeshExamination, EachDirtHasItsLine) {
  const std::tuple<Dirt, const char*, Verdict> cases[] = {{Dirt::fin, "non-manifold edges", Verdict::bad},
                                                          {Dirt::flipped, "flipped faces", Verdict::note},
                                                          {Dirt::hole, "holes", Verdict::bad},
                                                          {Dirt::crossing, "self-intersections", Verdict::bad},
                                                          {Dirt::stray, "stray pieces", Verdict::bad},
                                                          {Dirt::spike, "spikes", Verdict::bad},
                                                          {Dirt::slivers, "sliver faces", Verdict::note}};
  for (const auto& [dirt, question, verdict] : cases) {
    const MeshExamination e = examined(test::dirtied(kTorus, dirt, {20e-3, 0, 0}, 2e-3));
    const MeshFinding f = finding(e, question);
    EXPECT_EQ(f.verdict, verdict) << question << " " << f.number;
    EXPECT_NE(f.number, "0") << question;
    EXPECT_EQ(e.bad(), verdict == Verdict::bad) << question;
    EXPECT_TRUE(verdict != Verdict::bad || f.why.find("near (") != std::string::npos) << f.why;
  }
}

TEST(MeshExamination, OrientationOfClosedAndOpen) {
  Mesh turned = kTorus;
  for (auto& t : turned.triangles) std::swap(t[1], t[2]);
  EXPECT_EQ(finding(examined(turned), "inside-out pieces").verdict, Verdict::bad);
  const MeshFinding facing = finding(examined(test::jittered_patch(
                                         0.02, 1e-3, [](double, double) { return 0.0; }, true)),
                                     "open sheets face");
  EXPECT_EQ(facing.number, "(0.00, 0.00, -1.00)");
}

TEST(MeshExamination, WhatTheReaderNotedIsListed) {
  MeshFileFacts facts;
  facts.notes = {"has 2 bytes after its last triangle: they are left out"};
  const MeshExamination e = examine_mesh(kTorus, facts, 1e-3);
  EXPECT_EQ(finding(e, "format").verdict, Verdict::note);
  EXPECT_EQ(finding(e, "format").why, facts.notes[0]);
}

TEST(MeshExamination, TheVolumeTakesNestedPiecesForCavities) {
  Mesh nested = kTorus;
  const int n = static_cast<int>(kTorus.vertices.size());
  const MeshExamination whole = examined(kTorus);
  for (const Vec3& v : kTorus.vertices) {  // a thinner tube about the same circle
    const Vec3 flat(v.x(), v.y(), 0), circle = flat.normalized() * 0.015;
    nested.vertices.push_back(circle + 0.5 * (v - circle));
  }
  for (const auto& t : kTorus.triangles) nested.triangles.push_back({t[0] + n, t[1] + n, t[2] + n});
  const MeshExamination e = examined(nested);
  EXPECT_EQ(finding(e, "nested pieces").verdict, Verdict::note);
  EXPECT_NEAR(std::stod(finding(e, "volume").number), 0.75 * std::stod(finding(whole, "volume").number), 0.02);
}

TEST(MeshExamination, UnitsAreGuessedFromTheSize) {
  EXPECT_EQ(guess_unit(83), "mm");
  EXPECT_EQ(guess_unit(0.083), "m");
  EXPECT_EQ(guess_unit(3), "cm");
  EXPECT_EQ(guess_unit(83000), "um");
  EXPECT_EQ(guess_unit(1e9), "");
  EXPECT_EQ(guess_unit(0), "");
  Mesh huge = kTorus;
  for (Vec3& v : huge.vertices) v *= 1000;
  EXPECT_EQ(finding(examined(huge, 1e-3), "size").verdict, Verdict::bad);
  MeshFileFacts facts{1, 1, {}, 6e-5, true};
  EXPECT_EQ(finding(examine_mesh(kTorus, facts, 1e-3), "coordinates rounded to").verdict, Verdict::bad);
}

}  // namespace
}  // namespace genu
