// The articular contact of OpenSim-JAM (Smith2018ArticularContactForce), done plainly: at every evaluation a ray from
// each triangle of the casting mesh, first to the triangle of the other mesh that it met last, then through the tree of
// all. Uniform thickness; a ray counts wholly or not at all.
#pragma once

#include "genu/contact/layer_quadrature.h"
#include "genu/model/joint_model.h"

namespace genu::peers {

class PlainLayer final : public LayerQuadrature {
 public:
  PlainLayer(const Mesh& casting, std::shared_ptr<const TriangleTree> target, double search_depth, const LayerLaw& law,
             double thickness);

  /// One model at a time: the triangles met last are kept here and not in `memory`.
  void add(const Pose& X_TC, Memory& memory, LayerSum& out, int level = 0,
           const LayerMotion& motion = {}) const override;
  /// Not asked for.
  void visit(const Pose&, Memory&, const std::function<void(const LayerPoint&)>&, int,
             const LayerMotion&) const override {}
  std::vector<Ray> cell_rays() const override { return rays_; }
  const TriangleTree& target() const override { return *target_; }

 private:
  std::vector<Ray> rays_;
  std::vector<double> areas_;  // m^2
  std::shared_ptr<const TriangleTree> target_;
  double search_depth_, thickness_;  // m
  LayerLaw law_;
  mutable std::vector<int> met_;
};

/// Every layer of the model as a PlainLayer.
void make_layers_plain(JointModel& model, const LayerLaw& law, double thickness);

}  // namespace genu::peers
