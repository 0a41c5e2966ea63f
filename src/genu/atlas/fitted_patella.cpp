#include "genu/atlas/fitted_patella.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "genu/atlas/tolerances.h"
#include "genu/mesh/nearest_point.h"

namespace genu {
namespace {

Vec3 middle_of_points(const std::vector<FacingPoint>& points) {
  Vec3 sum = Vec3::Zero();
  for (const FacingPoint& p : points) sum += p.at;
  return sum / static_cast<double>(std::max<std::size_t>(1, points.size()));
}

/// As the femur has it, amid the mesh: straight, and tilted about each axis both ways.
std::vector<Affine> starts_at(const PointTree& target, const Affine& femur) {
  const Vec3 from = middle_of_points(reference_knee().patella.cartilage), to = middle_of_points(target.points());
  std::vector<Affine> out;
  const auto add = [&](const Mat3& tilt) {
    const Mat3 linear = femur.linear * tilt;
    out.push_back({linear, to - linear * from});
  };
  add(Mat3::Identity());
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      add(Eigen::AngleAxisd(sign * kStartTilt * std::numbers::pi / 180, Vec3::Unit(axis)).toRotationMatrix());
  return out;
}

Insertion put_onto(const Vec3& place, const Mesh& mesh, bool articular, double error) {
  const Vec3 foot = nearest_on_mesh(mesh, place);
  const bool onto = !articular && (foot - place).norm() <= kOntoMesh;
  return {onto ? foot : place, error, onto, {}};
}

/// Known as well as the insertion of the knee that is nearest, and less the farther that is.
Insertion insertion_on(const FittedBone& bone, const Mesh& mesh, const Vec3& of_reference) {
  const Vec3 place = bone.placed(of_reference);
  const auto farther = [&](const Insertion& a, const Insertion& b) {
    return (a.at - place).squaredNorm() < (b.at - place).squaredNorm();
  };
  const Insertion& near = *std::min_element(bone.insertions.begin(), bone.insertions.end(), farther);
  return put_onto(place, mesh, bone.articular, std::hypot(near.error, kErrorBeyond * (near.at - place).norm()));
}

double distance_to(const std::vector<Vec3>& points, const Vec3& x) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& p : points) least = std::min(least, (p - x).norm());
  return least;
}

FittedPatella::Cable cable_on(const QuadricepsCable& cable, const Affine& femur, const Affine& patella) {
  const double scale = std::cbrt(std::abs(femur.linear.determinant()));
  return {femur(cable.femur),  patella(cable.patella),           scale * cable.radius,
          femur(cable.centre), femur.linear.col(2).normalized(), femur.linear.col(0).normalized()};
}

}  // namespace

bool FittedPatella::poor() const { return !(median <= kPoorPatella) || !(matched >= kLeastMatched); }

FittedPatella fit_reference_patella(const PatellaMeshes& meshes, const FittedKnee& knee) {
  const ReferencePatella& reference = reference_knee().patella;
  const PointTree target(facing_vertices(meshes.touches, kMostTargets));
  const Registration found = register_points(reference.cartilage, target, starts_at(target, knee.femur.placed));
  std::vector<Vec3> from;
  for (const FacingPoint& p : reference.cartilage) from.push_back(p.at);
  const Affine placed = similarity(from, found.mapped, knee.reflected);
  FittedPatella out;
  out.median = found.median;
  out.matched = found.matched;
  const bool articular = &meshes.touches == &meshes.bone && explained(found, target) > kAllArticular;
  for (const PatellaFibre& fibre : reference.fibres) {
    const Vec3 place = placed(fibre.patella);
    const double error = std::hypot(kPeopleDiffer, found.median, kErrorBeyond * distance_to(found.mapped, place));
    const FittedBone& bone = fibre.to_tibia ? knee.tibia : knee.femur;
    out.fibres.push_back({put_onto(place, meshes.bone, articular, error),
                          insertion_on(bone, fibre.to_tibia ? meshes.tibia : meshes.femur, fibre.bone)});
  }
  for (const QuadricepsCable& cable : reference.quadriceps)
    out.quadriceps.push_back(cable_on(cable, knee.femur.placed, placed));
  return out;
}

}  // namespace genu
