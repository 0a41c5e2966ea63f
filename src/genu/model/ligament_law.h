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
// or a ForceLaw of the caller's own.
//
// A law has breaks, where it is less than smooth. Those at which force or stiffness jumps are sharp: there its pieces
// meet. Beyond a sharp break a piece can be continued straight with the force and stiffness it has there: what a solver
// does that keeps to one piece while it iterates. At the other breaks a law can be solved as it is.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "genu/model/monotone_table.h"
#include "genu/scene/scene.h"

namespace genu {

struct LawValue {
  double force = 0;      ///< N, positive in tension
  double stiffness = 0;  ///< dF/dL, N/m
  double energy = 0;     ///< J; 0 where slack, or at the slack length for laws that are never slack
};

/// A length at which a law becomes slack or taut or goes over into another formula, and what it is on the two sides.
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

/// A force-length law of the caller's own: derive from it, make a LigamentLaw of it with LigamentLaw::custom() and give
/// that to add_ligament() (build_model.h). Immutable once made; called from one thread at a time for each solve.
class ForceLaw {
 public:
  virtual ~ForceLaw() = default;

  /// Force (N, positive in tension), its exact derivative dF/dL (N/m) and, if known, the energy (J; the solver does not
  /// need it) at a length > 0 (m). Smooth between the breaks; at a break the value of the shorter side.
  virtual LawValue evaluate(double length) const = 0;

  /// Where force or stiffness is not smooth, by increasing length; each must be stated where one of them jumps, the
  /// others are only reported as events. None by default.
  virtual std::vector<LawBreak> breaks() const { return {}; }

  /// L0 (m) for the strain (L - L0) / L0 in the results; empty where strain has no meaning.
  virtual std::optional<double> slack_length() const { return std::nullopt; }
};

class LigamentLaw {
 public:
  /// As a piece: whichever the length lies in.
  static constexpr int kByLength = -1;

  /// A law of the caller's own. Empty where its breaks are not finite, positive and increasing, or differ from what it
  /// evaluates to just beside them; then `why` says what is wrong.
  static std::optional<LigamentLaw> custom(std::shared_ptr<const ForceLaw> law, std::string& why);

  /// Length in m, >= 0.
  LawValue evaluate(double length) const;

  /// The same on one piece (0 for lengths up to the first sharp break), which beyond its ends goes on straight.
  LawValue evaluate(double length, int piece) const;

  /// All breaks, by increasing length.
  const std::vector<LawBreak>& breaks() const { return breaks_; }

  /// Those at which force or stiffness jumps: where pieces meet.
  const std::vector<LawBreak>& sharp_breaks() const { return sharp_breaks_; }

  /// Whether the force is 0 on the whole of a piece.
  bool is_slack(int piece) const;

  /// The piece a length lies in: a sharp break belongs to the shorter side.
  int piece_at(double length) const;

  /// (L - L0) / L0; NaN for a law without a slack length and for a spring of slack length 0, which have no strain.
  double strain(double length) const;

  /// L0, m; NaN for a law that has none.
  double slack_length() const { return slack_length_; }

  /// Up to this length (m) force, stiffness and energy are exactly 0; negative for a law that is never slack.
  double slack_until() const { return slack_until_; }

 private:
  friend std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

  explicit LigamentLaw(const LigamentDef& def);
  LigamentLaw() = default;
  void set_slack_length(double slack_length);
  void set_breaks();
  void set_table_breaks();
  void find_sharp_breaks();
  std::optional<double> slack_length_for(double force, double length) const;
  std::optional<double> strain_for(double force) const;
  LawValue toe_and_line(double strain) const;
  LawValue abdel_rahman(double length) const;
  LawValue tabulated(double strain) const;

  LigamentDef::Law kind_ = LigamentDef::Law::spring;
  double stiffness_ = 0;
  double toe_stiffness_ = 0;
  double transition_strain_ = 0;
  double slack_length_ = 1;
  double slack_until_ = 1;
  double transition_length_ = 0;  ///< blankevoort, abdel-rahman: up to here the toe
  std::optional<MonotoneTable> table_;
  double table_origin_ = 0;  ///< the table's integral where the energy is 0
  std::shared_ptr<const ForceLaw> custom_;
  std::vector<LawBreak> breaks_, sharp_breaks_;
  std::vector<bool> slack_pieces_;
};

/// The law that `def` describes; `reference_length` (m) is its length in the reference pose, which reference_strain and
/// reference_force mean. A force reached at several strains means the smallest; the force 0 means a ligament about to
/// become taut. Empty where no such law exists (a parameter out of range, a force the law cannot have); then `why` says
/// what is wrong, without the ligament's name.
std::optional<LigamentLaw> make_law(const LigamentDef& def, double reference_length, std::string& why);

}  // namespace genu
