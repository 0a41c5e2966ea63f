#include "genu/motion/ode_integrator.h"

#include <algorithm>
#include <cmath>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sundials/sundials_context.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "genu/core/decompositions.h"
#include "genu/motion/tolerances.h"

namespace genu {
namespace {

Eigen::Map<VecX> view(N_Vector v) { return {N_VGetArrayPointer(v), static_cast<Eigen::Index>(N_VGetLength(v))}; }

std::string in_words(int flag) {
  switch (flag) {
    case CV_TOO_MUCH_ACC:
      return "the tolerance asks for more digits than numbers of this size have";
    case CV_ERR_FAILURE:
      return "no step is short enough for the tolerance";
    case CV_CONV_FAILURE:
      return "no step is short enough for the equations to be solved";
    case CV_FIRST_RHSFUNC_ERR:
    case CV_REPTD_RHSFUNC_ERR:
    case CV_UNREC_RHSFUNC_ERR:
      return "the equations of motion cannot be evaluated there";
    default: {
      char* name = CVodeGetReturnFlagName(flag);
      const std::string words = name;
      std::free(name);
      return words;
    }
  }
}

void be_silent(int, const char*, const char*, char*, void*) {}

}  // namespace

struct OdeIntegrator::Impl {
  template <typename T, void (*Free)(T)>
  struct Deleter {
    using pointer = T;
    void operator()(T x) const { Free(x); }
  };
  static void free_context(SUNContext x) { SUNContext_Free(&x); }
  static void free_matrix(SUNMatrix x) { SUNMatDestroy(x); }
  static void free_solver(SUNLinearSolver x) { SUNLinSolFree(x); }
  static void free_memory(void* x) { CVodeFree(&x); }
  template <typename T, void (*Free)(T)>
  using Owned = std::unique_ptr<std::remove_pointer_t<T>, Deleter<T, Free>>;

  OdeSystem system;
  OdeMethod method = OdeMethod::adams;
  Owned<SUNContext, free_context> context;
  Owned<N_Vector, N_VDestroy> y;
  Owned<SUNMatrix, free_matrix> matrix;
  Owned<SUNLinearSolver, free_solver> solver;
  Owned<void*, free_memory> memory;
  VecX now;
  double time = 0;
  std::vector<int> roots;
  OdeCounts before;  ///< of earlier integrations
  std::string failure;
  int stalled = 0;  ///< successive steps without advance of time

  static int rate(realtype t, N_Vector y, N_Vector out, void* self) {
    return static_cast<Impl*>(self)->system.rate(t, view(y), view(out)) ? 0 : 1;
  }
  static int weights(N_Vector y, N_Vector out, void* self) {
    static_cast<Impl*>(self)->system.weights(view(y), view(out));
    return 0;
  }
  static int root(realtype t, N_Vector y, realtype* out, void* self) {
    return static_cast<Impl*>(self)->system.root_values(t, view(y), out) ? 0 : -1;
  }

  OdeCounts since_start() const {
    OdeCounts c;
    long linear = 0;
    if (!memory) return c;
    CVodeGetNumSteps(memory.get(), &c.steps);
    CVodeGetNumRhsEvals(memory.get(), &c.evaluations);
    CVodeGetNumLinRhsEvals(memory.get(), &linear);
    CVodeGetNumJacEvals(memory.get(), &c.jacobians);
    CVodeGetNumErrTestFails(memory.get(), &c.error_test_failures);
    c.evaluations += linear;
    c.starts = 1;
    return c;
  }

