// The reference knee: surfaces as points, and the ligament fibres between femur and tibia.
#pragma once

#include <string>
#include <vector>

#include "genu/atlas/point_tree.h"

namespace genu {

/// A fibre of the reference knee.
struct ReferenceFibre {
  std::string name, bundle;
  double stiffness = 0;  ///< N at a strain of 1
  double transition = 0;
  double strain = 0;                                ///< in extension under a small load, as published
  double slack = 0;                                 ///< m: slack length
  Vec3 femur = Vec3::Zero(), tibia = Vec3::Zero();  ///< m: its ends
};

/// A ligament fibre of the reference patella.
struct PatellaFibre {
  std::string name, bundle;
  double stiffness = 0;  ///< N at a strain of 1
  double transition = 0;
  double strain = 0;                                 ///< in extension under the tension of the quadriceps
  bool to_tibia = false;                             ///< the patellar tendon; else it ends on the femur
  Vec3 patella = Vec3::Zero(), bone = Vec3::Zero();  ///< m: its ends
};

/// A part of the quadriceps: from the femur over a cylinder along z to the patella.
struct QuadricepsCable {
  std::string name;
  double tension = 0;                                 ///< N
  Vec3 femur = Vec3::Zero(), patella = Vec3::Zero();  ///< m
  double radius = 0;                                  ///< m
  Vec3 centre = Vec3::Zero();                         ///< m
};

/// Where it lies in extension under the quadriceps, in the frame of the femur. m.
struct ReferencePatella {
  std::vector<FacingPoint> cartilage;
  std::vector<PatellaFibre> fibres;
  std::vector<QuadricepsCable> quadriceps;
};

/// A right knee in extension, femur and tibia in one frame: x anterior, y proximal, z lateral. m.
struct ReferenceKnee {
  struct Bone {
    std::vector<FacingPoint> bone, cartilage;
  };
  struct Plateau {
    double width = 0;            ///< m
    Vec3 centre = Vec3::Zero();  ///< m: middle of the tibia's plateau, at its highest
  };
  Bone femur, tibia;
  Plateau bone, cartilage;  ///< of the tibia
  std::vector<ReferenceFibre> fibres;
  ReferencePatella patella;
  std::vector<Eigen::Isometry3d> flexion;  ///< of the tibia in the femur, from 0 to 120 deg under 100 N
};

/// Lenhart et al. (2015); read once.
const ReferenceKnee& reference_knee();

}  // namespace genu
