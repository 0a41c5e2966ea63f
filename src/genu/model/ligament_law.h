// Force-length laws of ligaments and springs: force F(L), its derivative and its energy.
//
// With slack length L0 and strain e = (L - L0) / L0:
//   quadratic     F = K e^2                               tension only
//   linear        F = K e                                 tension only
//   blankevoort   F = K e^2 / (2 e_t) up to e_t, then K (e - e_t / 2); tension only
//                 (Blankevoort et al., J. Biomech. 24 (1991) 1019-1031)
//   abdel-rahman  F = K2 (L - L0)^2 up to e_t, then K1 (L - (1 + e_t / 2) L0); tension only; may jump at e_t, where the
//                 toe's value holds (Abdel-Rahman and Hefzy, Med. Eng. Phys. 20 (1998) 276-290)
//   spring        F = k (L - L0)                          both ways, L0 = 0 allowed
//   table         F through points (e, F), see MonotoneTable: straight beyond the points with the end slopes; a table
//                 without negative forces never pushes
#pragma once

#include <optional>
#include <string>

#include "genu/model/monotone_table.h"
#include "genu/scene/scene.h"

namespace genu {

struct LawValue {
  double force = 0;      ///< N, positive in tension
  double stiffness = 0;  ///< dF/dL, N/m
  double energy = 0;     ///< J; 0 where slack, or at the slack length for laws that are never slack
};

class LigamentLaw {
 public:
  /// Length in m, >= 0.
  LawValue evaluate(double length) const;

  /// (L - L0) / L0; NaN for a spring of slack length 0, which has no strain.
  double strain(double length) const;

  /// L0, m.
  double slack_length() const { return slack_length_; }

  /// Up to this length (m) force, stiffness and energy are exactly 0; negative for a law that is never slack.
  double slack_until() const { return slack_until_; }

 private:
  friend std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

  explicit LigamentLaw(const LigamentDef& def);
  void set_slack_length(double slack_length);
  std::optional<double> slack_length_for(double force, double length) const;
  std::optional<double> strain_for(double force) const;
  LawValue toe_and_line(double strain) const;
  LawValue abdel_rahman(double stretch) const;
  LawValue tabulated(double strain) const;

  LigamentDef::Law kind_;
  double stiffness_ = 0;
  double toe_stiffness_ = 0;
  double transition_strain_ = 0;
  double slack_length_ = 1;
  double slack_until_ = 1;
  std::optional<MonotoneTable> table_;
  double table_origin_ = 0;  ///< the table's integral where the energy is 0
};

/// The law that `def` describes; `reference_length` (m) is its length in the reference pose, which reference_strain and
/// reference_force mean. A force reached at several strains means the smallest; the force 0 means a ligament about to
/// become taut. Empty where no such law exists (a parameter out of range, a force the law cannot have); then `why` says
/// what is wrong, without the ligament's name.
std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

}  // namespace genu