  bool create(double t) {
    SUNContext made = nullptr;
    if (SUNContext_Create(nullptr, &made) != 0) return false;
    context.reset(made);
    y.reset(N_VNew_Serial(system.size, made));
    view(y.get()) = now;
    memory.reset(CVodeCreate(method == OdeMethod::adams ? CV_ADAMS : CV_BDF, made));
    void* m = memory.get();
    if (m == nullptr || CVodeInit(m, rate, t, y.get()) != CV_SUCCESS) return false;
    matrix.reset(SUNDenseMatrix(system.size, system.size, made));
    solver.reset(SUNLinSol_Dense(y.get(), matrix.get(), made));
    CVodeSetErrHandlerFn(m, be_silent, nullptr);
    CVodeSetUserData(m, this);
    CVodeSetMaxNumSteps(m, kMaxOdeSteps);
    return CVodeWFtolerances(m, weights) == CV_SUCCESS &&
           CVodeSetLinearSolver(m, solver.get(), matrix.get()) == CV_SUCCESS &&
           (system.roots == 0 || CVodeRootInit(m, system.roots, root) == CV_SUCCESS);
  }
};

OdeIntegrator::OdeIntegrator(OdeSystem system) : impl_(std::make_unique<Impl>()) {
  impl_->system = std::move(system);
  impl_->roots.assign(static_cast<std::size_t>(impl_->system.roots), 0);
}

OdeIntegrator::~OdeIntegrator() = default;

bool OdeIntegrator::start(double t, const VecX& y, double largest_step, OdeMethod method) {
  Impl& i = *impl_;
  i.before = counts();
  if (method != i.method) i.memory.reset();
  i.method = method;
  i.now = y;
  i.time = t;
  if (!i.memory) {
    if (!i.create(t)) return false;
  } else {
    view(i.y.get()) = y;
    if (CVodeReInit(i.memory.get(), t, i.y.get()) != CV_SUCCESS) return false;
  }
  return CVodeSetMaxStep(i.memory.get(), largest_step) == CV_SUCCESS;
}

OdeIntegrator::Step OdeIntegrator::step(double stop) {
  Impl& i = *impl_;
  const double before = i.time;
  CVodeSetStopTime(i.memory.get(), stop);
  const int flag = CVode(i.memory.get(), stop, i.y.get(), &i.time, CV_ONE_STEP);
  i.now = view(i.y.get());
  i.stalled = i.time > before + kStallShare * std::abs(before) ? 0 : i.stalled + 1;
  if (flag >= 0 && i.stalled > kMaxStalled) {
    i.failure = "the steps become too short";
    return Step::failed;
  }
  if (flag == CV_ROOT_RETURN) {
    CVodeGetRootInfo(i.memory.get(), i.roots.data());
    return Step::root;
  }
  if (flag == CV_TSTOP_RETURN) return Step::stopped;
  if (flag >= 0) return Step::taken;
  i.failure = in_words(flag);
  return Step::failed;
}

double OdeIntegrator::time() const { return impl_->time; }

double OdeIntegrator::last_step() const {
  double h = 0;
  CVodeGetLastStep(impl_->memory.get(), &h);
  return h;
}

double OdeIntegrator::fastest_decay() const {
  const Impl& i = *impl_;
  const Eigen::Index n = i.system.size;
  VecX y = i.now, weights(n), at_y(n), beside(n);
  MatX jacobian(n, n);
  i.system.weights(y, weights);
  if (!i.system.rate(i.time, y, at_y)) return 0;
  for (Eigen::Index k = 0; k < n; ++k) {
    const double step = std::max(kDifferenceStep * std::abs(y[k]), kDifferenceStep);
    y[k] += step;
    if (!i.system.rate(i.time, y, beside)) return 0;
    jacobian.col(k) = (beside - at_y) / step;
    y[k] = i.now[k];
  }
  double fastest = 0;
  const Eigen::VectorXcd lambdas = general_eigenvalues(jacobian);
  for (const auto& lambda : lambdas)
    if (lambda.real() < -kDampedShare * std::abs(lambda)) fastest = std::max(fastest, std::abs(lambda));
  return fastest;
}

const VecX& OdeIntegrator::y() const { return impl_->now; }
const std::vector<int>& OdeIntegrator::roots() const { return impl_->roots; }
const std::string& OdeIntegrator::failure() const { return impl_->failure; }

void OdeIntegrator::interpolate(double t, VecX& y) const {
  Impl& i = *impl_;
  y.resize(i.system.size);
  Impl::Owned<N_Vector, N_VDestroy> out(N_VMake_Serial(i.system.size, y.data(), i.context.get()));
  if (CVodeGetDky(i.memory.get(), t, 0, out.get()) != CV_SUCCESS) y = i.now;
}

OdeCounts OdeIntegrator::counts() const {
  OdeCounts sum = impl_->before;
  const OdeCounts last = impl_->since_start();
  sum.steps += last.steps;
  sum.evaluations += last.evaluations;
  sum.jacobians += last.jacobians;
  sum.starts += last.starts;
  sum.error_test_failures += last.error_test_failures;
  return sum;
}

}  // namespace genu
