// Where the ligaments of the patella and the quadriceps insert on a user's bones.
#pragma once

#include <vector>

#include "genu/atlas/fitted_knee.h"

namespace genu {

/// The reference patella laid on a mesh, what belongs to it laid on the three bones.
struct FittedPatella {
  struct Fibre {
    Insertion patella, bone;
  };
  struct Cable {
    Vec3 femur = Vec3::Zero(), patella = Vec3::Zero();    ///< m
    double radius = 0;                                    ///< m: of the cylinder that it runs over
    Vec3 centre = Vec3::Zero();                           ///< m
    Vec3 axis = Vec3::UnitZ(), anterior = Vec3::UnitX();  ///< unit
  };
  double median = 0;              ///< m: misfit
  double matched = 0;             ///< part of the reference that has a partner
  std::vector<Fibre> fibres;      ///< of reference_knee().patella.fibres, in their order
  std::vector<Cable> quadriceps;  ///< the same
  bool poor() const;              ///< too far off to be a patella
};

/// The meshes of a knee in one frame.
struct PatellaMeshes {
  const Mesh& touches;  ///< the patella's cartilage, or its bone where there is no mesh of that
  const Mesh& bone;     ///< its bone, else the same
  const Mesh &femur, &tibia;
};

/// Lays the cartilage of the reference patella on the mesh; the start of the fit is by the femur. `knee`: the reference
/// knee on the same femur and tibia.
FittedPatella fit_reference_patella(const PatellaMeshes& meshes, const FittedKnee& knee);

}  // namespace genu
