#include "genu/contact/elastic_layer.h"

#include <array>
#include <limits>

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

namespace genu {
namespace {

constexpr std::size_t kMostSides = 2;

using Mat6x12 = Eigen::Matrix<double, 6, 12>;

/// Wrench on the casting body c and the target t, [c, t], from the integrals in c's axes.
LayerWrench in_world(const Pose& X_Wc, const Pose& X_Wt, const LayerSum& sum) {
  Mat6 R = Mat6::Zero();
  R.topLeftCorner<3, 3>() = R.bottomRightCorner<3, 3>() = X_Wc.R;
  const Vec6 on_c = R * sum.wrench;
  const Vec3 f = on_c.head<3>(), m = on_c.tail<3>(), arm = X_Wc.p - X_Wt.p;
  const Mat3 I = Mat3::Identity();

  // Twist of c relative to t at c's origin: v_c - v_t - w_t x arm, w_c - w_t.
  Mat6x12 relative = Mat6x12::Zero();
  relative.block<3, 3>(0, 0) = relative.block<3, 3>(3, 3) = I;
  relative.block<3, 3>(0, 6) = relative.block<3, 3>(3, 9) = -I;
  relative.block<3, 3>(0, 9) = skew(arm);
  Mat6x12 c = R * sum.tangent * R.transpose() * relative;
  // A vector constant in c's axes rotates with c.
  c.block<3, 3>(0, 3) -= skew(f);
  c.block<3, 3>(3, 3) -= skew(m);

  LayerWrench out;
  out.wrench << on_c, -f, -(m + arm.cross(f));
  out.stiffness.topRows<6>() = c;
  out.stiffness.middleRows<3>(6) = -c.topRows<3>();
  out.stiffness.bottomRows<3>() = -c.bottomRows<3>() - skew(arm) * c.topRows<3>();
  out.stiffness.block<3, 3>(9, 0) += skew(f);
  out.stiffness.block<3, 3>(9, 6) -= skew(f);
  return out;
}

/// [a, b] instead of [b, a].
LayerWrench swapped(const LayerWrench& from) {
  LayerWrench out;
  out.wrench << from.wrench.tail<6>(), from.wrench.head<6>();
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j)
      out.stiffness.block<6, 6>(6 * i, 6 * j) = from.stiffness.block<6, 6>(6 * (1 - i), 6 * (1 - j));
  return out;
}

}  // namespace

LayerMotion ElasticLayer::motion(const Side& side, const Pose& X_Wa, const Pose& X_Wb, const Vec12* twists) const {
  if (damping_ == 0 || twists == nullptr) return {};
  const Pose &X_Wc = side.a ? X_Wa : X_Wb, &X_Wt = side.a ? X_Wb : X_Wa;
  const Vec6 c = side.a ? twists->head<6>() : twists->tail<6>(), t = side.a ? twists->tail<6>() : twists->head<6>();
  const Vec3 carried = t.head<3>() + t.tail<3>().cross(X_Wc.p - X_Wt.p);
  LayerMotion out;
  out.twist << X_Wc.R.transpose() * (c.head<3>() - carried), X_Wc.R.transpose() * (c.tail<3>() - t.tail<3>());
  out.damping = damping_;
  return out;
}

void ElasticLayer::evaluate(const Pose& X_Wa, const Pose& X_Wb, Memory& memory, LayerWrench& out, int level,
                            const Vec12* twists) const {
  const bool damped = damping_ != 0 && twists != nullptr;
  if (!damped && memory.known && memory.level == level && memory.a == X_Wa && memory.b == X_Wb) {
    out = memory.last;
    return;
  }
  memory.sides.resize(sides_.size());
  std::array<LayerSum, kMostSides> sums;
  const auto add = [&](std::size_t i) {
    const Side& side = sides_[i];
    const Pose &X_Wc = side.a ? X_Wa : X_Wb, &X_Wt = side.a ? X_Wb : X_Wa;
    memory.sides[i].cancelled = memory.cancelled;
    side.quadrature->add(X_Wt.inverse() * X_Wc, memory.sides[i], sums[i], level, motion(side, X_Wa, X_Wb, twists));
  };
  // Isolated: while it waits this thread shall not begin another path, of which there may be many.
  if (sides_.size() == 1)
    add(0);
  else
    tbb::this_task_arena::isolate([&] { tbb::parallel_for(std::size_t{0}, sides_.size(), add); });
  out = LayerWrench();
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const Side& side = sides_[i];
    LayerWrench part = side.a ? in_world(X_Wa, X_Wb, sums[i]) : swapped(in_world(X_Wb, X_Wa, sums[i]));
    out.wrench += side.share * part.wrench;
    out.stiffness += side.share * part.stiffness;
    out.load += side.share * sums[i].load;
    out.damped += side.share * sums[i].damped;
    out.error += side.share * sums[i].error;
  }
  memory.known = false;
  if (asked_to_stop(memory.cancelled)) {
    out.wrench.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  if (damped) return;
  memory.a = X_Wa;
  memory.b = X_Wb;
  memory.last = out;
  memory.level = level;
  memory.known = true;
}

void ElasticLayer::visit(const Pose& X_Wa, const Pose& X_Wb, std::size_t side, Memory& memory,
                         const std::function<void(const LayerPoint&)>& visit, int level, const Vec12* twists) const {
  memory.sides.resize(sides_.size());
  const Pose &X_Wc = sides_[side].a ? X_Wa : X_Wb, &X_Wt = sides_[side].a ? X_Wb : X_Wa;
  sides_[side].quadrature->visit(X_Wt.inverse() * X_Wc, memory.sides[side], visit, level,
                                 motion(sides_[side], X_Wa, X_Wb, twists));
}

}  // namespace genu
