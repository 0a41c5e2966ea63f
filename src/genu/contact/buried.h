// Whether two surfaces that press a layer overlap deeper than its rays look: what lies so deep carries nothing, and a
// body that is inside the other as a whole would be taken for a free one.
#pragma once

#include <memory>
#include <vector>

#include "genu/contact/layer_rays.h"

namespace genu {

class Buried {
 public:
  /// Triangles of both surfaces, each in its body's frame, and in trees; `depth`: how deep the layer's rays look, m.
  struct Triangles {
    const Mesh* mesh = nullptr;
    std::shared_ptr<const TriangleTree> tree;
  };
  Buried(const Triangles& a, const Triangles& b, double depth);

  /// The last pose where nothing lay deeper than half of that: until the bodies have moved by the other half, nothing
  /// lies deeper than all of it.
  struct Memory {
    Pose shallow;
    bool known = false;
  };

  /// How deep (m) some point of either surface lies in the other along minus its normal, if that is more than `depth`;
  /// else 0. Some points of each are asked: a hint, which takes the back of an open sheet for its inside.
  double deepest(const Pose& X_ab, Memory& memory) const;

 private:
  struct Side {
    std::vector<Ray> rays;
    std::shared_ptr<const TriangleTree> other;
    double reach = 0;  ///< m: across both
    double deepest(const Pose& X_TC, double depth) const;
  };
  double motion(const Pose& from, const Pose& to) const;

  Side a_, b_;
  std::vector<Vec3> corners_;  // m, of a box round b
  double depth_;
};

}  // namespace genu
