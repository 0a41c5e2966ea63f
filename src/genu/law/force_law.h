// A force-length law of a ligament or spring: force F(L), its derivative, its energy and its breaks. The laws of scenes
// (laws.h) and laws of the caller's own are the same kind of class.
//
// A law has breaks, where it is less than smooth. Those at which force or stiffness jumps are sharp.
#pragma once

#include <optional>
#include <vector>

namespace genu {

struct LawValue {
  double force = 0;      ///< N, positive in tension
  double stiffness = 0;  ///< dF/dL, N/m
  double energy = 0;     ///< J; 0 where slack, or at the slack length for laws that are never slack
};

/// A length at which a law becomes slack or taut or changes formula, and its values on the two sides.
struct LawBreak {
  struct Side {
    double force = 0;      ///< N
    double stiffness = 0;  ///< dF/dL, N/m
    bool slack = false;    ///< the force is 0 on this side, as far as the next break
  };
  double length = 0;  ///< m; the law's value at this length is that of `below`
  Side below, above;

  /// Size of the jump of the force (N) and of the stiffness (N/m), from below to above.
  double force_jump() const { return above.force - below.force; }
  double stiffness_jump() const { return above.stiffness - below.stiffness; }
  /// The force jumps by more than rounding.
  bool jumps() const;
  /// The force or its stiffness jumps by more than rounding.
  bool sharp() const;
};

/// Derivatives of a law at one length.
struct LawRates {
  std::vector<double> force_by_number;  ///< at constant length and slack length: N per SI unit, in the table's order
  double force_by_slack_length = 0;     ///< at constant length: N/m
  double slack_length_by_length = 1;    ///< dL0/dL at constant force, also where the force is 0
};

/// A force-length law. For a law of your own derive from it, make a LigamentLaw of it with LigamentLaw::custom()
/// (model/ligament_law.h) and give that to add_ligament() (model/build_model.h). Immutable once made; called from one
/// thread at a time for each solve.
class ForceLaw {
 public:
  virtual ~ForceLaw() = default;

  /// Force (N, positive in tension), its exact derivative dF/dL (N/m) and, if known, the energy (J; the solver does not
  /// need it) at a length > 0 (m). Smooth between the breaks; at a break the value of the shorter side. A LigamentLaw
  /// does not ask below the first break where that side is slack.
  virtual LawValue evaluate(double length) const = 0;

  /// Where force or stiffness is not smooth, by increasing length. Each break where one of them jumps must be stated;
  /// the others are only reported as events. None by default.
  virtual std::vector<LawBreak> breaks() const { return {}; }

  /// L0 (m) for the strain (L - L0) / L0 in the results; empty where strain has no meaning.
  virtual std::optional<double> slack_length() const { return std::nullopt; }

  /// Up to this length (m) force, stiffness and energy are 0; negative for a law that is never slack. By default the
  /// first break, if its shorter side is slack.
  virtual double slack_until() const;

  /// Derivatives by the law's numbers, for sensitivities; asked of the laws of scenes alone.
  virtual LawRates rates(double length) const;

 protected:
  static constexpr double kNeverSlack = -1;
};

/// The rates of a law of the strain alone, F(L; L0) = f(e): constant force means constant strain.
LawRates rates_of_strain_law(const LawValue& value, double length, double slack_length,
                             std::vector<double> force_by_number);

}  // namespace genu
