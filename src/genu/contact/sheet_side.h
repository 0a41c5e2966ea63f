// The side of an open sheet, or of pieces that meet, that a point is on, and how far it keeps that.
//
// The nearest point of a single closed sheet gives the side. At the edge of a hole it gives none, and between pieces
// that intersect it may lie on the wrong piece: there the winding number gives it. A point that moves without coming
// near the sheet gets behind it only round its edge.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "genu/contact/feature_normals.h"
#include "genu/mesh/winding_number.h"

namespace genu {

/// A lower bound of the distance to the edge of a sheet: to a few of its vertices, less how far the others are from
/// them.
class EdgeDistance {
 public:
  EdgeDistance(const Mesh& mesh, const FeatureNormals& normals);
  /// m
  double operator()(const Vec3& x) const;

 private:
  double square_to(const Vec3& x) const;

  std::vector<Vec3> points_;
  double cover_ = 0;
};

class SheetSide {
 public:
  /// Empty for a closed mesh whose pieces do not meet.
  static std::optional<SheetSide> of(const Mesh& mesh, const FeatureNormals& normals);

  /// m: how far a point x keeps its side, if it stays away from the sheet. `away`: to x from its nearest point, in
  /// front of which it is or which is `open`, on an edge; `normal`: there. Makes `side` -1, and says nothing, where the
  /// winding number shows that x is inside.
  double at(const Vec3& x, const Vec3& away, const Vec3& normal, bool open, double& side) const;

  /// What the winding number ranges over, away from the sheet.
  struct Range {
    double middle = 0, half = 1;
  };

 private:
  std::shared_ptr<const WindingNumber> winding_;
  std::optional<EdgeDistance> edge_;
  Range range_;
  bool entangled_ = false;  // the winding number gives the side everywhere
};

}  // namespace genu
