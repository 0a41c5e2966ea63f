// Elastic layers on two surfaces pressed against each other: cartilage on rigid bones. A force with a tangent and
// without unknowns of its own.
#pragma once

#include <memory>
#include <vector>

#include "genu/contact/buried.h"
#include "genu/contact/layer_quadrature.h"

namespace genu {

/// Wrench on bodies a and b about their origins, and its derivative to their twists [v_a, w_a, v_b, w_b]; world axes.
/// Not symmetric: pressure acts along the normal of the surface it is measured from.
struct LayerWrench {
  Vec12 wrench = Vec12::Zero();
  Mat12 stiffness = Mat12::Zero();
  double load = 0;    ///< N: integral of p dA, without damping
  double damped = 0;  ///< W: power dissipated by damping
  double error = 0;   ///< N: estimated error of the load (LayerSum)
};

class ElasticLayer {
 public:
  /// A casting surface divided into cells, and its weight: 1, or 1/2 where both surfaces cast.
  struct Side {
    bool a = true;  ///< a casts and b is the target; else the reverse
    double share = 1;
    std::shared_ptr<const LayerQuadrature> quadrature;
  };
  /// One for each thread: results of earlier poses for each side, and of the last one.
  struct Memory {
    std::vector<LayerQuadrature::Memory> sides;
    Pose a, b;
    LayerWrench last;
    int level = 0;
    bool known = false;   ///< whether `last` belongs to the poses `a` and `b`, and to `level`
    Cancelled cancelled;  ///< once true the result is not finite
  };

  /// `damping`: c of LayerMotion, s/m.
  explicit ElasticLayer(std::vector<Side> sides, std::shared_ptr<const Buried> buried = {}, double damping = 0)
      : sides_(std::move(sides)), buried_(std::move(buried)), damping_(damping) {}

  /// At the poses of both bodies in the world. Results do not depend on `memory`. `level`: see LayerQuadrature.
  /// `twists`: of [a; b], for damping.
  void evaluate(const Pose& X_Wa, const Pose& X_Wb, Memory& memory, LayerWrench& out, int level = 0,
                const Vec12* twists = nullptr) const;

  /// Visits the points of one side with pressure.
  void visit(const Pose& X_Wa, const Pose& X_Wb, std::size_t side, Memory& memory,
             const std::function<void(const LayerPoint&)>& visit, int level = 0, const Vec12* twists = nullptr) const;

  const std::vector<Side>& sides() const { return sides_; }
  /// Null where it is not checked.
  const Buried* buried() const { return buried_.get(); }

 private:
  std::vector<Side> sides_;
  LayerMotion motion(const Side& side, const Pose& X_Wa, const Pose& X_Wb, const Vec12* twists) const;

  std::shared_ptr<const Buried> buried_;
  double damping_;
};

/// Of all layers of a model, in its order.
struct LayerMemories {
  std::vector<ElasticLayer::Memory> each;
  std::vector<Buried::Memory> buried;
  Cancelled cancelled;
};

}  // namespace genu
