// Detects overlaps of two layer surfaces deeper than the layer's rays reach. Such an overlap carries no load, and a
// body entirely inside the other would wrongly count as free.
#pragma once

#include <memory>
#include <vector>

#include "genu/contact/layer_rays.h"

namespace genu {

class Buried {
 public:
  /// Triangles of both surfaces, each in its body's frame, and in trees. `depth`: reach of the layer's rays, m.
  struct Triangles {
    const Mesh* mesh = nullptr;
    std::shared_ptr<const TriangleTree> tree;
  };
  Buried(const Triangles& a, const Triangles& b, double depth);

  /// The last pose where no overlap exceeded half of `depth`. Until the bodies have moved by the other half, none
  /// exceeds `depth`.
  struct Memory {
    Pose shallow;
    bool known = false;
  };

  /// Depth (m) of some point of either surface inside the other along its inward normal, if larger than `depth`; else
  /// 0. It tests some points only, and takes the back of an open sheet for its inside: a hint.
  double deepest(const Pose& X_ab, Memory& memory) const;

  /// Triangles of surface a or b, in its body's frame.
  const TriangleTree& triangles(bool of_a) const { return *(of_a ? b_ : a_).other; }

 private:
  struct Side {
    std::vector<Ray> rays;
    std::shared_ptr<const TriangleTree> other;
    double reach = 0;  ///< m: across both surfaces
    double deepest(const Pose& X_TC, double depth) const;
  };
  double motion(const Pose& from, const Pose& to) const;

  Side a_, b_;
  std::vector<Vec3> corners_;  // m, of a box round b
  double depth_;
};

}  // namespace genu
