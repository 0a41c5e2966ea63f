#include "genu/model/grood_suntay.h"

#include <algorithm>
#include <cmath>

namespace genu {

std::optional<KneeMotion> grood_suntay(const GroodSuntayDef& axes, const Pose& X_W_femur, const Pose& X_W_tibia) {
  const Vec3 proximal_F = X_W_femur.R * axes.femur.proximal, anterior_F = X_W_femur.R * axes.femur.anterior;
  const Vec3 proximal_T = X_W_tibia.R * axes.tibia.proximal, anterior_T = X_W_tibia.R * axes.tibia.anterior;
  const Vec3 right_T = anterior_T.cross(proximal_T);
  const Vec3 e1 = anterior_F.cross(proximal_F), e3 = proximal_T;
  const Vec3 floating = e3.cross(e1);
  constexpr double kNoAxis = 1e-12;  // rad: below, rounding alone decides the floating axis
  if (floating.norm() < kNoAxis) return std::nullopt;
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

}  // namespace genu
