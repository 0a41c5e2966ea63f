// Rigid contacts in motion: opening, closing and impacts.
//
// Between events, closed contacts are constraints of the equations of motion. A contact opens where its force becomes
// negative. One closes where an open gap becomes 0: an inelastic impact, after which no gap decreases. The active set
// after it, first for velocities (impulses) and then for accelerations (forces), solves a complementarity problem: each
// contact is closed with a compressive force, or opens (contact_choice.h).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "genu/equilibrium/active_set.h"
#include "genu/equilibrium/pair_gaps.h"
#include "genu/motion/equations_of_motion.h"
#include "genu/motion/motion_watch.h"
#include "genu/path/path_options.h"

namespace genu {

class MotionContacts {
 public:
  /// `tolerance`: error of a step, of the scale of length.
  MotionContacts(const JointModel& model, EquationsOfMotion& equations, double tolerance, const Cancelled& cancelled);

  /// Replaces the joints' start by the equilibrium at time 0. False with `why` where none is found.
  [[nodiscard]] bool balance(MotionPoint& point, std::string& why);

  /// Contacts at the start: those that touch. False with `why` where bodies overlap.
  [[nodiscard]] bool begin(MotionPoint& point, std::string& why);

  /// A change of the contacts, or the end of the motion.
  struct Change {
    enum class Kind { none, opens, closes, merges, splits, ends };
    Kind kind = Kind::none;
    int contact = 0;                    ///< opens, merges, splits: index into State::contacts
    std::vector<Candidate> candidates;  ///< closes: one; splits: its replacements
    MotionPoint point;                  ///< where, with the contacts before the change
    std::string why;                    ///< ends
  };
  using PointAt = std::function<bool(double time, MotionPoint& out)>;

  /// The first change after `from` and up to `to`, both of one step; `at` gives points between.
  Change first_change(const MotionPoint& from, const MotionPoint& to, const PointAt& at);

  /// Applies a change: contacts, velocities and forces of `point` become those after it. False with `why` where none
  /// are possible.
  [[nodiscard]] bool apply(const Change& change, MotionPoint& point, std::vector<PathEvent>& events, std::string& why);

  /// m: the smallest gap of each pair.
  std::vector<double> gaps(const MotionPoint& point) {
    std::vector<OpenContact> none;
    return pair_gaps(point.state, model_, field_, none);
  }

  /// Makes the velocities and contacts of `point` feasible: after a stop, where drives and loads may jump.
  [[nodiscard]] bool settle(MotionPoint& point, std::vector<PathEvent>& events, std::string& why);

 private:
  bool near(const MotionPoint& from, const MotionPoint& to);
  bool known_clear(const MotionPoint& from, const MotionPoint& to);
  bool born_beside(const State& state, const ActiveContact& contact);
  double allowed_overlap(const State& state, const Candidate& candidate) const;
  bool looks_well(const MotionPoint& point);
  std::optional<MotionPoint> overlap_between(const MotionPoint& from, const MotionPoint& to, const PointAt& at);
  bool is_located(const Change& change) const;
  Change first_seen(const MotionPoint& from, const MotionPoint& to, const PointAt& at);
  Change look(const MotionPoint& from, const MotionPoint& to, const PointAt& at);
  [[nodiscard]] bool settle(MotionPoint& point, int leaves, std::vector<PathEvent>& events, std::string& why);
  void note(const std::vector<ActiveContact>& before, const MotionPoint& point, std::vector<PathEvent>& events);

  const JointModel& model_;
  EquationsOfMotion& equations_;
  ContactField field_;
  ActiveSetSolver solver_;
  ContactInspector inspector_;
  Balanced book_;
  Survey survey_;
  std::vector<LocalMinimum> beside_;
  std::vector<MotionWatch> watches_;  ///< one per pair
  double touching_;                   ///< m: a smaller gap counts as zero
};

}  // namespace genu
