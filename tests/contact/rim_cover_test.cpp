// The share of a disc over an open mesh: against a count of points, and its rates against differences.
#include "genu/contact/rim_cover.h"

#include <random>

#include <gtest/gtest.h>

#include "support/layers.h"

namespace genu {
namespace {

constexpr double kDiscReach = 5e-3, kDiscRadius = 0.4e-3;

/// A wavy sheet with a ragged border, a hole and a crack: some triangles of test::sheet() and no vertex on the border
/// where it was.
Mesh ragged() {
  const Mesh whole = test::sheet(3e-3, 12);
  Mesh mesh;
  mesh.vertices = whole.vertices;
  for (Vec3& v : mesh.vertices)
    v.z() = 0.2e-3 * std::sin(900 * v.x()) + 0.15e-3 * std::cos(700 * v.y() + 1) + 40 * v.x() * v.y();
  for (std::size_t t = 0; t < whole.triangles.size(); ++t)
    if (t % 24 < 12 + (t / 24) % 3 && t != 100 && t != 101) mesh.triangles.push_back(whole.triangles[t]);
  // A crack: the two sides have vertices of their own.
  const int first = static_cast<int>(mesh.vertices.size());
  for (const int v : {4 * 13 + 3, 4 * 13 + 4}) mesh.vertices.push_back(mesh.vertices[at(v)]);
  for (auto& t : mesh.triangles) {
    double y = 0;
    for (const int v : t) y += mesh.vertices[at(v)].y() / 3;
    if (y < mesh.vertices[4 * 13].y()) continue;
    for (int& v : t)
      if (v == 4 * 13 + 3 || v == 4 * 13 + 4) v = first + v - (4 * 13 + 3);
  }
  return mesh;
}

std::shared_ptr<const ThicknessField> thickness(const Mesh& mesh) {
  std::vector<double> h;
  for (const Vec3& v : mesh.vertices) h.push_back(2e-3 + 0.1 * v.x() - 0.2 * v.y());
  return std::make_shared<const ThicknessField>(mesh, h);
}

/// Discs about rays from below the sheet, near its border, each at its own pose.
template <typename Visit>
void each_disc(const Mesh& mesh, int count, Visit visit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> in(-1, 1);
  const TriangleTree tree(mesh);
  for (int i = 0; i < count; ++i) {
    const Vec3 turn{0.3 * in(random), 0.3 * in(random), 3 * in(random)}, p{in(random), in(random), in(random)};
    const Pose X_TC{exp_rotation(turn), 1e-3 * p};
    const Vec3 start{3.2e-3 * in(random), 3.2e-3 * in(random), -2e-3 + 0.5e-3 * in(random)};
    const Vec3 aim = Vec3{0.2 * in(random), 0.2 * in(random), 1}.normalized();
    const Pose X_CT = X_TC.inverse();
    const RimCover::Disc disc{{X_CT * start, X_CT.R * aim}, kDiscRadius, kDiscReach};
    visit(disc, X_TC, tree.leaving(start, aim, kDiscReach));
  }
}

RimCover::Cover cover_of(const RimCover& rim, const RimCover::Disc& disc, const Pose& X_TC,
                         const TriangleTree::Hit& hit) {
  return hit ? rim.over(X_TC, disc, hit.distance) : rim.beside(X_TC, disc);
}

TEST(RimCover, ShareIsThatOfPoints) {
  const Mesh mesh = ragged();
  const RimCover rim(mesh, nullptr);
  const TriangleTree tree(mesh);
  double worst = 0;
  int parted = 0;
  each_disc(mesh, 300, [&](const RimCover::Disc& disc, const Pose& X_TC, const TriangleTree::Hit& hit) {
    const double share = cover_of(rim, disc, X_TC, hit).share;
    const Vec3 x = disc.ray.direction.unitOrthogonal(), y = disc.ray.direction.cross(x);
    constexpr int kPoints = 4000;
    int over = 0;
    for (int i = 0; i < kPoints; ++i) {
      const double r = kDiscRadius * std::sqrt((i + 0.5) / kPoints), turn = 2.399963229728653 * i;  // sunflower
      const Vec3 p = disc.ray.origin + r * (std::cos(turn) * x + std::sin(turn) * y);
      over += static_cast<bool>(tree.leaving(X_TC * p, X_TC.R * disc.ray.direction, kDiscReach));
    }
    const double expected = static_cast<double>(over) / kPoints;
    worst = std::max(worst, std::abs(share - expected));
    parted += share > 0.01 && share < 0.99;
  });
  std::printf("%d discs cut by the border, largest error of a share %.1e\n", parted, worst);
  EXPECT_GT(parted, 80);
  EXPECT_LT(worst, 6e-3);
}

TEST(RimCover, RatesAreDerivatives) {
  const Mesh mesh = ragged();
  const RimCover rim(mesh, thickness(mesh));
  int compared = 0;
  double worst = 0;
  each_disc(mesh, 500, [&](const RimCover::Disc& disc, const Pose& X_TC, const TriangleTree::Hit& hit) {
    const RimCover::Cover here = cover_of(rim, disc, X_TC, hit);
    if (!(here.share > 1e-3 && here.share < 1 - 1e-3)) return;
    ++compared;
    for (int i = 0; i < 6; ++i) {
      Vec6 twist = Vec6::Zero();
      twist[i] = i < 3 ? 1e-9 : 1e-7;
      const auto moved = [&](double sign) {
        const Pose X = X_TC * Pose{exp_rotation(sign * twist.tail<3>()), sign * twist.head<3>()};
        return hit ? rim.over(X, disc, hit.distance) : rim.beside(X, disc);
      };
      const RimCover::Cover ahead = moved(1), behind = moved(-1);
      const auto off = [&](double one, double other, double rate, double unit) {
        return std::abs((one - other) / (2 * twist[i]) - rate) * (i < 3 ? kDiscRadius : 1e-2) / unit;
      };
      worst = std::max({worst, off(ahead.share, behind.share, here.share_rate[i], 1),
                        off(ahead.depth, behind.depth, here.depth_rate[i], kDiscReach),
                        off(ahead.thickness, behind.thickness, here.thickness_rate[i], kDiscReach)});
    }
  });
  std::printf("%d discs, largest error of a rate %.1e\n", compared, worst);
  EXPECT_GT(compared, 100);
  EXPECT_LT(worst, 1e-4);
}

/// Along straight ways over the border nothing steps: with half the step half the change.
TEST(RimCover, IsContinuous) {
  const Mesh mesh = ragged();
  const RimCover rim(mesh, thickness(mesh));
  const TriangleTree tree(mesh);
  double most_share = 0, most_depth = 0;
  int crossings = 0;
  each_disc(mesh, 60, [&](const RimCover::Disc& disc, const Pose& X_TC, const TriangleTree::Hit&) {
    constexpr int kSteps = 20000;
    const Vec3 way = 4 * kDiscRadius / kSteps * disc.ray.direction.unitOrthogonal();
    struct {
      bool hit = false;
      double share = 0, depth = 0;
    } last;
    for (int i = 0; i <= kSteps; ++i) {
      const Pose X = X_TC * Pose{Mat3::Identity(), (i - kSteps / 2) * way};
      const auto hit = tree.leaving(X * disc.ray.origin, X.R * disc.ray.direction, kDiscReach);
      const RimCover::Cover here = cover_of(rim, disc, X, hit);
      const double depth = hit ? hit.distance : here.depth;
      if (i > 0) most_share = std::max(most_share, std::abs(here.share - last.share));
      if (i > 0 && here.share > 0.01 && last.share > 0.01) {
        most_depth = std::max(most_depth, std::abs(depth - last.depth));
        if (static_cast<bool>(hit) != last.hit) ++crossings;
      }
      last = {static_cast<bool>(hit), here.share, depth};
    }
  });
  std::printf("%d crossings, largest steps: share %.1e, depth %.1e mm\n", crossings, most_share, 1e3 * most_depth);
  EXPECT_GT(crossings, 20);
  EXPECT_LT(most_share, 3e-4);
  EXPECT_LT(most_depth, 1e-6);
}

}  // namespace
}  // namespace genu
