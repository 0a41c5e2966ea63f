#include "genu/solver/starts.h"

#include <algorithm>

#include "genu/model/potential_energy.h"

namespace genu {
namespace {

constexpr double kLeastShare = 1.0 / 8;  // of the way to a start: nearer to the first one tells nothing new

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// The prime after `prime`: the base of the next coordinate.
int next_prime(int prime) {
  const auto is_prime = [](int n) {
    for (int d = 2; d * d <= n; ++d)
      if (n % d == 0) return false;
    return true;
  };
  do ++prime;
  while (!is_prime(prime));
  return prime;
}

/// The value that a coordinate is prescribed or held at; empty for a free one. A combination leaves its coordinates
/// free: the solver finds the values that add up.
std::optional<double> fixed_value(const JointModel& model, const Target& target, const CoordinateRef& c) {
  for (const auto& p : target.prescribed)
    if (p.coordinate == QuantityRef(c)) return p.value;
  for (const auto& held : model.held)
    if (held.coordinate == c) return held.value;
  return std::nullopt;
}

bool same_pose(const JointModel& model, const State& x, const State& y, double tolerance) {
  for (std::size_t i = 0; i < x.poses.size(); ++i) {
    const double translation = (x.poses[i].p - y.poses[i].p).norm() / model.scales.length;
    const double rotation = log_rotation(x.poses[i].R * y.poses[i].R.transpose()).norm();
    if (!(std::max(translation, rotation) <= tolerance)) return false;
  }
  return true;
}

bool overlaps(const JointModel& model, ContactField& field, const State& state, double most) {
  for (int pair = 0; pair < static_cast<int>(model.pairs.size()); ++pair)
    if (field.overlap(state, pair) > most) return true;
  return false;
}

/// Settles start `k`; where it overlaps deeply or does not settle, from nearer to the first one.
PoseReport settle_start(ContactSetSolver& solver, const Target& target, const std::vector<JointValues>& first, int k,
                        const StartOptions& options, Balanced& pose) {
  const JointModel& model = solver.model();
  pose.last_number.assign(model.pairs.size(), 0);
  PoseReport report;
  report.why = "surfaces overlap";
  const double least_share = k == 1 ? 1 : kLeastShare;
  for (double share = 1; share >= least_share; share /= 2) {
    pose.state = State();
    pose.state.coordinates = start_coordinates(model, target, first, k, share, options);
    pose.state.poses = poses_from_coordinates(model, pose.state.coordinates);
    if (k > 1 && overlaps(model, solver.field(), pose.state, options.largest_overlap)) continue;
    // Bodies that are apart at first would be pulled together by their ligaments before any contact is closed, and
    // through one another: where surfaces may touch they settle on an elastic foundation first, unless start 1 is near.
    const bool seeded = k > 1 && share > kLeastShare && !model.pairs.empty();
    report = seeded ? solver.settle_from_seed(pose, target) : solver.settle_cold(pose, target);
    if (report.status == PoseStatus::ok) break;
  }
  return report;
}

}  // namespace

double van_der_corput(int index, int base) {
  double value = 0, digit = 1;
  for (int rest = index + 1; rest > 0; rest /= base) value += (digit /= base) * (rest % base);
  return value;
}

std::vector<JointValues> start_coordinates(const JointModel& model, const Target& target,
                                           const std::vector<JointValues>& first, int k, double share,
                                           const StartOptions& options) {
  std::vector<JointValues> out;
  int base = 2;
  for (int j = 0; j < static_cast<int>(model.joints.size()); ++j) {
    JointValues q = first[at(j)];
    for (int i = 0; i < 6; ++i) {
      if (const auto fixed = fixed_value(model, target, {j, i})) {
        q[at(i)] = *fixed;
        continue;
      }
      const double most = i < 3 ? options.angle : options.translation * model.scales.length;
      if (k > 1) q[at(i)] += share * most * (2 * van_der_corput(k - 2, base) - 1);
      base = next_prime(base);
    }
    out.push_back(q);
  }
  return out;
}

StartSearch search_starts(const JointModel& model, ContactField& field, const Target& target,
                          const std::vector<JointValues>& first, const StartOptions& options,
                          const std::function<bool()>& cancelled) {
  StartSearch out;
  ContactSetSolver solver(model, field, options.newton);
  Linearization here;
  for (int k = 1; k <= options.count && !(cancelled && cancelled()); ++k) {
    ++out.count;
    Equilibrium found;
    found.report = settle_start(solver, target, first, k, options, found.pose);
    if (found.report.status != PoseStatus::ok) {
      out.failed.push_back({k, found.report});
      continue;
    }
    const auto known = std::find_if(out.equilibria.begin(), out.equilibria.end(), [&](const Equilibrium& e) {
      return same_pose(model, e.pose.state, found.pose.state, options.same_pose);
    });
    if (known != out.equilibria.end()) {
      known->starts.push_back(k);
      continue;
    }
    linearize(model, found.pose.state, target, here);
    found.stability = assess_stability(here, model.scales.length);
    found.energy = potential_energy(model, found.pose.state, target);
    found.starts = {k};
    out.equilibria.push_back(std::move(found));
  }
  return out;
}

}  // namespace genu
