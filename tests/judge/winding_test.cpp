// Patches wound inside out are turned back, by the judge's own lights.
#include "genu/judge/winding.h"

#include <gtest/gtest.h>

namespace genu::judge {
namespace {

double volume(const std::vector<Vec3>& v, const std::vector<std::array<int, 3>>& triangles) {
  double sum = 0;
  for (const auto& c : triangles) sum += v[at(c[0])].dot(v[at(c[1])].cross(v[at(c[2])])) / 6;
  return sum;
}

struct Octahedron {
  std::vector<Vec3> v = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  std::vector<std::array<int, 3>> t = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                                       {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
};

TEST(Winding, FollowsMostOfThePiece) {
  const Octahedron whole;
  for (const std::vector<int>& flipped : {std::vector<int>{}, {0}, {7, 2}, {1, 4, 6}}) {
    Octahedron o;
    for (const int k : flipped) std::swap(o.t[at(k)][0], o.t[at(k)][1]);
    align_winding(o.v, o.t);
    EXPECT_NEAR(volume(o.v, o.t), 4.0 / 3, 1e-15);
  }
  Octahedron inverted;
  for (auto& t : inverted.t) std::swap(t[0], t[2]);
  std::swap(inverted.t[3][1], inverted.t[3][2]);
  align_winding(inverted.v, inverted.t);
  EXPECT_NEAR(volume(inverted.v, inverted.t), -4.0 / 3, 1e-15) << "a piece that is inside out is left so";
}

TEST(Winding, PiecesAreTurnedEachByItself) {
  Octahedron two;
  const Octahedron one;
  for (const Vec3& v : one.v) two.v.push_back(v + Vec3(5, 0, 0));
  for (auto t : one.t) {
    for (int& i : t) i += 6;
    std::swap(t[0], t[1]);
    two.t.push_back(t);
  }
  align_winding(two.v, two.t);
  EXPECT_NEAR(volume(two.v, two.t), 0, 1e-14) << "the second one was wound inside out throughout";
}

TEST(Winding, WhatClosesIsTurnedOutwardAndSheetsAreNot) {
  Octahedron whole, inverted, open;
  for (auto& t : inverted.t) std::swap(t[0], t[2]);
  for (Octahedron* o : {&whole, &inverted}) {
    turn_closed_outward(o->v, o->t);
    EXPECT_NEAR(volume(o->v, o->t), 4.0 / 3, 1e-15);
  }
  for (auto& t : open.t) std::swap(t[0], t[2]);
  open.t.pop_back();
  const auto before = open.t;
  turn_closed_outward(open.v, open.t);
  EXPECT_EQ(open.t, before);
}

}  // namespace
}  // namespace genu::judge
