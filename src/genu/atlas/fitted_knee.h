// Where the ligaments of the reference knee insert on a user's bones.
#pragma once

#include <string>
#include <vector>

#include "genu/atlas/given_end.h"
#include "genu/atlas/reference_knee.h"
#include "genu/atlas/registration.h"

namespace genu {

/// The anatomy of two meshes in one frame, as far as it is known before. lateral may make it left-handed: a left knee.
struct KneeAxes {
  Vec3 anterior, proximal, lateral;  ///< unit
  Vec3 centre = Vec3::Zero();        ///< m: middle of the tibia's plateau, at its highest
  double width = 0;                  ///< m: of the tibia near the joint
  double gap = 0;                    ///< m: from the tibia up to the femur
  std::vector<GivenEnd> given{};     ///< ends of ligaments that are known
};

struct Insertion {
  Vec3 at = Vec3::Zero();  ///< m, in the frame of the meshes
  double error = 0;        ///< m: standard deviation, estimated
  bool on_mesh = false;    ///< put onto the mesh; else it lies beside it, as those on the fibula
  std::string given{};     ///< the name of the GivenEnd that says where; empty: the reference knee does
};

/// A bone of the reference knee laid on a mesh.
struct FittedBone {
  bool articular = false;             ///< the mesh is a joint surface alone, of cartilage or of bone
  double median = 0;                  ///< m: misfit
  double matched = 0;                 ///< part of the reference that has a partner
  bool poor() const;                  ///< too far off to tell where ligaments insert
  std::vector<Insertion> insertions;  ///< of the fibres of reference_knee(), in their order
  Affine placed;                      ///< the similarity nearest to the map, by the fibres' ends
  Mat3 turn = Mat3::Identity();       ///< anterior, proximal and lateral of the reference, on the mesh, by its surface
};

struct FittedKnee {
  FittedBone femur, tibia;
  bool reflected = false;     ///< a left knee
  Vec3 start = Vec3::Zero();  ///< m: how the tibia moves until the meshes touch
};

/// Lays the reference knee on both meshes, of bones or of their cartilage, which the fit tells; `bones`: they are
/// bones.
FittedKnee fit_reference_knee(const Mesh& femur, const Mesh& tibia, const KneeAxes& axes);

/// Puts the insertions of the lateral collateral and the popliteofibular ligament onto the mesh of the fibula, but for
/// those that are given. m: how far the farthest of them was from it; beyond kOntoFibula nothing is changed.
double put_on_fibula(const Mesh& fibula, FittedKnee& fitted);

/// rad: how far both bones are turned against `axes`, at least.
double turned_against(const FittedKnee& fitted, const KneeAxes& axes);

/// Slack lengths (m) of the fibres of reference_knee(), in their order: such that along its flexion, laid on these
/// bones, each strains as it does there (least squares; the more taut, the more a pose counts). `closer`, m: how much
/// nearer the tibia is to the femur here, as where cartilage is missing between them.
std::vector<double> slack_lengths(const FittedKnee& fitted, double closer = 0);

/// The middle of the fibres of these bundles on one of the bones. m
Vec3 middle_of(const FittedBone& bone, const std::vector<std::string>& bundles);

}  // namespace genu
