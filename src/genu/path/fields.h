// The fields of poses and paths, for an archive that saves and restores them to the last bit on the same machine. The
// archive is one of core/binary_archive.h.
#pragma once

#include "genu/path/path_options.h"

namespace genu {

template <typename Archive>
void serialize(Archive& a, Pose& x) {
  a(x.R, x.p);
}
template <typename Archive>
void serialize(Archive& a, SurfacePoint& x) {
  a(x.p, x.n, x.T, x.S);
}
template <typename Archive>
void serialize(Archive& a, ContactGeometry& x) {
  a(x.a, x.b);
}
template <typename Archive>
void serialize(Archive& a, ActiveContact& x) {
  a(x.pair, x.number, x.geometry, x.force);
}
template <typename Archive>
void serialize(Archive& a, LigamentPiece& x) {
  a(x.ligament, x.piece, x.held, x.by_length, x.force);
}
template <typename Archive>
void serialize(Archive& a, ArcEnd& x) {
  a(x.p, x.t, x.n, x.kappa, x.tau, x.mu);
}
template <typename Archive>
void serialize(Archive& a, Geodesic& x) {
  a(x.begin, x.end, x.length, x.c, x.dc, x.a, x.da, x.most_hollow, x.hollow_at, x.hollow_length, x.conjugate);
}
template <typename Archive>
void serialize(Archive& a, WrapTouch& x) {
  a(x.touching, x.arc, x.by_length);
}
template <typename Archive>
void serialize(Archive& a, State& x) {
  a(x.poses, x.coordinates, x.multipliers, x.contacts, x.pieces, x.wraps, x.layer_levels);
}
template <typename Archive>
void serialize(Archive& a, CoordinateRef& x) {
  a(x.joint, x.index);
}
template <typename Archive>
void serialize(Archive& a, QuantityRef& x) {
  a(x.first, x.combination);
}
template <typename Archive>
void serialize(Archive& a, Target::Prescribed& x) {
  a(x.coordinate, x.value, x.drivers);
}
template <typename Archive>
void serialize(Archive& a, Target& x) {
  a(x.prescribed, x.load_factors, x.time);
}
template <typename Archive>
void serialize(Archive& a, Correction& x) {
  a(x.twist, x.multipliers, x.surface, x.forces, x.parameter);
}
template <typename Archive>
void serialize(Archive& a, OpenContact& x) {
  a(x.pair, x.number, x.geometry, x.gap);
}
template <typename Archive>
void serialize(Archive& a, Balanced& x) {
  a(x.state, x.open, x.last_number);
}
template <typename Archive>
void serialize(Archive& a, NewtonReport& x) {
  a(x.outcome, x.iterations, x.residual, x.rcond, x.full_rank, x.minimum_norm, x.residual_history,
    x.simplified_history);
}
template <typename Archive>
void serialize(Archive& a, Certificate& x) {
  a(x.residual, x.smallest_force, x.smallest_gap, x.least_opposed, x.edge_distance, x.blocking, x.touching);
}
template <typename Archive>
void serialize(Archive& a, PoseReport& x) {
  a(x.status, x.why, x.iterations, x.newton, x.certificate);
}
template <typename Archive>
void serialize(Archive& a, Stability& x) {
  a(x.verdict, x.smallest, x.complex_pair, x.flutter, x.mode, x.unilateral, x.unknown_why, x.neutral, x.free_motions,
    x.redundant);
}
template <typename Archive>
void serialize(Archive& a, Undetermined& x) {
  a(x.free_motion, x.shared_reactions, x.shared_contacts, x.shared_ligaments);
}
template <typename Archive>
void serialize(Archive& a, PosePoint& x) {
  a(x.step, x.increment, x.t, x.target, x.pose, x.report, x.stability, x.undetermined);
}
template <typename Archive>
void serialize(Archive& a, PathEvent& x) {
  a(x.kind, x.step, x.t, x.target, x.what, x.coordinates, x.rows_before);
}

}  // namespace genu
