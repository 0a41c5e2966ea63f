// What Blankevoort and Huiskes (1991) asked of their model, of the measured knee (meshes/lenhart2015): does it matter
// that the medial collateral ligament bends round the edge of the tibia? The knee is flexed without a moment, with a
// valgus one, and with internal and external ones, its medial collateral ligament wrapped and straight.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "studies/solved_scene.h"

namespace genu::studies {

/// The knee over flexion under one moment.
struct WrappingCurve {
  std::vector<double> flexion, adduction, rotation;  ///< deg
  std::vector<double> ligament, contact;             ///< N: medial collateral ligament, whole contact
  std::vector<double> medial, lateral;               ///< N: of the contact
  bool complete = false;                             ///< every pose is solved and stable
};

struct WrappingStudy {
  enum Moment { none, valgus, internal, external };
  std::array<WrappingCurve, 4> straight, wrapped;  ///< by the moment

  bool complete() const;
  /// deg at each flexion: by how much the valgus moment opens the knee, and from external to internal rotation.
  static std::vector<double> opening(const std::array<WrappingCurve, 4>& knee);
  static std::vector<double> rotation_laxity(const std::array<WrappingCurve, 4>& knee);
};

/// From scene-wrapped.toml in `folder`.
std::optional<WrappingStudy> solve_wrapping(const std::string& folder, Diagnostics& out);

/// STUDY-wrapping.md and study-wrapping.svg.
Files wrapping_files(const WrappingStudy& study);

}  // namespace genu::studies
