// The knee of meshes/leskovar2019/scene.toml as four planar equations of state, written by hand, on bare CVODE.
#pragma once

#include <cmath>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

namespace planar {

struct Point {
  double x, y;
};

/// Turned by q about -z: forward in flexion.
inline Point turned(Point p, double q) {
  return {p.x * std::cos(q) + p.y * std::sin(q), -p.x * std::sin(q) + p.y * std::cos(q)};
}

/// y = angles and rates of tibia and patella (rad, rad/s).
inline int rate(realtype t, N_Vector y, N_Vector out, void*) {
  constexpr double degree = M_PI / 180;
  constexpr double tibia = 0.0536 + 3.49 * 0.178 * 0.178, patella = 2e-5 + 0.06 * (0.042 * 0.042 + 0.012 * 0.012);
  constexpr Point on_tibia{0.03, -0.065}, on_patella{0.04, -0.03}, hinge{0.012, 0.03};
  static const double rest = std::hypot(hinge.x + on_patella.x - on_tibia.x, hinge.y + on_patella.y - on_tibia.y);
  const double* s = N_VGetArrayPointer(y);
  double* d = N_VGetArrayPointer(out);
  const Point a = turned(on_tibia, s[0]), arm = turned(on_patella, s[2]);
  const Point b{hinge.x + arm.x, hinge.y + arm.y};
  const double dx = b.x - a.x, dy = b.y - a.y, length = std::hypot(dx, dy);
  const double by_tibia = -(dx * a.y - dy * a.x) / length, by_patella = (dx * arm.y - dy * arm.x) / length;
  const double force = 1e5 * (length - rest) + 50 * (by_tibia * s[1] + by_patella * s[3]);
  const double drive = t < 1 ? 0 : 28.8 * std::sin(2 * M_PI * 0.125 * (t - 1));
  d[0] = s[1];
  d[1] = (drive - 0.5535 / degree * s[0] - 0.001 / degree * s[1] - force * by_tibia) / tibia;
  d[2] = s[3];
  d[3] = (-0.033 / degree * s[2] - 0.001 / degree * s[3] - force * by_patella) / patella;
  return 0;
}

struct Run {
  double angle = 0;  ///< of the tibia at the end, rad
  long steps = 0;
};

/// From rest to `end` (s), with the nonsmooth point at 1 s met exactly.
inline Run run(double end, double tolerance, int method) {
  SUNContext context = nullptr;
  SUNContext_Create(nullptr, &context);
  N_Vector y = N_VNew_Serial(4, context);
  N_VConst(0, y);
  void* memory = CVodeCreate(method, context);
  CVodeInit(memory, rate, 0, y);
  CVodeSStolerances(memory, tolerance, tolerance);
  CVodeSetMaxNumSteps(memory, 100'000'000);
  SUNMatrix matrix = SUNDenseMatrix(4, 4, context);
  SUNLinearSolver solver = SUNLinSol_Dense(y, matrix, context);
  CVodeSetLinearSolver(memory, solver, matrix);
  Run out;
  double t = 0;
  for (const double stop : {1.0, end}) {
    CVodeSetStopTime(memory, stop);
    CVode(memory, stop, y, &t, CV_NORMAL);
    CVodeGetNumSteps(memory, &out.steps);
    if (stop < end) CVodeReInit(memory, t, y);
  }
  out.angle = N_VGetArrayPointer(y)[0];
  CVodeFree(&memory);
  SUNLinSolFree(solver);
  SUNMatDestroy(matrix);
  N_VDestroy(y);
  SUNContext_Free(&context);
  return out;
}

}  // namespace planar
