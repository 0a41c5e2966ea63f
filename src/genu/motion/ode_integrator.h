// y' = f(t, y) with adaptive order and step size, stops and roots: CVODE of SUNDIALS, used in one .cpp only.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "genu/core/types.h"

namespace genu {

struct OdeSystem {
  using Values = Eigen::Ref<const VecX>;
  Eigen::Index size = 0;
  int roots = 0;
  /// f; false where it cannot be evaluated (a smaller step is tried)
  std::function<bool(double t, Values y, Eigen::Ref<VecX> rate)> rate;
  /// 1 / (allowed error of each number in one step)
  std::function<void(Values y, Eigen::Ref<VecX> weights)> weights;
  /// `roots` functions whose changes of sign end a step; smooth while one is taken
  std::function<bool(double t, Values y, double* values)> root_values;
};

struct OdeCounts {
  long steps = 0, evaluations = 0, jacobians = 0, starts = 0, error_test_failures = 0;
};

/// Adams-Moulton, orders 1 to 12: accurate, but stability limits steps to about 1 / |lambda| of the fastest decay. BDF,
/// orders 1 to 5: no such limit.
enum class OdeMethod { adams, bdf };

class OdeIntegrator {
 public:
  enum class Step { taken, stopped, root, failed };

  explicit OdeIntegrator(OdeSystem system);
  ~OdeIntegrator();
  OdeIntegrator(const OdeIntegrator&) = delete;
  OdeIntegrator& operator=(const OdeIntegrator&) = delete;

  /// Restarts at (t, y) without history. Steps are at most `largest_step` (s).
  bool start(double t, const VecX& y, double largest_step, OdeMethod method);

  /// One step of adaptive size, not beyond `stop`. f is not evaluated beyond `stop`.
  Step step(double stop);

  double time() const;    ///< s, after the last step: the root's, where it found one
  const VecX& y() const;  ///< there

  double last_step() const;  ///< s

  /// |lambda| (1/s) of the fastest decaying eigenvalue of df/dy; 0 where none decays.
  double fastest_decay() const;

  /// y at a time within the last step, to its accuracy.
  void interpolate(double t, VecX& y) const;

  /// After Step::root: for each function +1 where it became positive, -1 where negative, else 0.
  const std::vector<int>& roots() const;

  OdeCounts counts() const;
  const std::string& failure() const;  ///< after Step::failed

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace genu
