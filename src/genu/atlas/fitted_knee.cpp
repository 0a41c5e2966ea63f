#include "genu/atlas/fitted_knee.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "genu/atlas/tolerances.h"
#include "genu/mesh/nearest_point.h"

namespace genu {
namespace {

/// Starts: straight, and tilted about each axis of the knee both ways.
std::vector<Affine> starts_of(const KneeAxes& axes, const ReferenceKnee::Plateau& plateau, double up) {
  Mat3 frame;
  frame << axes.anterior, axes.proximal, axes.lateral;
  std::vector<Affine> out;
  const double scale = axes.width / plateau.width;
  const auto add = [&](const Mat3& tilt) {
    const Mat3 linear = scale * frame * tilt;
    out.push_back({linear, axes.centre + up * axes.proximal - linear * plateau.centre});
  };
  add(Mat3::Identity());
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      add(Eigen::AngleAxisd(sign * kStartTilt * std::numbers::pi / 180, Vec3::Unit(axis)).toRotationMatrix());
  return out;
}

/// Root mean square of the misfits of the points nearest to x, and how far away the nearest of them is.
struct Surroundings {
  double misfit = 0, distance = 0;
};
Surroundings around(const Registration& r, const Vec3& x) {
  std::vector<std::pair<double, double>> near;
  for (std::size_t i = 0; i < r.mapped.size(); ++i)
    near.emplace_back((r.mapped[i] - x).norm(), std::min(r.misfits[i], kOntoMesh));
  const std::size_t count = std::min<std::size_t>(20, near.size());
  std::partial_sort(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(count), near.end());
  Surroundings out;
  for (std::size_t k = 0; k < count; ++k) out.misfit += near[k].second * near[k].second / static_cast<double>(count);
  out.misfit = std::sqrt(out.misfit);
  out.distance = near.empty() ? 0 : near.front().first;
  return out;
}

Insertion insertion_at(const Vec3& place, const Registration& found, const Mesh& mesh, bool articular) {
  const Surroundings near = around(found, place);
  const Vec3 foot = nearest_on_mesh(mesh, place);
  const bool onto = !articular && (foot - place).norm() <= kOntoMesh;
  return {onto ? foot : place, std::hypot(kPeopleDiffer, near.misfit, kErrorBeyond * near.distance), onto, {}};
}

bool is_of(const ReferenceFibre& fibre, const std::vector<std::string>& bundles) {
  return std::find(bundles.begin(), bundles.end(), fibre.bundle) != bundles.end();
}

/// The fibres keep their places about the middle of them all, which goes where it is known to be.
void take_given(const GivenEnd& given, const Mesh& mesh, FittedBone& bone) {
  const Vec3 shift = given.at - middle_of(bone, given.bundles);
  const std::vector<ReferenceFibre>& fibres = reference_knee().fibres;
  for (std::size_t i = 0; i < fibres.size(); ++i) {
    if (!is_of(fibres[i], given.bundles)) continue;
    const Vec3 place = bone.insertions[i].at + shift, foot = nearest_on_mesh(mesh, place);
    const bool onto = !bone.articular && (foot - place).norm() <= kOntoMesh;
    bone.insertions[i] = {onto ? foot : place, given.error, onto, given.name};
  }
}

/// How the reference is turned where it lies on the mesh, by the points that found a partner there; with a reflection
/// where the map has one.
Mat3 turn_of(const std::vector<FacingPoint>& points, const Registration& found) {
  std::vector<Vec3> from, to;
  for (std::size_t i = 0; i < points.size(); ++i)
    if (found.misfits[i] < kMatched) {
      from.push_back(points[i].at);
      to.push_back(found.mapped[i]);
    }
  if (static_cast<std::ptrdiff_t>(from.size()) < kFewPartners) return found.map.affine.linear;
  const Mat3 linear = similarity(from, to, found.map.affine.linear.determinant() < 0).linear;
  return linear / std::cbrt(std::abs(linear.determinant()));
}

FittedBone fit_bone(const Mesh& mesh, const ReferenceKnee::Bone& reference, const KneeAxes& axes, double up,
                    Vec3 ReferenceFibre::*end) {
  const ReferenceKnee& knee = reference_knee();
  const PointTree target(facing_vertices(mesh, kMostTargets));
  Registration best = register_points(reference.bone, target, starts_of(axes, knee.bone, up));
  Registration other = register_points(reference.cartilage, target, starts_of(axes, knee.cartilage, up));
  FittedBone out;
  out.articular = explained(other, target) > kAllArticular;
  const bool both = explained(best, target) > kAllArticular;  // articular bone of the femur is like its cartilage
  const bool by_cartilage = out.articular && (!both || other.median < best.median);
  if (by_cartilage) best = std::move(other);
  out.turn = turn_of(by_cartilage ? reference.cartilage : reference.bone, best);
  out.median = best.median;
  out.matched = best.matched;
  std::vector<Vec3> from, to;
  for (const ReferenceFibre& fibre : knee.fibres) {
    from.push_back(fibre.*end);
    to.push_back(best.map(from.back()));
    out.insertions.push_back(insertion_at(to.back(), best, mesh, out.articular));
  }
  out.placed = similarity(from, to, best.map.affine.linear.determinant() < 0);
  return out;
}

}  // namespace

bool FittedBone::poor() const { return !(median <= kPoorMisfit) || !(matched >= kLeastMatched); }

Vec3 middle_of(const FittedBone& bone, const std::vector<std::string>& bundles) {
  const std::vector<ReferenceFibre>& fibres = reference_knee().fibres;
  Vec3 sum = Vec3::Zero();
  int count = 0;
  for (std::size_t i = 0; i < fibres.size(); ++i)
    if (is_of(fibres[i], bundles)) {
      sum += bone.insertions[i].at;
      ++count;
    }
  return sum / std::max(count, 1);
}

FittedKnee fit_reference_knee(const Mesh& femur, const Mesh& tibia, const KneeAxes& axes) {
  const ReferenceKnee& knee = reference_knee();
  FittedKnee out{fit_bone(femur, knee.femur, axes, axes.gap, &ReferenceFibre::femur),
                 fit_bone(tibia, knee.tibia, axes, 0, &ReferenceFibre::tibia),
                 axes.anterior.cross(axes.proximal).dot(axes.lateral) < 0, axes.gap * axes.proximal};
  for (const GivenEnd& given : axes.given)
    take_given(given, given.femur ? femur : tibia, given.femur ? out.femur : out.tibia);
  return out;
}

double put_on_fibula(const Mesh& fibula, FittedKnee& fitted) {
  const std::vector<ReferenceFibre>& fibres = reference_knee().fibres;
  std::vector<Insertion> put = fitted.tibia.insertions;
  double farthest = 0;
  for (std::size_t i = 0; i < fibres.size(); ++i) {
    if (!is_of(fibres[i], {"LCL", "PFL"}) || !put[i].given.empty()) continue;
    const Vec3 foot = nearest_on_mesh(fibula, put[i].at);
    const double moved = (foot - put[i].at).norm();
    farthest = std::max(farthest, moved);
    put[i] = {foot, std::hypot(put[i].error, kPutAsFar * moved), true, {}};
  }
  if (farthest <= kOntoFibula) fitted.tibia.insertions = std::move(put);
  return farthest;
}

double turned_against(const FittedKnee& fitted, const KneeAxes& axes) {
  Mat3 frame;
  frame << axes.anterior, axes.proximal, axes.lateral;
  double least = std::numeric_limits<double>::infinity();
  for (const FittedBone* bone : {&fitted.femur, &fitted.tibia}) {
    const Mat3 turn = frame.transpose() * bone->placed.linear / std::cbrt(std::abs(bone->placed.linear.determinant()));
    least = std::min(least, std::abs(Eigen::AngleAxisd(turn).angle()));
  }
  return least;
}

std::vector<double> slack_lengths(const FittedKnee& fitted, double closer) {
  const ReferenceKnee& knee = reference_knee();
  const Affine &femur = fitted.femur.placed, &tibia = fitted.tibia.placed;
  const Mat3 back = tibia.linear.inverse();
  const double nearer = closer / tibia.linear.col(1).norm();
  std::vector<double> out;
  for (std::size_t i = 0; i < knee.fibres.size(); ++i) {
    const ReferenceFibre& fibre = knee.fibres[i];
    const Vec3 &from = fitted.femur.insertions[i].at, &to = fitted.tibia.insertions[i].at;
    const Vec3 end = back * (to - tibia.shift) + nearer * Vec3::UnitY();
    double longest = 0, most = -1, up = 0, down = 0;
    for (const Eigen::Isometry3d& pose : knee.flexion) {
      const double length = (femur(pose * end) - from).norm();
      const double strain = (pose * fibre.tibia - fibre.femur).norm() / fibre.slack - 1;
      const double weight = std::max(0.0, strain + kNearlyTaut);
      longest = std::max(longest, length);
      most = std::max(most, strain);
      up += weight * length * length;
      down += weight * length * (1 + strain);
    }
    // Never taut: nor here. Where it begins, not much more taut than the reference ever is.
    const double start = (to + fitted.start - from).norm();
    out.push_back(down > 0 ? std::max(up / down, start / (1 + most + kMoreTaut))
                           : std::max(longest, start) / (1 + most));
  }
  return out;
}

}  // namespace genu
