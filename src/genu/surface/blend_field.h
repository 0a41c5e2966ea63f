// The implicit function of a blend and its first two derivatives.
//
//   f = sum w_i g_i / sum w_i,   w_i = (1 - |x - c_i|^2 / rho_b^2)^4,   g_i = z_i - h_i(u_i, v_i)
//
// over the nodes i of one sheet within rho_b of x; (u, v, z) are x in the frame of node i. f is at least C2 wherever a
// node is in reach, is close to a signed distance, and is positive on the outward side.
//
// Of sheets that meet in a crease the larger f counts where it is convex and the smaller where it is not, as of solids
// that are cut or joined: f is continuous there and its gradient is not. Between other sheets the nearest node decides.
#pragma once

#include <span>
#include <utility>
#include <vector>

#include "genu/mesh/cell_lists.h"
#include "genu/surface/blend_sum.h"
#include "genu/surface/local_fit.h"

namespace genu {

class BlendField {
 public:
  BlendField() = default;
  /// Two sheets that meet in a crease: the solid behind both (convex), or behind either.
  struct Crease {
    int a, b;
    bool convex;
  };

  /// Heights of degree at most `degree`; sheet[i] >= 0 is the sheet of fits[i].
  BlendField(std::span<const HeightFit> fits, std::vector<int> sheet, int degree, double blend_radius,
             const std::vector<Crease>& creases = {});

  /// Each returns false, and leaves its results unspecified, where too little weight is in reach.
  /// x in m, f in m, gradient dimensionless, Hessian in 1/m.
  [[nodiscard]] bool value(const Vec3& x, double& f) const;
  [[nodiscard]] bool value(const Vec3& x, double& f, Vec3& gradient) const;
  [[nodiscard]] bool value(const Vec3& x, double& f, Vec3& gradient, Mat3& hessian) const;

  /// The node whose sheet answers for x, or -1 where none is in reach.
  int nearest_node(const Vec3& x) const;

  double blend_radius() const { return blend_radius_; }

  template <typename Archive>
  void serialize(Archive& a) {
    a(degree_, blend_radius_, stride_, records_, sheet_, cells_, mixed_, across_);
  }

 private:
  BlendNodes nodes() const {
    return {records_.data(), static_cast<std::size_t>(stride_), sheet_.data(), blend_radius_};
  }
  template <int Order>
  bool dispatch(const Vec3& x, BlendJet& out) const;
  template <int D>
  int across_creases(const Vec3& x, std::span<const int> candidates, int nearest) const;
  template <int D, int Order>
  bool evaluate(const Vec3& x, BlendJet& out) const;
  int nearest_node(const Vec3& x, std::span<const int> candidates) const;

  int degree_ = kMinDegree;
  double blend_radius_ = 0;
  int stride_ = 0;
  std::vector<double> records_;  ///< for each node: centre (3), axes u, v, n (9), coefficients
  std::vector<int> sheet_;
  CellLists cells_;
  std::vector<char> mixed_;                                ///< cells that more than one sheet reaches into
  std::vector<std::vector<std::pair<int, bool>>> across_;  ///< of each sheet: those beyond its creases, and if convex
};

}  // namespace genu
