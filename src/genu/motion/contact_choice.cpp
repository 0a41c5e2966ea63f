#include "genu/motion/contact_choice.h"

#include <bit>

#include "genu/equilibrium/contact_inspection.h"
#include "genu/equilibrium/tolerances.h"
#include "genu/motion/tolerances.h"

namespace genu {
namespace {

/// Calls attempt(chosen) for sets of `count` things, as bits, the largest sets first, until one does.
template <typename Attempt>
bool try_sets(std::size_t count, Attempt attempt) {
  const unsigned most = 1U << count;
  for (int size = static_cast<int>(count); size >= 0; --size)
    for (unsigned chosen = most; chosen-- > 0;)
      if (std::popcount(chosen) == size && attempt(chosen)) return true;
  return false;
}

bool has(unsigned chosen, std::size_t i) { return (chosen >> i & 1U) != 0; }

std::vector<ActiveContact> those(const std::vector<ActiveContact>& all, unsigned chosen) {
  std::vector<ActiveContact> out;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (has(chosen, i)) out.push_back(all[i]);
  return out;
}

double total_mass(const JointModel& model) {
  double mass = 0;
  for (const Inertia& inertia : model.inertias) mass += inertia.mass;
  return mass;
}

/// Closes open contacts of `all` that would return before they are open by more than `touching`: a rattle below the
/// resolution of gaps does not count.
void end_rattle(EquationsOfMotion& equations, const std::vector<ActiveContact>& all, double touching,
                MotionPoint& point) {
  MotionPoint flying = point;
  if (!equations.complete(flying)) return;
  std::vector<ActiveContact> closed = point.state.contacts;
  for (const ActiveContact& c : all) {
    if (contains(point.state, c)) continue;
    const auto opening = equations.opening(flying, c);
    if (!opening || !(opening->acceleration < 0)) continue;
    if (opening->rate * opening->rate < -2 * opening->acceleration * touching) closed.push_back(c);
  }
  if (closed.size() == point.state.contacts.size()) return;
  flying = point;
  flying.state.contacts = closed;
  VecX impulses;
  if (equations.strike(flying, impulses)) point = flying;
}

}  // namespace

bool settle_speeds(const JointModel& model, EquationsOfMotion& equations, double touching, MotionPoint& point) {
  const std::vector<ActiveContact> all = point.state.contacts;
  const double unseen = 1e-3 * kImpulseRounding * total_mass(model) * model.scales.length;  // N s
  return try_sets(all.size(), [&](unsigned chosen) {
    MotionPoint trial = point;
    trial.state.contacts = those(all, chosen);
    VecX impulses;
    if (!equations.strike(trial, impulses)) return false;
    const auto contacts = static_cast<Eigen::Index>(trial.state.contacts.size());
    const double largest = impulses.size() > 0 ? impulses.cwiseAbs().maxCoeff() : 0;
    if (contacts > 0 && impulses.tail(contacts).minCoeff() < -kImpulseRounding * largest - unseen) return false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (has(chosen, i)) continue;
      const auto opening = equations.opening(trial, all[i]);
      if (!opening) continue;  // its minimum of the gap no longer exists
      const double none = kImpulseRounding * (opening->rate_scale + model.scales.length);
      if (opening->rate < -none) return false;
      if (opening->rate <= none) trial.state.contacts.push_back(all[i]);
    }
    end_rattle(equations, all, touching, trial);
    point = trial;
    return true;
  });
}

bool settle_forces(const JointModel& model, EquationsOfMotion& equations, MotionPoint& point, int leaves) {
  const std::vector<ActiveContact> all = point.state.contacts;
  const double usual = model.scales.force / total_mass(model);  // m/s^2: unit of the rounding of accelerations at rest
  return try_sets(all.size(), [&](unsigned chosen) {
    if (leaves >= 0 && has(chosen, at(leaves))) return false;
    MotionPoint trial = point;
    trial.state.contacts = those(all, chosen);
    if (!equations.complete(trial)) return false;
    for (const ActiveContact& c : trial.state.contacts)
      if (c.force < -kPullTolerance * model.scales.force) return false;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (has(chosen, i)) continue;
      const auto opening = equations.opening(trial, all[i]);
      if (opening && opening->acceleration < -kImpulseRounding * (opening->acceleration_scale + usual)) return false;
    }
    point = trial;
    return true;
  });
}

}  // namespace genu
