#include "genu/model/grood_suntay.h"

#include <algorithm>
#include <cmath>

#include "genu/model/tolerances.h"

namespace genu {
namespace {

/// Of atan2(sine, cosine).
double angle_rate(double sine, double cosine, double sine_rate, double cosine_rate) {
  return (cosine * sine_rate - sine * cosine_rate) / (sine * sine + cosine * cosine);
}

}  // namespace

std::optional<KneeMotion> grood_suntay(const GroodSuntayDef& axes, const Pose& X_W_femur, const Pose& X_W_tibia) {
  const Vec3 proximal_F = X_W_femur.R * axes.femur.proximal, anterior_F = X_W_femur.R * axes.femur.anterior;
  const Vec3 proximal_T = X_W_tibia.R * axes.tibia.proximal, anterior_T = X_W_tibia.R * axes.tibia.anterior;
  const Vec3 right_T = anterior_T.cross(proximal_T);
  const Vec3 e1 = anterior_F.cross(proximal_F), e3 = proximal_T;
  const Vec3 floating = e3.cross(e1);
  if (floating.norm() < kMinFloatingAxis) return std::nullopt;
  const Vec3 e2 = floating.normalized();
  const Vec3 way = (X_W_tibia.p - X_W_femur.p) + (X_W_tibia.R * axes.tibia.origin - X_W_femur.R * axes.femur.origin);
  const double side = axes.right ? 1 : -1;
  KneeMotion out;
  out.flexion = std::atan2(-e2.dot(proximal_F), e2.dot(anterior_F));
  out.adduction = side * std::atan2(e1.dot(e3), floating.norm());
  out.external_rotation = side * std::atan2(-e2.dot(right_T), e2.dot(anterior_T));
  out.lateral = side * way.dot(e1);
  out.anterior = way.dot(e2);
  out.distraction = -way.dot(e3);
  return out;
}

std::optional<KneeMotion> grood_suntay_rate(const GroodSuntayDef& axes, const Pose& X_W_femur, const Pose& X_W_tibia,
                                            const Vec12& twists) {
  const Vec3 turn_F = twists.segment<3>(3), turn_T = twists.segment<3>(9);
  const Vec3 proximal_F = X_W_femur.R * axes.femur.proximal, anterior_F = X_W_femur.R * axes.femur.anterior;
  const Vec3 e3 = X_W_tibia.R * axes.tibia.proximal, anterior_T = X_W_tibia.R * axes.tibia.anterior;
  const Vec3 right_T = anterior_T.cross(e3), e1 = anterior_F.cross(proximal_F);
  const Vec3 e1_rate = turn_F.cross(e1), e3_rate = turn_T.cross(e3);
  const Vec3 floating = e3.cross(e1);
  const double sine = floating.norm();
  if (sine < kMinFloatingAxis) return std::nullopt;
  const Vec3 e2 = floating / sine, floating_rate = e3_rate.cross(e1) + e3.cross(e1_rate);
  const double norm_rate = e2.dot(floating_rate);
  const Vec3 e2_rate = (floating_rate - norm_rate * e2) / sine;
  const Vec3 origin_F = X_W_femur.R * axes.femur.origin, origin_T = X_W_tibia.R * axes.tibia.origin;
  const Vec3 way = (X_W_tibia.p - X_W_femur.p) + (origin_T - origin_F);
  const Vec3 way_rate =
      (twists.segment<3>(6) - twists.segment<3>(0)) + (turn_T.cross(origin_T) - turn_F.cross(origin_F));
  // Rate of e2 . v for a v that turns with a bone.
  const auto along_e2 = [&](const Vec3& v, const Vec3& turn) { return e2_rate.dot(v) + e2.dot(turn.cross(v)); };
  const double side = axes.right ? 1 : -1;
  KneeMotion out;
  out.flexion =
      angle_rate(-e2.dot(proximal_F), e2.dot(anterior_F), -along_e2(proximal_F, turn_F), along_e2(anterior_F, turn_F));
  out.adduction = side * angle_rate(e1.dot(e3), sine, e1_rate.dot(e3) + e1.dot(e3_rate), norm_rate);
  out.external_rotation =
      side * angle_rate(-e2.dot(right_T), e2.dot(anterior_T), -along_e2(right_T, turn_T), along_e2(anterior_T, turn_T));
  out.lateral = side * (way_rate.dot(e1) + way.dot(e1_rate));
  out.anterior = way_rate.dot(e2) + way.dot(e2_rate);
  out.distraction = -(way_rate.dot(e3) + way.dot(e3_rate));
  return out;
}

}  // namespace genu
